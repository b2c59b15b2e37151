"""The explained pixel goes along when its picture gets another size or another place.

A pixel is a share of the width and the height of its picture, and wider pictures see
further to the sides: the same share would show another point as soon as the controls are
hidden or the layout changes.
"""

from __future__ import annotations

from dataclasses import replace
from math import radians, tan

from playground.gui.picture.comparison import pictures
from playground.gui.picture.orbit import widened
from playground.gui.picture.stand import standing
from playground.gui.state import State
from playground.render.projection import vertical_angle
from playground.scene.camera import Camera

Size = tuple[int, int]
Share = tuple[float, float]
TWINS = ("side by side", "wipe")  # layouts with the same two pictures


def kept(state: State, view: Size) -> State:
    """The state in which the same point is explained in a view of this size.

    In the term by term layout it is explained in the sum. A point that is not in the
    picture any more is forgotten.
    """
    if state.pixel is None:
        return state
    number = _number(state)
    shown = pictures(state, *view)
    number = min(number, len(shown) - 1)
    size = shown[number].box[2:]
    seen = (state.layout, size)
    if state.clue.seen == seen:
        return state
    before = state.clue.seen[1] if state.clue.seen else size
    there = standing(state)
    pixel = moved(state.pixel, there.camera if there else state.setup.camera, before, size)
    if not all(0.0 <= share < 1.0 for share in pixel):
        return state.unpicked()
    stand = replace(there, pixel=pixel) if there else state.stand
    clue = replace(state.clue, picture=number, seen=seen)
    return replace(state, pixel=pixel, clue=clue, stand=stand)


def _number(state: State) -> int:
    """Which picture of the layout is explained."""
    number, seen = state.clue.picture, state.clue.seen
    if seen is None or seen[0] == state.layout:
        return number
    if state.layout == "terms":
        return len(pictures(state, 1, 1)) - 1
    return number if {seen[0], state.layout} <= {*TWINS} else 0


def moved(pixel: Share, camera: Camera, before: Size, after: Size) -> Share:
    """Where a picture of size ``after`` shows what was at the share ``pixel`` of another size."""
    if before == after:
        return pixel
    (wide, high), (wider, higher) = _reach(camera, before), _reach(camera, after)
    across = (2.0 * pixel[0] - 1.0) * wide / wider
    down = (2.0 * pixel[1] - 1.0) * high / higher
    return 0.5 * (across + 1.0), 0.5 * (down + 1.0)


def _reach(camera: Camera, size: Size) -> tuple[float, float]:
    """How far a picture sees to the side and up, at distance 1."""
    aspect = max(size[0], 1) / max(size[1], 1)
    high = tan(radians(vertical_angle(widened(camera, aspect), aspect)) / 2.0)
    return high * aspect, high
