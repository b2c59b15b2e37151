"""From eye-relative space to clip space: where the camera looks and how far it sees.

pyrr builds the projection; it writes matrices for row vectors, so it is transposed here,
once, to the column vectors of the rest of the project.
"""

from __future__ import annotations

from math import hypot

import numpy as np
from numpy.typing import NDArray
from pyrr import matrix44

from playground.errors import PlaygroundError
from playground.scene.camera import Camera

Array = NDArray[np.float64]
Ball = tuple[Array, float]
Triple = tuple[float, ...]
STRAIGHT = 1e-12  # sine of the angle to up below which the picture has no side of its own
NEAREST = 1e-3  # of the scene's radius: nearer than this, the eye is inside something


def view_rotation(camera: Camera) -> Array:
    """The rotation from world axes to x right, y up, z towards the viewer, shape (3, 3)."""
    forward = _unit(tuple(t - e for t, e in zip(camera.target, camera.eye, strict=True)))
    side = _cross(forward, _unit(camera.up))
    if max(map(abs, side)) < STRAIGHT:
        # Looking along up: the next axis serves as up.
        longest = max(range(3), key=lambda i: abs(forward[i]))
        side = _cross(forward, tuple(float(i == (longest + 1) % 3) for i in range(3)))
    side = _unit(side)
    return np.array([side, _cross(side, forward), [-x for x in forward]])


def clip_matrix(camera: Camera, aspect: float, near: float, far: float) -> Array:
    """From eye-relative world axes to clip space (z from −w to w), shape (4, 4)."""
    projection = matrix44.create_perspective_projection(
        camera.fov, aspect, near, far, dtype=np.float64
    ).T
    view = np.eye(4)
    view[:3, :3] = view_rotation(camera)
    return np.asarray(projection @ view)


def fit_depth(camera: Camera, balls: list[Ball]) -> tuple[float, float]:
    """Near and far distance: the camera's own, or as close as the objects' balls allow.

    ``balls`` are centre and radius of every object, in world units.
    """
    distance = [float(np.linalg.norm(centre - np.array(camera.eye))) for centre, _ in balls]
    radius = [r for _, r in balls]
    far = camera.far or 1.01 * max(map(sum, zip(distance, radius, strict=True)), default=1.0)
    gap = min((d - r for d, r in zip(distance, radius, strict=True)), default=0.01 * far)
    near = camera.near or max(0.99 * gap, NEAREST * max(radius, default=1.0), 1e-5 * far)
    if near >= far:
        if camera.near and camera.far:
            raise PlaygroundError("camera.near must be below camera.far", got=(near, far))
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
