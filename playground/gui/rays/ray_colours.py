"""Colours and names of the kinds of rays, the same in picture, diagram and bench.

Colours: Okabe & Ito, Color Universal Design, 2008; shadow rays are thin besides.
"""

from __future__ import annotations

from imgui_bundle import imgui

from playground.explain.ray_tree import (
    ARRIVING,
    BLOCKED,
    PRIMARY,
    REFLECTION,
    REFRACTION,
    TOTAL,
)

Rgb = tuple[float, float, float]


def _of(red: int, green: int, blue: int) -> Rgb:
    return red / 255.0, green / 255.0, blue / 255.0


RAYS: dict[str, Rgb] = {
    PRIMARY: _of(245, 245, 245),
    REFLECTION: _of(86, 180, 233),
    REFRACTION: _of(230, 159, 0),
    TOTAL: _of(204, 121, 167),
    ARRIVING: _of(240, 228, 66),
    BLOCKED: _of(213, 94, 0),
}
WORDS = {
    PRIMARY: "from the eye",
    REFLECTION: "reflection",
    REFRACTION: "refraction",
    TOTAL: "total internal reflection",
    ARRIVING: "shadow ray, reaches the light",
    BLOCKED: "shadow ray, blocked",
}


def ink(kind: str, alpha: float = 1.0) -> int:
    """The colour of a kind of ray as ImGui packs it."""
    return int(imgui.get_color_u32(imgui.ImVec4(*RAYS[kind], alpha)))


def legend(kinds: list[str]) -> None:
    """A line of its colour and the name of each kind, as many in a row as fit."""
    size, end = imgui.get_font_size(), imgui.get_cursor_screen_pos().x
    end += imgui.get_content_region_avail().x
    paint, rim = imgui.get_window_draw_list(), imgui.IM_COL32(0, 0, 0, 140)
    for i, kind in enumerate(kinds):
        wide = imgui.calc_text_size(WORDS[kind]).x + 2.0 * size
        if i:
            imgui.same_line(0.0, 0.7 * size)
            if imgui.get_cursor_screen_pos().x + wide > end:
                imgui.new_line()
        at = imgui.get_cursor_screen_pos()
        low = imgui.ImVec2(at.x, at.y + 0.45 * size)
        high = imgui.ImVec2(at.x + 1.2 * size, at.y + 0.45 * size)
        paint.add_line(low, high, rim, 0.3 * size)
        paint.add_line(low, high, ink(kind), 0.2 * size)
        imgui.dummy(imgui.ImVec2(1.2 * size, size))
        imgui.same_line(0.0, 0.4 * size)
        imgui.text(WORDS[kind])
