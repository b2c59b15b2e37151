"""What lies over the pictures of the view, and where each picture comes from."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import moderngl
from imgui_bundle import imgui

from playground.gui.overlay_lines import NO_MARKS, Marks
from playground.gui.picture import gizmo_view, overlays
from playground.gui.picture.canvas import Canvas
from playground.gui.picture.comparison import Picture
from playground.gui.picture.slot import Given
from playground.gui.radiosity import stored_words
from playground.gui.scene_view import Slots
from playground.gui.state import RADIOSITY, State

WAITING, GIVEN_UP = "   computing...", "   given up, not of this setup"
Shown = tuple[Picture, ...]


def textures(state: State, shown: Shown, slots: Slots) -> list[moderngl.Texture]:
    """The texture of every picture, with the lines that are switched on.

    Raises
    ------
    PlaygroundError
        What a renderer refuses.
    """
    _solve(state, shown, slots)
    # The difference is that of the plain pictures; lines come over it.
    marks = NO_MARKS if state.layout == "difference" else marks_of(state, slots)
    found = []
    for i, picture in enumerate(shown):
        if picture.reference or picture.paths:
            found.append(_aside(picture, slots, marks))
        elif picture.traced:
            found.append(_traced(i, picture, slots, marks))
        elif picture.stored:
            of = picture.setup, picture.box[2:], marks, state.solving
            found.append(slots.stored.texture((i, picture.stored), *of))
        else:
            found.append(slots[i].texture(picture.setup, picture.box[2:], marks))
    if not any(picture.reference for picture in shown):
        slots.reference.rest()
    if not any(picture.paths for picture in shown):
        slots.paths.rest()
    if not any(picture.tests for picture in shown):
        slots.traced.tests.rest()
    return found


def _solve(state: State, shown: Shown, slots: Slots) -> None:
    """Go on with radiosity, if it is shown; term by term, the light is that of all terms."""
    stored = {(i, picture.stored): picture for i, picture in enumerate(shown) if picture.stored}
    slots.stored.use(stored)
    solved = [picture.setup for (_, method), picture in stored.items() if method == RADIOSITY]
    slots.stored.solve(solved[-1] if solved else None, state.solving)


def marks_of(state: State, slots: Slots) -> Marks:
    """The lines that are switched on."""
    marks, chalk = state.overlays.marks, state.chalk
    marks = replace(marks, boxes=(state.chosen, chalk.level)) if chalk.boxes else marks
    patches = slots.stored.marked(state.solving)
    return replace(marks, patches=patches) if patches is not None else marks


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


def _aside(picture: Picture, slots: Slots, marks: Marks) -> moderngl.Texture:
    """By NumPy; lines fit the picture that is there, not the one that is being computed."""
    made = slots.paths if picture.paths else slots.reference
    plain = made.texture(picture.setup, picture.box[2:])
    of = made.stamp
    if of is None or not marks:
        return plain
    return slots.marked(Given(plain, (of, made.shows)), of[0], marks)


def captioned(shown: Shown, slots: Slots) -> Shown:
    """The pictures, with a word in the caption where the reference is not of this setup."""
    return tuple(
        replace(picture, caption=(picture.caption + _state(picture, slots)).strip())
        for picture in shown
    )


def _state(picture: Picture, slots: Slots) -> str:
    """What the caption says of a picture that is not there yet, or not of this setup."""
    if picture.stored:
        return stored_words.brief(picture.stored, slots.stored)
    if picture.paths:
        told = slots.paths.told
        return WAITING if slots.paths.computing or told is None else f"   {told.brief}"
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
