"""Shapes with a formula of their own, each in the space in which its generator makes it.

The unit sphere; the box [−1, 1]³; the cylinder of radius 1 from y = −1 to 1 with its caps;
the square [−1, 1]² (``quad``) and the unit disc, both at y = 0 and facing +y. Rays are
origin + t · direction, direction of any length; points, normals and texture coordinates are
those of the generators' meshes, without their corners. Arrays have N rows.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from playground.scene.shapes_flat import BOX_FACES
from playground.shading.ray import NO_HIT, ray_box, ray_disc, ray_sphere, ray_tube
from playground.shading.vector import Array

GENERATORS = {  # which generator makes which of these shapes
    "sphere": "sphere",
    "icosphere": "sphere",
    "quad": "quad",
    "grid": "quad",
    "disc": "disc",
    "box": "box",
    "cylinder": "cylinder",
}
REACH = {  # the radius of the ball about the origin that holds a shape
    "sphere": 1.0,
    "quad": 2.0**0.5,
    "disc": 1.0,
    "box": 3.0**0.5,
    "cylinder": 2.0**0.5,
}
SOLID = ("sphere", "box", "cylinder")  # these have an inside
UP = np.array([0.0, 1.0, 0.0])
MIDDLE = np.zeros(3)
CORNER = np.ones(3)
FACES = np.array([np.cross(right, up) for right, up in BOX_FACES])  # outward, (6, 3)
FACE_AXES = np.array(BOX_FACES, dtype=np.float64)  # right and up of each face, (6, 2, 3)


def meeting(shape: str, origin: Array, direction: Array) -> Array:
    """The first t > 0 at which each ray meets the shape, (N,); `NO_HIT` where it does not."""
    return _MEETINGS[shape](origin, direction)


def _sphere(origin: Array, direction: Array) -> Array:
    return ray_sphere(origin, direction, MIDDLE, 1.0)[0]


def _quad(origin: Array, direction: Array) -> Array:
    steep = direction[:, 1]
    t = -origin[:, 1] / np.where(steep == 0.0, 1.0, steep)
    there = origin[:, ::2] + t[:, None] * direction[:, ::2]
    inside = (np.abs(there[:, 0]) <= 1.0) & (np.abs(there[:, 1]) <= 1.0)
    return np.where(inside & (steep != 0.0) & (t > 0.0), t, NO_HIT)


def _disc(origin: Array, direction: Array) -> Array:
    return ray_disc(origin, direction, MIDDLE, UP, 1.0)


def _box(origin: Array, direction: Array) -> Array:
    entry, leave = ray_box(origin, direction, -CORNER, CORNER)
    t = np.where(entry > 0.0, entry, leave)
    return np.where((entry <= leave) & (t > 0.0), t, NO_HIT)


def _cylinder(origin: Array, direction: Array) -> Array:
    best = ray_tube(origin, direction, -1.0, 1.0)
    for cap in (UP, -UP):
        t = ray_disc(origin, direction, cap, cap, 1.0)
        best = np.where((t > 0.0) & ((best < 0.0) | (t < best)), t, best)
    return best


_MEETINGS: dict[str, Callable[[Array, Array], Array]] = {
    "sphere": _sphere,
    "quad": _quad,
    "disc": _disc,
    "box": _box,
    "cylinder": _cylinder,
}


def on_surface(shape: str, origin: Array, direction: Array, t: Array) -> Array:
    """Where the rays meet the shape after t, put onto it as exactly as can be; (N, 3)."""
    if shape == "sphere":
        return ray_sphere(origin, direction, MIDDLE, 1.0)[1]
    point: Array = origin + t[:, None] * direction
    if shape == "box":
        axis = np.argmax(np.abs(point), axis=1)[:, None]
        face = np.take_along_axis(point, axis, axis=1)
        np.put_along_axis(point, axis, np.copysign(1.0, face), axis=1)
    elif shape == "cylinder":
        cap = _on_cap(point)
        point[cap, 1] = np.copysign(1.0, point[cap, 1])
        side = point[~cap][:, ::2]
        point[~cap, ::2] = side / np.hypot(side[:, 0], side[:, 1])[:, None]
    else:
        point[:, 1] = 0.0
    return point


def _on_cap(point: Array) -> Array:
    """Whether points of the cylinder lie nearer to a cap than to its side, (N,)."""
    from_side = np.abs(np.hypot(point[:, 0], point[:, 2]) - 1.0)
    return np.asarray(np.abs(np.abs(point[:, 1]) - 1.0) < from_side)


def _face(point: Array) -> Array:
    """The row of `FACES` on which points of the box lie, (N,)."""
    return np.asarray(np.argmax(point @ FACES.T, axis=1))


def normal(shape: str, point: Array) -> Array:
    """The unit normal outwards at points of the shape, (N, 3)."""
    if shape == "sphere":
        return point
    if shape == "box":
        return np.asarray(np.take(FACES, _face(point), axis=0), dtype=np.float64)
    upright = np.zeros_like(point)
    if shape == "cylinder":
        cap = _on_cap(point)
        upright[cap, 1] = np.sign(point[cap, 1])
        upright[~cap, ::2] = point[~cap, ::2]
    else:
        upright[:, 1] = 1.0
    return upright


def texcoord(shape: str, point: Array) -> Array:
    """The texture coordinates (u, v) of points of the shape, (N, 2)."""
    x, y, z = point.T
    if shape == "sphere":
        # The angle from the pole by atan2: acos would lose half of the digits there.
        down = np.arctan2(np.hypot(x, z), y) / np.pi
        return np.stack([_turn(x, z), 1.0 - down], axis=1)
    if shape == "box":
        axes = FACE_AXES[_face(point)]
        return np.asarray(0.5 + 0.5 * np.einsum("nij,nj->ni", axes, point))
    flat = 0.5 + 0.5 * np.stack([x, -z], axis=1)
    if shape == "cylinder":
        cap = _on_cap(point)
        flat[:, 1] = np.where(y > 0.0, flat[:, 1], 1.0 - flat[:, 1])
        return np.where(cap[:, None], flat, np.stack([_turn(x, z), 0.5 + 0.5 * y], axis=1))
    return flat


def _turn(x: Array, z: Array) -> Array:
    """How far around the y axis, 0 to 1: counter-clockwise from above, from x on."""
    return np.asarray(np.arctan2(-z, x) / (2.0 * np.pi) % 1.0)
