"""Stepping aside: an explained point keeps its viewer while the camera looks on from the side.

Where one stands, v points into the eye, and the plane of r and v is seen edge-on: nobody
can see ρ. From the side v is an arrow, and ρ an angle.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import atan, cos, degrees, radians, sin, tan
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from playground.explain.pixel import explain
from playground.gui.picture.orbit import orbit, widened
from playground.gui.widget.directions import LEAST
from playground.scene.camera import Camera
from playground.scene.settings import Shading
from playground.scene.setup import Setup

if TYPE_CHECKING:
    from playground.gui.picture.comparison import Picture
    from playground.gui.state import State

Array = NDArray[np.float64]
TURN = 55.0  # degrees: v and ρ are seen large, and the point is still seen from its front
CLOSE = 0.2  # of the way to the eye: for what hides the point from so near by nobody comes nearer
BEFORE = 0.9  # of the way to what hides the point is where the eye then stands
WIDEST = 100.0  # degrees: the widest view that is to make up for standing nearer
MIDDLE = ((1, 1), (3, 3))  # the pixel that sees the target, and the size of its picture


@dataclass(frozen=True)
class Stand:
    """Where the viewer of an explained pixel stands.

    It counts for this pixel alone: a new click is seen from where the camera is then.
    ``due`` asks to turn the camera as soon as the point is known.
    """

    camera: Camera
    pixel: tuple[float, float]
    due: bool = False


def stepped(state: State) -> State:
    """Look at the explained point from the side, or go back to where its viewer stands."""
    if state.pixel is None:
        return state.say("click a point first: then its arrows are seen from the side")
    there = standing(state)
    if there is not None:
        setup = replace(state.setup, camera=there.camera)
        return replace(state.with_setup(setup), stand=None).say("where the viewer stands")
    return replace(state, stand=Stand(state.setup.camera, state.pixel, due=True))


def standing(state: State) -> Stand | None:
    """Where the viewer of the explained pixel stands; None where the camera is the viewer."""
    there = state.stand
    if there is None or there.due or there.pixel != state.pixel:
        return None
    return None if there.camera == state.setup.camera else there


def viewed(state: State, picture: Picture) -> Picture:
    """The picture as the viewer of the explained pixel sees it."""
    there = standing(state)
    if there is None:
        return picture
    camera = widened(there.camera, max(picture.box[2], 1) / max(picture.box[3], 1))
    return replace(picture, setup=replace(picture.setup, camera=camera))


def turned(state: State, point: Array, normal: Array, reflection: Array | None) -> State:
    """The state after the step aside around ``point`` (3,), which has become known."""
    there = state.stand
    assert there is not None
    camera = unhidden(state.setup, aside(state.setup.camera, point, normal, reflection))
    state = state.with_setup(replace(state.setup, camera=camera))
    words = "from the side: v points to where you stood; the picture is the one seen from here"
    return replace(state, stand=replace(there, due=False)).say(words)


def aside(camera: Camera, point: Array, normal: Array, reflection: Array | None) -> Camera:
    """The camera turned by `TURN` about ``point``, out of the plane of r and v.

    Of the two sides it takes the one from which the surface is seen less obliquely.
    """
    offset = np.subtract(camera.eye, point)
    distance = float(np.linalg.norm(offset))
    to_eye, up = offset / distance, np.asarray(camera.up, dtype=np.float64)
    others = [*([] if reflection is None else [reflection]), normal, up, *np.eye(3)]
    across = (np.cross(to_eye, other) for other in others)
    side = next(found for found in across if np.linalg.norm(found) > LEAST)
    side = side / np.linalg.norm(side)
    upright = float(side @ normal) or float(side @ up)
    side = side if upright >= 0.0 else -side
    towards = cos(radians(TURN)) * to_eye + sin(radians(TURN)) * side
    x, y, z = map(float, point)
    eye_x, eye_y, eye_z = map(float, np.add(point, distance * towards))
    moved = replace(camera, eye=(eye_x, eye_y, eye_z), target=(x, y, z))
    return orbit(moved, 0.0, 0.0)  # never straight from above


def unhidden(setup: Setup, camera: Camera) -> Camera:
    """The camera where no wall stands between it and its target: nearer, with a wider view.

    In a room, a step aside often leads behind a wall.
    """
    away = np.subtract(camera.eye, camera.target)
    distance = float(np.linalg.norm(away))
    # Per-fragment shading evaluates the model at the very point that is seen.
    seen = replace(setup, camera=camera).with_(shading=Shading.PER_FRAGMENT)
    corners = explain(seen, *MIDDLE).corners
    free = float(np.linalg.norm(corners[0].position - camera.target)) if corners else 0.0
    if not CLOSE * distance < free < distance:
        return camera
    share = BEFORE * free / distance
    x, y, z = map(float, camera.target + share * away)
    half = atan(tan(radians(0.5 * camera.fov)) / share)
    wide = max(min(2.0 * degrees(half), WIDEST), camera.fov)
    return unhidden(setup, replace(camera, eye=(x, y, z), fov=wide))
