"""What of a scene does not depend on the camera, made ready for drawing.

One `Surface` per object: its mesh, its matrices, and the products of light and material
colours, which are the same at every one of its points.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from math import radians
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from playground.render.texels import check_texcoords, load_texture
from playground.scene.light import AreaLight, DirectionalLight, Light, PointLight, SpotLight
from playground.scene.mesh import Mesh
from playground.scene.polygon import triangles
from playground.scene.scene import Object, Scene
from playground.shading.light import cone
from playground.shading.phong import ambient_term, component_filter, emissive_term, weighted_sum
from playground.shading.vector import normal_matrix, orientation, unit

if TYPE_CHECKING:
    from playground.render.stored import StoredLight

Array = NDArray[np.float64]
NO_ATTENUATION = (1.0, 0.0, 0.0)


@dataclass(frozen=True, eq=False)
class SurfaceLight:
    """One light as one surface sees it: ``diffuse`` is w_d s_d ⊗ m_d, ``specular`` w_s s_s ⊗ m_s.

    ``kind`` is directional, point, spot or area. ``position``, ``to_light`` and ``axis`` (3,) and
    the ``corners`` (K, 3) of an area light are in the world, where the kind of light has them;
    ``attenuation`` is (k_c, k_l, k_q).
    """

    kind: str
    diffuse: Array
    specular: Array
    to_light: Array | None = None
    position: Array | None = None
    attenuation: tuple[float, float, float] = NO_ATTENUATION
    axis: Array | None = None
    edge_width: tuple[float, float] = (1.0, 0.0)
    corners: Array | None = None
    two_sided: bool = False

    @property
    def attenuates(self) -> bool:
        """Whether distance makes a difference."""
        return self.attenuation != NO_ATTENUATION


@dataclass(frozen=True, eq=False)
class Surface:
    """One object ready to be drawn from anywhere; matrices act on column vectors.

    An area light that is to be seen is two such sheets, of which each shows its front only.
    """

    mesh: Mesh
    linear: Array  # (3, 3): world axes from object axes
    origin: Array  # (3,): where the mesh's origin lies in the world
    normal_from_object: Array  # (3, 3): unit normals to unit normals unless `stretched`
    ball: tuple[Array, float]
    mirrored: bool
    stretched: bool  # not a similarity: unequally scaled, or flattened
    constant_terms: Array  # (3,): Σ w_a s_a ⊗ m_a + w_e m_e
    shininess: float
    lights: tuple[SurfaceLight, ...]
    texels: NDArray[np.float32] | None
    emitter: int | None = None  # which light this is a side of
    stored: StoredLight | None = None  # the light that arrives, where it was computed before
    reflectance: Array | None = None  # (3,): w_d m_d, which stored light is multiplied by


def surfaces(scene: Scene, weights: dict[str, float]) -> tuple[Surface, ...]:
    """Every object of the scene, with the four terms weighted as in `Settings.weights`.

    After the objects come the sides of area lights that are to be seen.
    """
    lights = enumerate(scene.lights)
    seen = [(i, x) for i, x in lights if isinstance(x, AreaLight) and x.visible]
    return (
        *(_surface(item, scene.lights, weights) for item in scene.objects),
        *(side for i, light in seen for side in _sides(i, light, weights["emissive"])),
    )


def _surface(item: Object, lights: tuple[Light, ...], weights: dict[str, float]) -> Surface:
    geometry = item.geometry()
    world = item.transform.matrix
    linear = world[:3, :3]

    # A rotation times one factor keeps unit normals of one length: make the factor 1.
    normals = normal_matrix(linear)
    gram = normals @ normals.T
    even = gram[0, 0] > 0.0 and np.allclose(gram, gram[0, 0] * np.eye(3), rtol=1e-9, atol=1e-9)
    if even:
        normals = normals / np.sqrt(gram[0, 0])

    material = item.material
    ambient = sum((ambient_term(x.ambient, material.ambient) for x in lights), np.zeros(3))
    constant = weighted_sum(
        0.0, 0.0, ambient, emissive_term(material.emissive), list(weights.values())
    )
    check_texcoords(item, geometry.mesh)
    return Surface(
        mesh=geometry.mesh,
        linear=linear,
        origin=world[:3, 3] + linear @ geometry.offset,
        normal_from_object=normals,
        ball=item.ball,
        mirrored=orientation(linear) < 0.0,
        stretched=not even,
        constant_terms=constant,
        shininess=material.shininess,
        lights=tuple(surface_light(light, item, weights) for light in lights),
        texels=load_texture(material.texture, material.texture_encoding)
        if material.texture
        else None,
    )


def _sides(number: int, light: AreaLight, weight: float) -> tuple[Surface, Surface]:
    """The front of an area light, which shows what it emits, and its back."""
    front, back = _sheets(light.corners)
    origin = np.array(light.corners[0])
    emitted = weight * np.array(light.diffuse)
    radius = front.radius

    def side(mesh: Mesh, colour: Array) -> Surface:
        ball = (origin + mesh.centre, radius)
        matrix = np.eye(3)
        return Surface(
            mesh, matrix, origin, matrix, ball, False, False, colour, 0.0, (), None, number
        )

    return side(front, emitted), side(back, emitted if light.two_sided else np.zeros(3))


@lru_cache(maxsize=64)
def _sheets(corners: tuple[tuple[float, float, float], ...]) -> tuple[Mesh, Mesh]:
    """A polygon as seen from either side, relative to its first corner."""
    places = np.array(corners) - corners[0]
    front = triangles(places, np.array([len(places)]))
    return Mesh.create(places, front), Mesh.create(places, front[:, ::-1])


def surface_light(light: Light, item: Object, weights: dict[str, float]) -> SurfaceLight:
    """One light with its products with the material of ``item``."""
    diffuse = weights["diffuse"] * component_filter(light.diffuse, item.material.diffuse)
    specular = weights["specular"] * component_filter(light.specular, item.material.specular)
    if isinstance(light, DirectionalLight):
        return SurfaceLight("directional", diffuse, specular, to_light=unit(light.to_light))
    if isinstance(light, AreaLight):
        corners = np.array(light.corners)
        return SurfaceLight("area", diffuse, specular, corners=corners, two_sided=light.two_sided)
    assert isinstance(light, PointLight)
    position = np.array(light.position)
    fading = (light.constant, light.linear, light.quadratic)
    attenuation = fading if light.attenuate else NO_ATTENUATION
    if not isinstance(light, SpotLight):
        return SurfaceLight("point", diffuse, specular, position=position, attenuation=attenuation)
    edge, width = cone(radians(light.inner_angle), radians(light.outer_angle))
    return SurfaceLight(
        "spot",
        diffuse,
        specular,
        position=position,
        attenuation=attenuation,
        axis=unit(light.axis),
        edge_width=(float(edge), float(width)),
    )
