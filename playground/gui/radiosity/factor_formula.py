"""The lecture's formula of the form factor, set with fractions: symbols, then a pair's numbers."""

from __future__ import annotations

from imgui_bundle import imgui

from playground.explain.patch_pair import PatchPair
from playground.gui.widget.typeset import typeset

BAR = 0.25  # of the height of the text, between a fraction's bar and its two lines
Part = str | tuple[str, str]  # words, or numerator and denominator


def lines(pair: PatchPair) -> tuple[tuple[Part, ...], ...]:
    """What is set: the formula, the same with numbers, and what comes of it."""
    a, b = pair.angle
    return (
        ("f_ij =", ("cos θ_i cos θ_j", "π |v|^2")),
        (
            "=",
            (f"cos {a:.1f}° · cos {b:.1f}°", f"π · {pair.distance:.4g}^2"),
            f"= {pair.point[0] / pair.area[1]:.4g}",
        ),
        (f"F_ij ≈ f_ij A_j = f_ij · {pair.area[1]:.4g} = {pair.point[0]:.4g}",),
    )


def draw(pair: PatchPair) -> None:
    """The formula at the cursor."""
    size = imgui.get_font_size()
    at, wide = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail().x
    x, y = at.x, at.y
    for number, line in enumerate(lines(pair)):
        room = sum(_width(part, size) for part in line) + 0.4 * size * len(line)
        if number == 1 and x + room > at.x + wide:  # else it goes on behind the symbols
            x, y = at.x, y + _height(True, size)
        if number == 2:
            x, y = at.x, y + _height(True, size)
        for part in line:
            x += _set(part, x, y, size, any(not isinstance(p, str) for p in line)) + 0.4 * size
    imgui.dummy(imgui.ImVec2(wide, y - at.y + _height(False, size)))


def _height(fraction: bool, size: float) -> float:
    return 2.75 * size if fraction else 1.35 * size


def _width(part: Part, size: float) -> float:
    nowhere = imgui.ImVec2(0.0, 0.0)
    words = (part,) if isinstance(part, str) else part
    return max(typeset(word, nowhere, size, 0, paint=False) for word in words)


def _set(part: Part, x: float, y: float, size: float, tall: bool) -> float:
    """One part at its place; returns its width."""
    colour = imgui.get_color_u32(imgui.Col_.text)
    if isinstance(part, str):
        return typeset(part, imgui.ImVec2(x, y + (0.65 * size if tall else 0.0)), size, colour)
    wide = _width(part, size)
    for word, down in zip(part, (0.0, (1.0 + 1.2 * BAR) * size), strict=True):
        indent = 0.5 * (wide - _width(word, size))
        typeset(word, imgui.ImVec2(x + indent, y + down), size, colour)
    bar = y + (1.0 + BAR) * size
    paint = imgui.get_window_draw_list()
    paint.add_line(imgui.ImVec2(x, bar), imgui.ImVec2(x + wide, bar), colour, 1.0)
    return wide
