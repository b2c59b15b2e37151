"""The numbers of a traced scene for ``shaders/trace/scene.glsl``, and those of its camera.

How far a hit may be from its surface, in units of the largest number that makes it, with the
unit roundoff u = 2⁻²⁴ and matrices rounded to float32: a point on a ball is centre + radius ·
normal, 2 roundings of the inputs, 2 operations and 3u of the normal's length; one on a plane
misses it by 4u of the point and of the plane's foot; one on a shape goes through its matrix and
back, 4u each way and 6u for putting it onto the shape. All are within the 32u of ``ROUNDINGS``.
A ray starts 64u away along the normal n: that sum rounds each coordinate by u, which moves the
start by u (|n_x| + |n_y| + |n_z|) <= 2u towards the surface at most. 46u are left.

Directions are made unit at the eye. A reflection keeps the length to 16u (four times the 3u of the
normal's length, and the sum's own roundings), a refraction makes it anew from sine and cosine: a
length is off by 1e-4 at most after the hundred mirrors that a setting allows.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from playground.render.gl.light_uniforms import standing_values, turned_values
from playground.render.gl.trace.layout import Layout, flattened, without_dust
from playground.render.gl.trace.trees import Trees
from playground.render.raster.coverage import SUBPIXELS, sample_position
from playground.render.trace.lamp import facing_of, points_on
from playground.render.trace.solids import Solid
from playground.render.trace.traced_scene import TracedScene
from playground.render.view import View
from playground.scene.camera import Camera
from playground.shading.floats import Array

Values = dict[str, Any]


def scene_values(scene: TracedScene, layout: Layout, trees: Trees | None) -> Values:
    """Everything but the camera: solids, materials, media, lights."""
    solids = {kind: [scene.solids[n] for n in numbers] for kind, numbers in layout.kinds.items()}
    settings = scene.settings
    return {
        **_balls(solids["ball"]),
        **_flats(solids["square"] + solids["disc"]),
        **_places_of("shape", solids["oval"] + solids["box"] + solids["cylinder"]),
        **_places_of("mesh", solids["mesh"]),
        **_trees(solids["mesh"], trees),
        **_materials(layout),
        **_media(scene),
        **_lights(scene, layout),
        "background": np.array(scene.setup.scene.background),
        "threshold": settings.threshold,
        "exposure": settings.exposure,
    }


def camera_values(
    view: View, space: View, camera: Camera, size: tuple[int, int], offset: tuple[float, float]
) -> Values:
    """The eye and the rays through pixels, in the ``space`` of the scene; see `camera_rays`."""
    width, height = size
    x, y = sample_position(offset) / SUBPIXELS
    half = view.pixel(height) * height / 2.0
    right, up, back = view.camera_from_world
    column, row = 2.0 * half / height * right, -2.0 * half / height * up
    corner = -back - half * width / height * right + half * up
    far = camera.far * space.scale if camera.far else 3e38
    return {
        "camera": space.relative(view.eye),
        "first_ray": corner + x * column + y * row,
        "next_column": column,
        "next_row": row,
        "reach": np.array([camera.near * space.scale, far]),
    }


def area_points(scene: TracedScene, layout: Layout) -> Array | None:
    """Where on area lights the shadow rays go, (lights, samples, 3); None without such lights."""
    found = [light.corners for _, light in layout.lights.get("area", ())]
    count = scene.settings.light_samples
    if not found:
        return None
    return np.stack([points_on(scene.view.corners(x), count) for x in found if x is not None])


def _balls(solids: list[Solid]) -> Values:
    return {
        "ball_centre": [solid.centre for solid in solids],
        "ball_radius": [[solid.ball[1]] for solid in solids],
    }


def _flats(solids: list[Solid]) -> Values:
    rows = [without_dust(solid.inverse) for solid in solids]
    normals = [row[1] / np.linalg.norm(row[1]) for row in rows]
    return {
        "flat_foot": [(n @ s.centre) * n for n, s in zip(normals, solids, strict=True)],
        "flat_normal": normals,
        "flat_x": [row[0] for row in rows],
        "flat_z": [row[2] for row in rows],
        "flat_shift": [row[::2] @ s.centre for row, s in zip(rows, solids, strict=True)],
    }


def _places_of(kind: str, solids: list[Solid]) -> Values:
    """Matrices into objects and back; what is flattened has its corners in the eye's space."""
    values: Values = {
        f"{kind}_centre": [solid.centre for solid in solids],
        f"{kind}_size": [[_size(solid)] for solid in solids],
    }
    for k, axis in enumerate("xyz"):
        values[f"{kind}_{axis}"] = [without_dust(solid.inverse)[k] for solid in solids]
    for k, name in enumerate(("right", "up", "back")):
        back = [np.eye(3) if flattened(s) else without_dust(s.matrix) for s in solids]
        values[f"{kind}_{name}"] = [matrix[:, k] for matrix in back]
    return values


def _trees(solids: list[Solid], trees: Trees | None) -> Values:
    if trees is None:
        return {}
    found = [trees.tree[solid.bvh] for solid in solids if solid.bvh is not None]
    return {
        "mesh_low": [tree.low for tree in found],
        "mesh_cell": [tree.cell for tree in found],
        "mesh_root": np.array([tree.root for tree in found], dtype=np.uint32),
    }


def _size(solid: Solid) -> float:
    """The largest number on the way to any point of a solid."""
    reach = np.ones(3)
    if solid.kind == "mesh":
        reach = np.max(np.abs(solid.surface.mesh.bounds), axis=0)
    return float((np.abs(solid.centre) + solid.spread @ reach).max())


def _materials(layout: Layout) -> Values:
    looks = layout.looks
    values: Values = {"material_shininess": [[look.shininess] for look in looks]}
    values["material_index"] = [[look.index] for look in looks]
    for name in ("diffuse", "specular", "front", "back", "absorption"):
        values[f"material_{name}"] = [getattr(look, name) for look in looks]
    for name in ("reflectance", "transmittance"):
        values[f"material_{name}"] = [getattr(look, name) for look in looks]
    return values


def _media(scene: TracedScene) -> Values:
    media = scene.media
    return {
        "medium_index": [[index] for index in media.index],
        "medium_absorption": list(media.absorption),
    }


def _lights(scene: TracedScene, layout: Layout) -> Values:
    values: Values = {}
    weights = scene.settings.weights
    for kind, found in layout.lights.items():
        own = [scene.setup.scene.lights[number] for number, _ in found]
        values[f"{kind}_diffuse"] = [weights["diffuse"] * np.array(x.diffuse) for x in own]
        values[f"{kind}_specular"] = [weights["specular"] * np.array(x.specular) for x in own]
    lights = [light for found in layout.lights.values() for _, light in found]
    values |= standing_values(lights, scene.view) | turned_values(lights)
    areas = [light.corners for light in lights if light.corners is not None]
    if areas:
        values["area_facing"] = [facing_of(scene.view.corners(corners)) for corners in areas]
    return values
