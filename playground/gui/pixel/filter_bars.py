"""The component-wise filter s ⊗ m as bars: three of light, three of material, three products."""

from __future__ import annotations

from collections.abc import Sequence

from imgui_bundle import imgui

from playground.gui.widget.typeset import typeset

BARS = ((214, 60, 50), (40, 150, 70), (50, 100, 220))  # red, green, blue
LETTERS = "RGB"


def heights(groups: Sequence[Sequence[float]]) -> list[list[float]]:
    """The bars as shares of the tallest value, or of 1 where all are smaller."""
    most = max([1.0, *(value for group in groups for value in group)])
    return [[max(value, 0.0) / most for value in group] for group in groups]


def draw(light: Sequence[float], material: Sequence[float], names: tuple[str, str]) -> None:
    """Three groups of three bars at the cursor, with × and = between them."""
    product = [a * b for a, b in zip(light, material, strict=True)]
    groups = (light, material, product)
    titles = (names[0], names[1], f"{names[0]} ⊗ {names[1]}")
    at, width = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail().x
    line = imgui.get_font_size()
    sign = 1.6 * line
    room = (width - 2.0 * sign) / 3.0
    high = 4.5 * line
    space = imgui.ImVec2(width, high + 3.9 * line)
    if not imgui.is_rect_visible(space):
        imgui.dummy(space)
        return
    for i, (values, shares) in enumerate(zip(groups, heights(groups), strict=True)):
        left = at.x + i * (room + sign)
        _group(left, at.y, room, high, values, shares)
        wide = typeset(titles[i], at, line, 0, paint=False)
        place = imgui.ImVec2(left + 0.5 * (room - wide), at.y + high + 2.2 * line)
        typeset(titles[i], place, line, _text())
        if i < 2:
            mark = "×="[i]
            half = 0.5 * imgui.calc_text_size(mark).x
            middle = imgui.ImVec2(left + room + 0.5 * sign - half, at.y + 0.5 * high)
            imgui.get_window_draw_list().add_text(middle, _text(), mark)
    imgui.dummy(space)


def _group(
    left: float,
    top: float,
    width: float,
    height: float,
    values: Sequence[float],
    shares: Sequence[float],
) -> None:
    paint, line = imgui.get_window_draw_list(), imgui.get_font_size()
    faint = imgui.get_color_u32(imgui.Col_.text_disabled)
    floor = top + line + height - line * 0.2
    step = width / 3.0
    for i, (value, share) in enumerate(zip(values, shares, strict=True)):
        x, gap = left + i * step, 0.14 * step
        tall = share * (height - 0.4 * line)
        low, high = imgui.ImVec2(x + gap, floor - tall), imgui.ImVec2(x + step - gap, floor)
        paint.add_rect_filled(low, high, imgui.IM_COL32(*BARS[i], 255))
        paint.add_line(imgui.ImVec2(x, floor), imgui.ImVec2(x + step, floor), faint)
        _centred(x + 0.5 * step, floor - tall - 0.9 * line, f"{value:.2f}", 0.72, _text())
        _centred(x + 0.5 * step, floor + 0.1 * line, LETTERS[i], 0.85, faint)


def _centred(x: float, y: float, text: str, size: float, colour: int) -> None:
    height = size * imgui.get_font_size()
    half = 0.5 * size * imgui.calc_text_size(text).x
    place = imgui.ImVec2(x - half, y)
    imgui.get_window_draw_list().add_text(imgui.get_font(), height, place, colour, text)


def _text() -> int:
    return int(imgui.get_color_u32(imgui.Col_.text))
