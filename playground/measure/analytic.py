"""The exact picture: every pixel shaded in float64 on the surface itself, not on triangles.

What a mesh approximates. One object, a sphere or a torus, under any invertible transform;
a ray through the centre of each pixel meets the surface of the closed form.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import radians, tan

import numpy as np
from numpy.typing import NDArray

from playground.errors import PlaygroundError
from playground.render.image import Image
from playground.render.shade import shade
from playground.render.surface import surfaces
from playground.render.view import View, view_of
from playground.scene.setup import Setup
from playground.shading.vector import Array, dot, unit

TUBE, RING = 0.3, 0.7  # radii of `playground.scene.shapes_curved.torus`
STEPS = 5000  # of the march to a torus: rays that graze it take the most, thousands
CLOSE = 1e-10  # from the surface, where its size is 1: the march has arrived


@dataclass(frozen=True, eq=False)
class Exact:
    """The picture, and ``covered`` (H, W): where a ray through the pixel's centre hits."""

    image: Image
    covered: NDArray[np.bool_]


def exact_picture(setup: Setup, size: tuple[int, int]) -> Exact:
    """The picture of ``setup`` that no tessellation can better.

    Raises
    ------
    PlaygroundError
        Not exactly one object, no closed form for its mesh, or a texture.
    """
    objects = setup.scene.objects
    if len(objects) != 1 or objects[0].mesh not in HITS or objects[0].material.texture:
        raise PlaygroundError(
            "there is no exact picture of this setup",
            got=", ".join(item.mesh for item in objects) or "no object",
            allowed=f"one untextured object: {', '.join(HITS)}",
        )
    (surface,) = surfaces(setup.scene, setup.settings.weights)
    view = view_of(setup.camera, (surface,), size)

    # In the space of the object the surface is its closed form; distances along a ray stay.
    directions = pixel_rays(view, size)
    inverse = np.linalg.inv(surface.linear)
    local = directions @ inverse.T
    origin = inverse @ (view.eye - surface.origin)
    distance = HITS[objects[0].mesh](origin, local)
    covered = np.isfinite(distance)
    hit = distance[covered][:, None]
    points = origin + hit * local[covered]
    normal = unit(NORMALS[objects[0].mesh](points) @ surface.normal_from_object.T)

    position = directions[covered] * hit * view.scale
    diffuse, rest = shade(surface, view, setup.settings, position, normal)
    pixels = np.empty((size[1], size[0], 3))
    pixels[...] = setup.scene.background
    pixels[covered] = diffuse + rest
    return Exact(Image(pixels.astype(np.float32), setup=setup, renderer="exact"), covered)


def pixel_rays(view: View, size: tuple[int, int]) -> Array:
    """Directions (H, W, 3) in the world from the eye through the centres of the pixels."""
    width, height = size
    slope = tan(radians(view.fov) / 2.0)
    x = (2.0 * (np.arange(width) + 0.5) / width - 1.0) * slope * width / height
    y = (1.0 - 2.0 * (np.arange(height) + 0.5) / height) * slope
    rays = np.stack(np.broadcast_arrays(x[None, :], y[:, None], -1.0), axis=-1)
    return np.asarray(rays @ view.camera_from_world)


def hit_sphere(origin: Array, rays: Array) -> Array:
    """Distance along each ray (..., 3) to the unit sphere, infinity where it misses; (...).

    The ray's nearest point to the centre is found first, so that no digits cancel.
    Source: Haines, Günther & Akenine-Möller, Precision Improvements for Ray/Sphere
    Intersection, in Ray Tracing Gems, 2019, chapter 7.
    """
    squared = dot(rays, rays)
    middle = -dot(origin, rays) / squared
    nearest = origin + middle[..., None] * rays
    inside = 1.0 - dot(nearest, nearest)
    distance = middle - np.sqrt(np.maximum(inside, 0.0) / squared)
    return np.where((inside >= 0.0) & (distance > 0.0), distance, np.inf)


def hit_torus(origin: Array, rays: Array) -> Array:
    """Distance along each ray (..., 3) to the torus about y, infinity where it misses; (...).

    Walks by the distance to the surface, which can be stepped without passing it.
    Source: Hart, Sphere Tracing, The Visual Computer 12, 1996.
    """
    length = np.sqrt(dot(rays, rays))
    along = (rays / length[..., None]).reshape(-1, 3)
    leave = float(np.linalg.norm(origin)) + RING + TUBE
    travelled, result = np.zeros(len(along)), np.full(len(along), np.inf)
    active = np.arange(len(along))
    for _ in range(STEPS):
        step = torus_distance(origin + travelled[active, None] * along[active])
        travelled[active] += step
        arrived = step < CLOSE
        result[active[arrived]] = travelled[active[arrived]]
        active = active[~arrived & (travelled[active] < leave)]
    return result.reshape(length.shape) / length


def torus_distance(points: Array) -> Array:
    """How far points (..., 3) are from the torus, negative inside; (...)."""
    around = np.hypot(points[..., 0], points[..., 2]) - RING
    return np.hypot(around, points[..., 1]) - TUBE


def _torus_normal(points: Array) -> Array:
    """The gradient of `torus_distance`, which has unit length."""
    around = np.hypot(points[..., 0], points[..., 2])
    ring = points * np.array([1.0, 0.0, 1.0]) * (RING / around)[..., None]
    return np.asarray(points - ring)


def _sphere_normal(points: Array) -> Array:
    return points


HITS: dict[str, Callable[[Array, Array], Array]] = {
    "sphere": hit_sphere,
    "icosphere": hit_sphere,
    "torus": hit_torus,
}
NORMALS: dict[str, Callable[[Array], Array]] = {
    "sphere": _sphere_normal,
    "icosphere": _sphere_normal,
    "torus": _torus_normal,
}
