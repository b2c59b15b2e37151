"""The terms of the model in symbols, as tooltips and the term by term layout write them."""

from __future__ import annotations

from imgui_bundle import imgui

from playground.gui.picture.comparison import Box
from playground.gui.widget.typeset import typeset
from playground.scene.settings import TERMS

LARGEST = 1.5  # times the usual size: the sum where there is room for it
SUM = "the colour of the point"


def formula(term: str, highlight: str) -> str:
    """A term in symbols, with the highlight ``"phong"`` or ``"blinn"``."""
    product = "n·h" if highlight == "blinn" else "r·v"
    return {
        "diffuse": "max(n·l, 0) s_d ⊗ m_d",
        "specular": f"max({product}, 0)^sh s_s ⊗ m_s",
        "ambient": "s_a ⊗ m_a",
        "emissive": "m_e",
    }[term]


def write_sum(
    highlight: str, box: Box, origin: imgui.ImVec2, dense: imgui.ImVec2, scale: float
) -> None:
    """The terms and their sum, in the box that the five pictures leave free."""
    lines = [(formula(term, highlight), term) for term in TERMS] + [(SUM, "")]
    x, y, w, _ = box
    size, nothing = imgui.get_font_size(), imgui.ImVec2(0.0, 0.0)
    sums = [typeset(words, nothing, size, 0, paint=False) for words, _ in lines]
    names = [imgui.calc_text_size(name).x for _, name in lines]
    room = w / dense.x - 20 * scale
    size *= min(LARGEST, room / (max(sums) + max(names) + 3.0 * size))
    size = float(int(size))
    shrink = size / imgui.get_font_size()
    left, top = origin.x + x / dense.x + 10 * scale, origin.y + y / dense.y + size
    strong = imgui.get_color_u32(imgui.Col_.text)
    faint = imgui.get_color_u32(imgui.Col_.text_disabled)
    signs = ("", *("+" for _ in TERMS[1:]), "=")
    for i, (sign, (words, name)) in enumerate(zip(signs, lines, strict=True)):
        down = top + 1.8 * i * size
        typeset(sign, imgui.ImVec2(left, down), size, strong)
        typeset(words, imgui.ImVec2(left + 1.2 * size, down), size, strong)
        at = imgui.ImVec2(left + max(sums) * shrink + 2.6 * size, down)
        typeset(name, at, size, faint)
