"""Rows that all explanations of a pixel have: which pixel, a colour with words, the display."""

from __future__ import annotations

from typing import TYPE_CHECKING

from imgui_bundle import imgui

from playground.explain.pixel import Explanation
from playground.gui.pixel.telling import Line, display_told

if TYPE_CHECKING:
    from playground.explain.stored_pixel import StoredPixel

PLAIN = imgui.ColorEditFlags_.no_tooltip.value | imgui.ColorEditFlags_.no_drag_drop.value


def head(words: str, more: str) -> bool:
    """What is explained, with ``more`` as a tooltip; returns whether it shall be forgotten."""
    imgui.align_text_to_frame_padding()
    imgui.text(words)
    imgui.set_item_tooltip(more)
    imgui.same_line()
    wide = imgui.calc_text_size("×").x + 2 * imgui.get_style().frame_padding.x
    spare = imgui.get_content_region_avail().x - wide
    imgui.set_cursor_pos_x(imgui.get_cursor_pos_x() + max(spare, 0.0))
    forgotten = bool(imgui.button("×##forget"))
    imgui.set_item_tooltip("forget the pixel (Esc, or right click into the picture)")
    return forgotten


def line(told: Line, name: str) -> None:
    """The words of a line behind its colour."""
    swatch(told, name)
    imgui.same_line()
    imgui.text(told.text)


def swatch(told: Line, name: str, large: bool = False) -> None:
    """The colour of a line."""
    side = imgui.get_frame_height() if large else imgui.get_text_line_height()
    size = imgui.ImVec2((2.0 if large else 1.4) * side, side)
    imgui.color_button(f"##{name}", told.colour, PLAIN, size)


def display(why: Explanation | StoredPixel) -> None:
    """From the sum to the code on the screen."""
    told = display_told(why)
    imgui.separator_text("sum and display")
    line(told.colour, "sum")
    imgui.text_disabled(told.steps)
    swatch(told.shown, "shown", large=True)
    imgui.same_line()
    imgui.align_text_to_frame_padding()
    imgui.text(told.shown.text)
    imgui.text_disabled(told.codes)
