"""From eye-relative space to clip space: where the camera looks and how far it sees.

pyrr builds both matrices; it writes them for row vectors, so they are transposed here,
once, to the column vectors of the rest of the project.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from pyrr import matrix44

from playground.errors import PlaygroundError
from playground.scene.camera import Camera

Array = NDArray[np.float64]
Ball = tuple[Array, float]
NEAREST = 1e-3  # of the scene's radius: nearer than this, the eye is inside something


def view_rotation(camera: Camera) -> Array:
    """The rotation from world axes to x right, y up, z towards the viewer, shape (3, 3)."""
    forward = np.subtract(camera.target, camera.eye)
    forward /= np.max(np.abs(forward))
    up = np.array(camera.up)
    up /= np.max(np.abs(up))
    side = np.cross(forward, up)
    if np.dot(side, side) < 1e-24 * np.dot(forward, forward):
        # Looking along up: any other direction serves as up.
        up = np.roll(np.eye(3)[np.argmax(np.abs(forward))], 1)
    view = matrix44.create_look_at(np.zeros(3), forward, up, dtype=np.float64)
    return np.asarray(view.T[:3, :3], dtype=np.float64)


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
