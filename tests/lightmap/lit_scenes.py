"""Small scenes whose light is known, and lookups at points of their surfaces."""

import numpy as np

import playground as pg
from playground.scene.light import RectangleLight
from playground.scene.material import Material
from playground.scene.mesh import Mesh
from playground.scene.scene import Object, Scene
from playground.scene.transform import Transform
from playground.shading.texture import bilinear

BLACK = Material(diffuse=(0.0, 0.0, 0.0), specular=(0.0, 0.0, 0.0), ambient=(0.0, 0.0, 0.0))
GREY = Material(diffuse=(0.5, 0.5, 0.5), specular=(0.0, 0.0, 0.0), ambient=(0.0, 0.0, 0.0))


def room(x, y, z, material=GREY):
    """A closed room between the two ends of x, y and z; its fronts look inwards."""
    corners = np.array([(a, b, c) for a in x for b in y for c in z])
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    triangles = np.array([t for a, b, c, d in faces for t in ((a, b, c), (a, c, d))])
    middle = corners.mean(axis=0)
    first = corners[triangles]
    outward = np.cross(first[:, 1] - first[:, 0], first[:, 2] - first[:, 0])
    away = np.einsum("ni,ni->n", outward, first[:, 0] - middle) > 0.0
    triangles[away] = triangles[away][:, ::-1]
    places = corners[triangles].reshape(-1, 3)  # every face has corners of its own: creases
    return Object(
        mesh="room", arrays=Mesh.create(places, np.arange(36).reshape(-1, 3)), material=material
    )


def box(centre, half, material=GREY):
    return Object(mesh="box", transform=Transform(translate=centre, scale=half), material=material)


def lamp(position, side, radiance=(10.0, 10.0, 10.0)):
    """A square that shines downwards."""
    return RectangleLight(
        position=position, facing=(0.0, -1.0, 0.0), width=side, height=side, diffuse=radiance
    )


def setup(objects, lights, **settings):
    scene = Scene(objects=tuple(objects), lights=tuple(lights))
    return pg.Setup(scene).with_(solver="gauss-seidel", convergence=1e-10, **settings)


def looked_up(lightmap, scene, number, rng, count=4000, shown="all"):
    """Points (P, 3) all over an object, and what the lightmap shows there, (P, 3)."""
    item, part = scene.objects[number], lightmap.parts[number]
    geometry = item.geometry()
    local = geometry.mesh.positions[part.vertices].astype(np.float64) + geometry.offset
    places = local @ item.transform.matrix[:3, :3].T + item.transform.matrix[:3, 3]
    a, b, c = np.moveaxis(places[part.faces], 1, 0)
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    face = rng.choice(len(area), count, p=area / area.sum())
    weights = rng.dirichlet((1.0, 1.0, 1.0), count)
    corners = part.faces[face]
    points = np.einsum("pc,pcx->px", weights, places[corners])
    texcoords = np.einsum("pc,pcx->px", weights, part.texcoords[corners].astype(np.float64))
    return points, bilinear(lightmap.texels(shown), texcoords)
