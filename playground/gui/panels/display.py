"""From light to the screen, and how the window looks."""

from __future__ import annotations

from dataclasses import replace

from imgui_bundle import imgui

from playground.gui.picture import mark_count
from playground.gui.picture.mark_log import MarkLog
from playground.gui.state import State
from playground.gui.widgets import LABELS, Ui, attempt, edit, label, tooltip
from playground.scene.knob import knobs
from playground.scene.settings import MARKS, Settings
from playground.shading.marks import COLOURS, KINDS, MEANING


def draw(state: State, ui: Ui) -> State:
    """The arithmetic and the steps of the display, then the window itself."""
    steps = ("precision", "exposure", "clamp", "curve", "samples")
    state = mark_count.asked(state, ui.view) if state.setup.settings.marks else state
    settings = _marks(edit(ui, state.setup.settings, only=steps), state.mark_log, ui)
    if settings is not state.setup.settings:
        state = state.with_setup(replace(state.setup, settings=settings))
    imgui.separator()
    return edit(ui, state, only=("theme", "text_size"))


def _marks(settings: Settings, log: MarkLog, ui: Ui) -> Settings:
    """A switch for each kind of mark, with its colour and how many pixels there are of it."""
    label("marks")
    tooltip(knobs(Settings)["marks"])
    chosen = set(settings.marks)
    imgui.same_line(LABELS * imgui.get_font_size())
    left = imgui.get_cursor_pos_x()
    for kind, colour in zip(KINDS, COLOURS, strict=True):
        imgui.set_cursor_pos_x(left)
        red, green, blue = (float(c) / 255.0 for c in colour)
        size = imgui.ImVec2(imgui.get_frame_height(), imgui.get_frame_height())
        flags = imgui.ColorEditFlags_.no_tooltip | imgui.ColorEditFlags_.no_drag_drop
        imgui.color_button(f"##colour of {kind}", imgui.ImVec4(red, green, blue, 1.0), flags, size)
        imgui.same_line()
        _, on = imgui.checkbox(f"{kind}##marks", kind in chosen)
        imgui.set_item_tooltip(MEANING[kind])
        if kind in settings.marks:
            _count(log.count(kind))
        chosen = chosen | {kind} if on else chosen - {kind}
    return attempt(ui, settings, "marks", tuple(kind for kind in MARKS if kind in chosen))


def _count(pixels: int | None) -> None:
    """A number at the right edge."""
    words = "counting" if pixels is None else f"{pixels:,} px"
    imgui.same_line()
    spare = imgui.get_content_region_avail().x - imgui.calc_text_size(words).x
    imgui.set_cursor_pos_x(imgui.get_cursor_pos_x() + max(spare, 0.0))
    imgui.text_disabled(words)
