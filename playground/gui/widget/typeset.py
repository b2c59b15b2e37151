"""Symbols of the lecture with real subscripts and superscripts: ``s_d``, ``(r·v)^sh``."""

from __future__ import annotations

import re
from functools import lru_cache
from typing import NamedTuple

from imgui_bundle import imgui

SMALL = 0.72  # size of a subscript
LOW, HIGH = 0.38, -0.18  # how far it is shifted, in heights of the text
PARTS = re.compile(r"([_^])(\w+(?:\.\d+)?)|([^_^]+)")


class Run(NamedTuple):
    """Letters of one size in a line: how high they are, and where they begin in it."""

    text: str
    height: float
    right: float
    down: float


def typeset(text: str, at: imgui.ImVec2, size: float, colour: int, paint: bool = True) -> float:
    """Draw ``text`` with its upper left corner ``at``; returns its width.

    ``_x`` lowers and ``^x`` raises the letters and digits that follow.
    """
    made, width = runs(text, size)
    if paint:
        font, draw = imgui.get_font(), imgui.get_window_draw_list()
        for run in made:
            place = imgui.ImVec2(at.x + run.right, at.y + run.down)
            draw.add_text(font, run.height, place, colour, run.text)
    return width


@lru_cache(maxsize=1024)
def runs(text: str, size: float) -> tuple[tuple[Run, ...], float]:
    """The runs of a line and its width; measured once per text and size of the text."""
    made, x = [], 0.0
    for mark, shifted, plain in PARTS.findall(text):
        part, height = (plain, size) if plain else (shifted, round(SMALL * size))
        shift = {"_": LOW, "^": HIGH}.get(mark, 0.0) * size
        made.append(Run(part, height, x, shift))
        x += _width(part, height)
    return tuple(made), x


def _width(text: str, height: float) -> float:
    """How wide ``text`` is at this height; letters do not scale evenly."""
    style = imgui.get_style()
    imgui.push_font(None, height / (style.font_scale_main * style.font_scale_dpi))
    width = imgui.calc_text_size(text).x
    imgui.pop_font()
    return float(width)
