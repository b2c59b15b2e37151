"""From eye-relative space to clip space: where the camera looks and how far it sees.

pyrr builds the projection; it writes matrices for row vectors, so it is transposed here,
once, to the column vectors of the rest of the project.
"""

from __future__ import annotations

from functools import lru_cache
from math import atan, degrees, hypot, radians, tan

import numpy as np
from numpy.typing import NDArray
from pyrr import matrix44

from playground.errors import PlaygroundError
from playground.scene.camera import Camera

Array = NDArray[np.float64]
Ball = tuple[Array, float]
Triple = tuple[float, ...]
STRAIGHT = 1e-12  # sine of the angle to up below which the picture has no side of its own
NEAREST = 1e-3  # of an object's radius: nearer than this, the eye is inside it
SMALLEST_NEAR = 1e-5  # of far: below, a depth buffer of 24 bits holds too few steps


@lru_cache(maxsize=8)
def view_rotation(camera: Camera) -> Array:
    """The rotation from world axes to x right, y up, z towards the viewer, (3, 3), read-only."""
    forward = _unit(tuple(t - e for t, e in zip(camera.target, camera.eye, strict=True)))
    side = _cross(forward, _unit(camera.up))
    if max(map(abs, side)) < STRAIGHT:
        # Looking along up: the next axis serves as up.
        longest = max(range(3), key=lambda i: abs(forward[i]))
        side = _cross(forward, tuple(float(i == (longest + 1) % 3) for i in range(3)))
    side = _unit(side)
    rotation = np.array([side, _cross(side, forward), [-x for x in forward]])
    rotation.setflags(write=False)
    return rotation


def vertical_angle(camera: Camera, aspect: float) -> float:
    """The vertical angle of view in degrees for a picture of width / height = ``aspect``.

    The camera's own angle is across the shorter side: what fits into a landscape picture
    fits into a portrait one.
    """
    if aspect >= 1.0:
        return camera.fov
    return degrees(2.0 * atan(tan(radians(camera.fov) / 2.0) / aspect))


def clip_matrix(camera: Camera, aspect: float, near: float, far: float) -> Array:
    """From eye-relative world axes to clip space (z from −w to w), shape (4, 4)."""
    projection = matrix44.create_perspective_projection(
        vertical_angle(camera, aspect), aspect, near, far, dtype=np.float64
    ).T
    view = np.eye(4)
    view[:3, :3] = view_rotation(camera)
    return np.asarray(projection @ view)


def depths(camera: Camera, centres: list[Array]) -> list[float]:
    """How far along the view direction points (3,) lie, in world units."""
    forward = -view_rotation(camera)[2]
    eye = np.array(camera.eye)
    return [float(forward @ (centre - eye)) for centre in centres]


def fit_depth(camera: Camera, balls: list[Ball]) -> tuple[float, float]:
    """Near and far distance: the camera's own, or as close as the objects' balls allow.

    ``balls`` are centre and radius of every object, in world units. Near and far are
    distances along the view direction, not from the eye.

    Raises
    ------
    PlaygroundError
        The camera's own near distance is too small beside far for a float32 depth.
    """
    depth = depths(camera, [centre for centre, _ in balls])
    ahead = [(d - r, d + r, r) for d, (_, r) in zip(depth, balls, strict=True) if d + r > 0.0]
    far = camera.far or 1.01 * max((end for _, end, _ in ahead), default=1.0)
    gap = min((start for start, _, _ in ahead), default=0.5 * far)
    closest = NEAREST * min((radius for _, _, radius in ahead if radius > 0.0), default=far)
    near = camera.near or max(0.99 * gap, min(closest, 0.5 * far))
    if near < SMALLEST_NEAR * far:
        if camera.near:
            raise PlaygroundError(
                "camera.near is too small beside far: float32 could not tell depths apart",
                got=f"near {near:g}, far {far:g}",
                allowed=f"near of at least {SMALLEST_NEAR:g} far",
                fix="Raise near, or set near = 0, which fits it to the scene.",
            )
        near = SMALLEST_NEAR * far
    if near >= far:  # everything lies before near or beyond far: an empty picture is right
        near, far = (near, 2.0 * near) if camera.near else (0.5 * far, far)
    return near, far


def _unit(v: Triple) -> Triple:
    largest = max(map(abs, v))
    x, y, z = (component / largest for component in v)
    norm = hypot(x, y, z)
    return x / norm, y / norm, z / norm


def _cross(a: Triple, b: Triple) -> Triple:
    # Three numbers: NumPy's cross takes fifty times as long, at every frame.
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]
