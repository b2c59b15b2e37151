"""One frame of the window: state in, state out."""

from __future__ import annotations

from dataclasses import replace

from imgui_bundle import imgui

from playground.gui import guess, menu, sheets, status, view
from playground.gui.measure import scope_path
from playground.gui.panels import OPEN_AT_FIRST, PANELS, lesson, shaders
from playground.gui.picture import same_point, waiting
from playground.gui.picture.comparison import Box
from playground.gui.picture.navigation import walked
from playground.gui.presentation import backdrop, presenting, shows
from playground.gui.radiosity import radiosity_told, stored_words
from playground.gui.rays.tracing_told import told
from playground.gui.scene_view import Slots
from playground.gui.shortcuts import pressed
from playground.gui.state import State
from playground.gui.widget import out_of_sight, theme
from playground.gui.widgets import Ui

PANEL_WIDTH = 390.0  # pixels, at text size 1
WIDEST_PANEL = 0.45  # of the window
LEAST_VIEW = 0.36  # of the window: between lesson and controls, which give way for it
NARROWEST = 290.0  # pixels that each of them keeps, at text size 1
FIXED = (
    imgui.WindowFlags_.no_title_bar.value
    | imgui.WindowFlags_.no_resize.value
    | imgui.WindowFlags_.no_move.value
    | imgui.WindowFlags_.no_collapse.value
    | imgui.WindowFlags_.no_saved_settings.value
    | imgui.WindowFlags_.no_bring_to_front_on_focus.value
    | imgui.WindowFlags_.no_nav_inputs.value
)
SETTLED = 5  # frames for which a panel that unfolds is kept on top
WHEEL_PAUSE = 0.4  # seconds: notches of the wheel closer than this are one step of undo


class Hand:
    """Whether the user holds on to something, so that changes make one step of undo."""

    def __init__(self) -> None:
        self.wheel_seconds = WHEEL_PAUSE

    def holds(self, dragging: bool, seconds: float) -> bool:
        """Whether a drag, a repeated key or a run of the wheel is under way."""
        io = imgui.get_io()
        turning = bool(io.mouse_wheel or io.mouse_wheel_h) and not imgui.is_any_item_active()
        self.wheel_seconds = 0.0 if turning else self.wheel_seconds + seconds
        return dragging or imgui.is_any_item_active() or self.wheel_seconds < WHEEL_PAUSE


def draw(
    state: State, slots: Slots, hand: Hand, seconds: float, density: float, numbers: str
) -> State:
    """Build the interface for ``state`` and return the state that the user made of it.

    Parameters
    ----------
    state : State
    slots : Slots
        Where the pictures are drawn.
    hand : Hand
    seconds : float
        Since the frame before.
    density : float
        Of the screen; 1 for an ordinary one.
    numbers : str
        What the status line says of renderer and times.
    """
    before, scale = state, state.text_size * density
    theme.apply(state.theme, state.text_size, density)
    theme.lay_paper(backdrop(state))
    ui = Ui(scale)
    state = replace(state, hint="") if state.hint else state
    state = guess.unpeeked(walked(state, min(seconds, 0.1)))
    state = scope_path.walked(state, min(seconds, 0.1))
    state = pressed(state)
    state = state if presenting(state) else menu.draw(state)
    view_box, panel_box, foot_box = areas(state, scale)
    ui.view = pixels(view_box)
    ui.tracing, ui.atlas = told(slots.traced), slots.atlas
    state = slots.factors.advance(same_point.kept(state, ui.view), slots.stored.radiosity)
    ui.factors = slots.factors.now
    ui.radiosity, ui.stored = radiosity_told.told(slots.stored), slots.stored
    if state.panel:
        _place(panel_box)
        state = _controls(state, ui)
    if state.lesson is not None:
        _place(beside(view_box, panel_box))
        state = _lesson(state, slots)
    _place(view_box)
    state = same_point.kept(state, ui.view)
    state, dragging = _view(state, before, slots, scale)
    if state.shaders:
        _place(below(view_box, panel_box))
        state = _shaders(state, ui)
    if ui.refused:
        state = state.fail(ui.refused[-1])
    if foot_box[3]:
        _place(foot_box)
        _foot(state, numbers, stored_words.status(slots))
    state = waiting.draw(sheets.draw(state), slots.reference, view_box)
    moving = dragging or state.playing or state.scope.playing
    return remembered(before, without_old_error(before, state), hand.holds(moving, seconds))


def without_old_error(before: State, after: State) -> State:
    """The state without an old error, once something else has been done and has gone well.

    While the camera walks the setup changes by itself, and an error is still to be read.
    """
    old = before.failed and after.failed and before.message == after.message
    done = after.setup is not before.setup or after.method != before.method
    walks = after.playing or after.scope.playing
    return after.say("") if old and done and not walks else after


