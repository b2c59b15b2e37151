"""What lies over the pictures of the view, and where each picture comes from."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import moderngl
from imgui_bundle import imgui

from playground.gui import gizmo_view, overlays
from playground.gui.canvas import Canvas
from playground.gui.comparison import Picture
from playground.gui.overlay_lines import NO_MARKS, Marks
from playground.gui.scene_view import Given, Slots
from playground.gui.state import State

WAITING, GIVEN_UP = "   computing...", "   given up, not of this setup"
Shown = tuple[Picture, ...]


def textures(state: State, shown: Shown, slots: Slots) -> list[moderngl.Texture]:
    """The texture of every picture, with the lines that are switched on.

    Raises
    ------
    PlaygroundError
        What a renderer refuses.
    """
    # The difference is that of the plain pictures; lines come over it.
    marks = NO_MARKS if state.layout == "difference" else marks_of(state)
    found = []
    for i, picture in enumerate(shown):
        if picture.reference:
            found.append(_reference(picture, slots, marks))
        elif picture.traced:
            found.append(_traced(i, picture, slots, marks))
        else:
            found.append(slots[i].texture(picture.setup, picture.box[2:], marks))
    if not any(picture.reference for picture in shown):
        slots.reference.rest()
    if not any(picture.tests for picture in shown):
        slots.traced.tests.rest()
    return found


def marks_of(state: State) -> Marks:
    """The lines that are switched on."""
    marks, chalk = state.overlays.marks, state.chalk
    return replace(marks, boxes=(state.chosen, chalk.level)) if chalk.boxes else marks


def numbers(shown: Shown) -> tuple[list[int], list[int]]:
    """Which of the pictures GL draws triangle by triangle, and which are ray traced."""
    rastered = [i for i, picture in enumerate(shown) if picture.rastered]
    return rastered, [i for i, picture in enumerate(shown) if picture.traced and not picture.tests]


def _traced(number: int, picture: Picture, slots: Slots, marks: Marks) -> moderngl.Texture:
    """Ray by ray, or how much each ray tests, with lines over it."""
    if picture.tests:
        texture, stamp = slots.traced.tested(picture.setup, picture.box[2:])
    else:
        texture, stamp = slots.traced.texture(number, picture.setup, picture.box[2:])
    if not marks:
        return texture
    return slots.marked(Given(texture, (number, stamp)), picture.setup, marks)


def _reference(picture: Picture, slots: Slots, marks: Marks) -> moderngl.Texture:
    """The reference; lines fit the picture that is there, not the one that is being computed."""
    plain = slots.reference.texture(picture.setup, picture.box[2:])
    of = slots.reference.stamp
    if of is None or not marks:
        return plain
    return slots.marked(Given(plain, of), of[0], marks)


def captioned(shown: Shown, slots: Slots) -> Shown:
    """The pictures, with a word in the caption where the reference is not of this setup."""
    return tuple(
        replace(picture, caption=picture.caption + _state(picture, slots)) for picture in shown
    )


def _state(picture: Picture, slots: Slots) -> str:
    """What the caption says of a picture by NumPy that is not of this setup."""
    if picture.tests:
        made, name = slots.traced.tests, "tests of each ray"
    elif picture.reference:
        made, name = slots.reference, ""
    else:
        return ""
    if not made.computing:
        return name
    return name + (WAITING if made.coming else GIVEN_UP)


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
