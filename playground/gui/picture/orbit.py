"""Moving the camera: pure functions from camera to camera.

The eye walks on a sphere about the target, in yaw about ``up`` and pitch above the
horizon. The pitch stops just short of the poles, so the picture never flips over.
"""

from __future__ import annotations

from dataclasses import replace
from math import asin, atan2, cos, degrees, radians, sin, tan

import numpy as np
from numpy.typing import NDArray

from playground.render.projection import view_rotation
from playground.scene.camera import Camera

Array = NDArray[np.float64]
STEEPEST = 89.0  # degrees of pitch: at 90 the view direction would meet up


def orbit(camera: Camera, yaw: float, pitch: float) -> Camera:
    """The eye walks ``yaw`` degrees to the right and ``pitch`` degrees up around the target."""
    up, ahead, aside = _axes(camera)
    offset = np.subtract(camera.eye, camera.target)
    distance = float(np.linalg.norm(offset))
    height = float(np.clip(offset @ up / distance, -1.0, 1.0))
    around = atan2(float(offset @ aside), float(offset @ ahead)) + radians(yaw)
    above = radians(float(np.clip(degrees(asin(height)) + pitch, -STEEPEST, STEEPEST)))
    level = cos(around) * ahead + sin(around) * aside
    return _standing(camera, camera.target + distance * (cos(above) * level + sin(above) * up))


def pan(camera: Camera, right: float, up: float) -> Camera:
    """Eye and target move in the plane of the picture, in heights of the picture."""
    side, above, _ = view_rotation(camera)
    distance = float(np.linalg.norm(np.subtract(camera.eye, camera.target)))
    height = 2.0 * distance * tan(radians(camera.fov) / 2.0)
    move = height * (right * side + up * above)
    return _standing(camera, np.add(camera.eye, move), np.add(camera.target, move))


def dolly(camera: Camera, factor: float, nearest: float, farthest: float) -> Camera:
    """The eye goes to ``factor`` times its distance from the target, within limits.

    A camera that is already outside the limits may come back, not go further.
    """
    offset = np.subtract(camera.eye, camera.target)
    distance = float(np.linalg.norm(offset))
    wanted = float(np.clip(distance * factor, min(nearest, distance), max(farthest, distance)))
    return _standing(camera, camera.target + offset * (wanted / distance))


def widened(camera: Camera, aspect: float, least: float = 4.0 / 3.0) -> Camera:
    """The camera for a narrow picture: it sees as far to the sides as one of aspect ``least``."""
    if aspect >= least:
        return camera
    # The angle of view is that across the shorter side, so of a portrait it is the width's.
    half = tan(radians(camera.fov) / 2.0) * least / max(aspect, 1.0)
    return replace(camera, fov=min(2.0 * degrees(atan2(half, 1.0)), 170.0))


def _axes(camera: Camera) -> tuple[Array, Array, Array]:
    """Unit vectors: up, and two level ones that depend on up alone."""
    up = np.asarray(camera.up, dtype=np.float64)
    up = up / np.linalg.norm(up)
    helper = np.eye(3)[(int(np.argmax(np.abs(up))) + 1) % 3]
    ahead = helper - (helper @ up) * up
    ahead = ahead / np.linalg.norm(ahead)
    return up, ahead, np.cross(up, ahead)


def _standing(camera: Camera, eye: Array, target: Array | None = None) -> Camera:
    place = {"eye": tuple(map(float, eye))}
    if target is not None:
        place["target"] = tuple(map(float, target))
    return replace(camera, **place)  # type: ignore[arg-type]