def areas(state: State, scale: float) -> tuple[Box, Box, Box]:
    """Where view, controls and status line are: x, y, width, height in ImGui's units."""
    space = imgui.get_main_viewport()
    x, y = round(space.work_pos.x), round(space.work_pos.y)
    width, height = round(space.work_size.x), round(space.work_size.y)
    foot = round(status.ROWS * imgui.get_text_line_height_with_spacing() + 8 * scale)
    foot = 0 if presenting(state) and not state.failed else foot
    wide = round(min(PANEL_WIDTH * scale, WIDEST_PANEL * width)) if state.panel else 0
    low = shaders.height(state, height - foot)
    read, wide = between(lesson.width(state, width, scale), wide, width, scale)
    return (
        (x + read, y, width - wide - read, height - foot - low),
        (x + width - wide, y, wide, height - foot),
        (x, y + height - foot, width, foot),
    )


def between(read: int, wide: int, width: int, scale: float) -> tuple[int, int]:
    """Widths of lesson and controls that leave room for the picture between them."""
    if not (read and wide):
        return read, wide
    missing = max(round(LEAST_VIEW * width) - (width - read - wide), 0)
    spare = [max(x - round(NARROWEST * scale), 0) for x in (read, wide)]
    given = min(missing, sum(spare))
    first = round(given * spare[0] / max(sum(spare), 1))
    return read - first, wide - (given - first)


def below(view: Box, panel: Box) -> Box:
    """What is left for the shaders under the view, in ImGui's units."""
    x, y, width, height = view
    return x, y + height, width, panel[1] + panel[3] - y - height


def beside(view: Box, panel: Box) -> Box:
    """What is left for the lesson, to the left of the view, in ImGui's units."""
    x, y = round(imgui.get_main_viewport().work_pos.x), panel[1]
    return x, y, view[0] - x, panel[3]


def pixels(box: Box) -> tuple[int, int]:
    """Width and height of a box in pixels of the framebuffer."""
    dense = imgui.get_io().display_framebuffer_scale
    return max(int(box[2] * dense.x), 1), max(int(box[3] * dense.y), 1)


def remembered(before: State, after: State, held: bool) -> State:
    """Keep the step in the history, unless it was a step through the history."""
    if after.history is not before.history:
        return after
    history = before.history.record(before.moment, after.moment, held)
    return after if history is before.history else replace(after, history=history)


def _place(box: Box) -> None:
    x, y, width, height = box
    imgui.set_next_window_pos(imgui.ImVec2(x, y))
    imgui.set_next_window_size(imgui.ImVec2(max(width, 1), max(height, 1)))


def _controls(state: State, ui: Ui) -> State:
    """The panels, one below the other."""
    imgui.begin("Controls", None, FIXED)
    wanted = ""
    for name, panel in PANELS.items():
        if not shows(state, name):
            continue
        imgui.set_next_item_open(name in OPEN_AT_FIRST, imgui.Cond_.once)
        if name == state.unfold:
            imgui.set_next_item_open(True)
        opened = imgui.collapsing_header(name)
        if name == state.unfold:
            imgui.set_scroll_here_y(0.0)
            wanted = name if _unsettled(name) else ""
        if opened:
            imgui.push_id(name)
            state = out_of_sight.drawn(panel, state, ui)
            imgui.pop_id()
            imgui.spacing()
    imgui.end()
    return state if state.unfold == wanted else replace(state, unfold=wanted)


def _unsettled(name: str) -> bool:
    """Whether a panel that unfolds is to be scrolled to in the next frame, too.

    It has a height only then, and panels above it change theirs when the scene is another.
    """
    storage, key = imgui.get_state_storage(), imgui.get_id(f"{name} unfolds")
    frames = storage.get_int(key, 0) + 1
    storage.set_int(key, frames % SETTLED)
    return frames < SETTLED


def _view(state: State, good: State, slots: Slots, scale: float) -> tuple[State, bool]:
    imgui.push_style_var(imgui.StyleVar_.window_padding, imgui.ImVec2(0, 0))
    imgui.push_style_var(imgui.StyleVar_.window_border_size, 0.0)
    imgui.begin("View", None, FIXED | imgui.WindowFlags_.no_scrollbar.value)
    state, dragging = view.draw_safely(state, good, slots, scale)
    imgui.end()
    imgui.pop_style_var(2)
    return state, dragging


def _lesson(state: State, slots: Slots) -> State:
    imgui.begin("Lesson", None, FIXED)
    state = lesson.draw(state, slots.lesson)
    imgui.end()
    return state


def _shaders(state: State, ui: Ui) -> State:
    imgui.begin("Shaders", None, FIXED | imgui.WindowFlags_.no_scrollbar.value)
    state = shaders.draw(state, ui)
    imgui.end()
    return state


def _foot(state: State, numbers: str, light: str) -> None:
    imgui.push_style_var(imgui.StyleVar_.window_padding, imgui.ImVec2(10, 4))
    imgui.begin("Status", None, FIXED | imgui.WindowFlags_.no_scrollbar.value)
    status.draw(state, numbers, light)
    imgui.end()
    imgui.pop_style_var()
