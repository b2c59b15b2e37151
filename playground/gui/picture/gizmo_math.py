"""From the mouse to the world and back: where a thing is seen, and where a drag takes it.

Pixels are counted from the upper left corner of the picture. Every drag is computed from
where it began, never from frame to frame: rounding cannot add up.
"""

from __future__ import annotations

from functools import lru_cache
from math import cos, floor, log10, pi, sin, sqrt

import numpy as np
from numpy.typing import ArrayLike, NDArray

from playground.render.surface import Surface, surfaces
from playground.render.view import View, view_of
from playground.scene.camera import Camera
from playground.scene.scene import Scene
from playground.scene.settings import Settings

Array = NDArray[np.float64]
Size = tuple[int, int]
Pixel = tuple[float, float]
EVERY_TERM = Settings().weights
PLACES = 5  # decimals that are kept of a number as large as the scene
FURTHER = 1.05  # times as far from the eye is what is pushed by one step
MOST_STEPS = 200.0  # either way
LEAST_SINE = 0.08  # an axis seen at a smaller angle is no handle: a pixel would be miles


@lru_cache(maxsize=8)
def surfaces_of(scene: Scene) -> tuple[Surface, ...]:
    """The surfaces of a scene, for their places; their colours have every term."""
    return surfaces(scene, EVERY_TERM)


@lru_cache(maxsize=16)
def seen(scene: Scene, camera: Camera, size: Size) -> View:
    """The view that a picture of ``size`` has."""
    return view_of(camera, surfaces_of(scene), size)


def depth(view: View, point: ArrayLike) -> float:
    """How far along the view direction a world point (3,) lies; negative behind the eye."""
    return -float(view.camera_from_world[2] @ np.subtract(point, view.eye))


def placed(view: View, point: ArrayLike, size: Size, margin: float) -> tuple[Pixel, bool]:
    """Where a handle for a world point stands: its pixel, and whether the point is seen there.

    A point outside the picture has its handle at the rim, on the side where it lies.
    """
    x, y, z = view.camera_from_world @ np.subtract(point, view.eye)
    width, height = size
    middle = np.array([width / 2.0, height / 2.0])
    room = np.maximum(middle - margin, 1.0)
    if z < 0.0:
        offset = np.array([x, -y]) / (-z * view.pixel(height))
        if np.all(np.abs(offset) <= room):
            return _pixel(middle + offset), True
    else:
        offset = np.array([x, -y])
    largest = float(np.max(np.abs(offset) / room))
    offset = offset / largest if largest > 0.0 else np.array([0.0, -room[1]])
    return _pixel(middle + offset), False


def plane_move(view: View, point: ArrayLike, size: Size, moved: Pixel) -> Array:
    """The world vector (3,) by which a point follows the mouse, parallel to the screen."""
    far = max(abs(depth(view, point)), view.near)
    step = far * view.pixel(size[1])
    right, up, _ = view.camera_from_world
    return np.asarray(step * (moved[0] * right - moved[1] * up))


def sight_move(view: View, point: ArrayLike, size: Size, moved: Pixel, steps: float) -> Array:
    """The world vector (3,) of a drag parallel to the screen, then along the line of sight.

    Each of the ``steps`` goes `FURTHER` times as far from the eye; the point stays on its pixel.
    """
    offset = np.subtract(point, view.eye)
    factor = FURTHER ** min(max(steps, -MOST_STEPS), MOST_STEPS)
    return np.asarray(factor * (offset + plane_move(view, point, size, moved)) - offset)


def ray(view: View, size: Size, pixel: Pixel) -> Array:
    """The unit direction (3,) from the eye through a pixel."""
    step = view.pixel(size[1])
    right, up, back = view.camera_from_world
    direction = (
        step * (pixel[0] - size[0] / 2.0) * right - step * (pixel[1] - size[1] / 2.0) * up - back
    )
    return np.asarray(direction / np.linalg.norm(direction))


def axis_move(view: View, point: ArrayLike, axis: Array, size: Size, moved: Pixel) -> float | None:
    """How far along a unit ``axis`` (3,) a point comes nearest to the mouse.

    None where the axis points at the eye, or the point is not before it.
    """
    if depth(view, point) <= 0.0:
        return None
    start, _ = view.window(np.asarray(point, dtype=np.float64), size)
    u = ray(view, size, (float(start[0]) + moved[0], float(start[1]) + moved[1]))
    along = float(u @ axis)
    sine = 1.0 - along * along
    if sine < LEAST_SINE**2:
        return None
    w = np.subtract(point, view.eye)
    # Nearest point of two lines. Source: Ericson, Real-Time Collision Detection, 2005, 5.1.8.
    return float((along * float(u @ w) - float(axis @ w)) / sine)


def facing(view: View, centre: Array, towards: Array, radius: float) -> bool:
    """Whether the point of a ball in direction ``towards`` (3,) is on the eye's side of it."""
    return bool(towards @ (view.eye - (centre + radius * towards)) >= 0.0)


def turned_on_ball(
    view: View, centre: Array, radius: float, towards: Array, size: Size, moved: Pixel
) -> Array:
    """The unit direction (3,) after its point on a ball was dragged by pixels.

    The point stays under the mouse; beyond the rim of the ball it goes on behind it.
    """
    near_side = facing(view, centre, towards, radius)
    start, _ = view.window(centre + radius * towards, size)
    u = ray(view, size, (float(start[0]) + moved[0], float(start[1]) + moved[1]))
    middle = centre - view.eye
    along = float(u @ middle)
    inside = along * along - (float(middle @ middle) - radius * radius)
    if inside >= 0.0:
        root = sqrt(inside)
        t = along - root if near_side and along > root else along + root
        offset = t * u - middle
        return np.asarray(offset / np.linalg.norm(offset))
    rim = along * u - middle
    distance = float(np.linalg.norm(rim))
    beyond = min(distance / radius - 1.0, pi / 2.0)
    behind = u if near_side else -u
    return np.asarray(cos(beyond) * rim / distance + sin(beyond) * behind)


def neat(values: ArrayLike, unit: float) -> tuple[float, float, float]:
    """Three numbers with as many decimals as make sense for a scene of the size ``unit``."""
    decimals = PLACES - floor(log10(unit)) if unit > 0.0 else PLACES
    x, y, z = (round(float(value), decimals) for value in np.asarray(values))
    return x, y, z


def _pixel(place: Array) -> Pixel:
    return float(place[0]), float(place[1])
