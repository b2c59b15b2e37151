"""Symbols of the lecture with real subscripts and superscripts: ``s_d``, ``(r·v)^sh``."""

from __future__ import annotations

import re

from imgui_bundle import imgui

SMALL = 0.72  # size of a subscript
LOW, HIGH = 0.38, -0.18  # how far it is shifted, in heights of the text
PARTS = re.compile(r"([_^])(\w+(?:\.\d+)?)|([^_^]+)")


def typeset(text: str, at: imgui.ImVec2, size: float, colour: int, paint: bool = True) -> float:
    """Draw ``text`` with its upper left corner ``at``; returns its width.

    ``_x`` lowers and ``^x`` raises the letters and digits that follow.
    """
    font, x = imgui.get_font(), at.x
    draw = imgui.get_window_draw_list()
    for mark, shifted, plain in PARTS.findall(text):
        part, height = (plain, size) if plain else (shifted, round(SMALL * size))
        shift = {"_": LOW, "^": HIGH}.get(mark, 0.0) * size
        if paint:
            draw.add_text(font, height, imgui.ImVec2(x, at.y + shift), colour, part)
        x += _width(part, height)
    return float(x - at.x)


def _width(text: str, height: float) -> float:
    """How wide ``text`` is at this height; letters do not scale evenly."""
    style = imgui.get_style()
    imgui.push_font(None, height / (style.font_scale_main * style.font_scale_dpi))
    width = imgui.calc_text_size(text).x
    imgui.pop_font()
    return float(width)
