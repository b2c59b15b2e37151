"""What lies over the pictures of the view, and where each picture comes from."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import moderngl
from imgui_bundle import imgui

from playground.gui import gizmo_view, overlays
from playground.gui.canvas import Canvas
from playground.gui.comparison import Picture
from playground.gui.overlay_lines import NO_MARKS
from playground.gui.scene_view import Slots
from playground.gui.state import State

WAITING = "   computing..."
Shown = tuple[Picture, ...]


def textures(state: State, shown: Shown, slots: Slots) -> list[moderngl.Texture]:
    """The texture of every picture, with the lines that are switched on.

    Raises
    ------
    PlaygroundError
        What a renderer refuses.
    """
    # Lines in both pictures would hide the difference below them.
    marks = NO_MARKS if state.layout == "difference" else state.overlays.marks
    found = []
    for i, picture in enumerate(shown):
        if picture.reference:
            found.append(slots.reference.texture(picture.setup, picture.box[2:]))
        else:
            found.append(slots[i].texture(picture.setup, picture.box[2:], marks))
    if not any(picture.reference for picture in shown):
        slots.reference.rest()
    return found


def captioned(shown: Shown, slots: Slots) -> Shown:
    """The pictures, with a word in the caption while the reference is not ready."""
    word = WAITING if slots.reference.computing else ""
    return tuple(
        replace(picture, caption=picture.caption + word) if picture.reference else picture
        for picture in shown
    )


def stages(state: State, shown: Shown) -> Shown:
    """The pictures that carry handles and drawings: one per box, of the terms only the sum."""
    if state.layout == "terms":
        return shown[-1:]
    return tuple({picture.box: picture for picture in shown}.values())


def held(state: State, shown: Shown, origin: Any, dense: Any, scale: float) -> State:
    """The state in which a handle has followed the mouse."""
    for i, picture in enumerate(stages(state, shown)):
        canvas = Canvas(origin, dense, scale, picture.box)
        imgui.push_id(i)
        try:
            state = gizmo_view.held(state, picture.setup, canvas)
        finally:
            imgui.pop_id()
    return state


def draw(state: State, shown: Shown, origin: Any, dense: Any, scale: float) -> None:
    """Drawings and handles over the pictures."""
    for picture in stages(state, shown):
        canvas = Canvas(origin, dense, scale, picture.box)
        overlays.draw(state.overlays, picture.setup, canvas)
        gizmo_view.draw(state, picture.setup, canvas)
