"""What the user waits for, in a box at the foot of the picture, with a way to stop it."""

from __future__ import annotations

from dataclasses import replace

from imgui_bundle import imgui

from playground.gui.picture.comparison import Box
from playground.gui.picture.reference import ReferencePicture
from playground.gui.state import State
from playground.gui.work import progress_bar
from playground.gui.work.long_work import Progress

PATIENCE = 0.4  # seconds: what is done by then is not worth a box
WIDE = 24  # of the box, in heights of the text
FLAGS = (
    imgui.WindowFlags_.no_title_bar.value
    | imgui.WindowFlags_.no_resize.value
    | imgui.WindowFlags_.no_move.value
    | imgui.WindowFlags_.no_saved_settings.value
    | imgui.WindowFlags_.always_auto_resize.value
    | imgui.WindowFlags_.no_focus_on_appearing.value
    | imgui.WindowFlags_.no_nav_inputs.value
)


def draw(state: State, reference: ReferencePicture, view: Box) -> State:
    """A box for a file that is being read, and for the reference picture."""
    reading, picture = state.reading, reference.progress
    if reading is not None and _waits(reading.progress):
        cancelled = _box("reading", reading.words, reading.progress, view, 0)
        if cancelled:
            state = replace(state, reading=None).say(f"{reading.name} was not opened")
    if picture is not None and _waits(picture):
        row = int(reading is not None)
        if _box("reference", "the reference picture, in float64", picture, view, row):
            reference.give_up()
            state = state.say("the reference picture was given up; any change begins it anew")
    return state


def _waits(progress: Progress) -> bool:
    return progress.elapsed > PATIENCE


def _box(name: str, words: str, progress: Progress, view: Box, row: int) -> bool:
    """One box; the second stands above the first. Returns whether Cancel was pressed."""
    x, y, width, height = view
    size = imgui.get_font_size()
    wide = min(WIDE * size, width - 2.0 * size)
    low = y + height - size - 5.0 * size * row
    imgui.set_next_window_pos(
        imgui.ImVec2(x + 0.5 * width, low), imgui.Cond_.always, imgui.ImVec2(0.5, 1.0)
    )
    imgui.set_next_window_size(imgui.ImVec2(wide, 0.0))
    imgui.begin(f"###waiting {name}", None, FLAGS)
    imgui.text_unformatted(words)
    cancelled = progress_bar.draw(progress)
    imgui.end()
    return cancelled
