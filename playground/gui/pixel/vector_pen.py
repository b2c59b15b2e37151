"""Arrows and the plates of their symbols, drawn the same in picture and panel.

Colours: Okabe & Ito, Color Universal Design, 2008; black letters are readable on each.
"""

from __future__ import annotations

from math import hypot
from typing import Any

from imgui_bundle import imgui

Point = tuple[float, float]
Arrows = dict[str, tuple[Point, Point]]  # start and end by the symbol
Rect = tuple[float, float, float, float]  # x, y, width, height
Places = list[Any]  # of ImVec2; ImGui's stubs want a wider type
COLOURS = {
    "n": (0, 158, 115),
    "l": (240, 228, 66),
    "v": (86, 180, 233),
    "r": (230, 120, 180),
    "h": (230, 159, 0),
    "ρ": (235, 235, 235),
}
NAMES = {
    "n": "normal: stands upright on the surface",
    "l": "to_light: where the light comes from",
    "v": "to_eye: where the viewer is",
    "r": "reflection: l mirrored about n",
    "h": "halfway: between l and v",
    "ρ": "rho: the angle between r and v",
}
REACH = 7.0  # pixels from an arrow that still hit it, at text size 1
OPEN = 5.0  # pixels to either side, at text size 1, from which a sector is seen as one
FADED = 0.35  # of its strength keeps an arrow while another one is lit


def strength(symbol: str, lit: str) -> float:
    """How visible a symbol is while ``lit`` is pointed at; ρ belongs to r and v."""
    family = {lit, *("rv" if lit == "ρ" else "")}
    return 1.0 if not lit or symbol in family else FADED


def ink(rgb: tuple[int, int, int], alpha: float = 1.0) -> int:
    """A colour as ImGui packs it."""
    return int(imgui.IM_COL32(*rgb, round(255 * alpha)))


def arrow(start: Point, end: Point, symbol: str, lit: str, scale: float) -> None:
    """An arrow with a dark rim: visible over any picture."""
    paint, alpha = imgui.get_window_draw_list(), strength(symbol, lit)
    thick = (5.0 if symbol == lit else 3.0) * scale
    dx, dy = end[0] - start[0], end[1] - start[1]
    length = hypot(dx, dy)
    if length < 2.0 * thick:
        _towards_us(start, symbol, alpha, thick)
        return
    ux, uy = dx / length, dy / length
    head = min(3.5 * thick, 0.6 * length)
    neck = (end[0] - 0.8 * head * ux, end[1] - 0.8 * head * uy)
    rim = imgui.IM_COL32(0, 0, 0, round(200 * alpha))
    colour = ink(COLOURS[symbol], alpha)
    for more, shade in ((1.5 * scale, rim), (0.0, colour)):
        tip = imgui.ImVec2(end[0] + more * ux, end[1] + more * uy)
        wide = 0.45 * head + more
        back = (end[0] - (head + more) * ux, end[1] - (head + more) * uy)
        left = imgui.ImVec2(back[0] - wide * uy, back[1] + wide * ux)
        right = imgui.ImVec2(back[0] + wide * uy, back[1] - wide * ux)
        paint.add_line(imgui.ImVec2(*start), imgui.ImVec2(*neck), shade, thick + 2.0 * more)
        paint.add_triangle_filled(tip, left, right, shade)


def angle(
    start: Point, rim: list[Point], text: str, lit: str, beyond: float, scale: float
) -> dict[str, Rect]:
    """The sector of ρ between two arrows from ``start``, and its plate; returns where that is.

    Seen edge-on it is a line, which has no place for a plate. Between arrows that are too
    close the plate stands outside, ``beyond`` from ``start`` and further.
    """
    paint, alpha = imgui.get_window_draw_list(), strength("ρ", lit)
    places: Places = [imgui.ImVec2(*place) for place in rim]
    colour = ink(COLOURS["ρ"], alpha)
    thick = (4.0 if lit == "ρ" else 2.5) * scale
    if openness(start, rim) < OPEN * scale:
        paint.add_polyline(places, colour, thick, 0)
        return {}
    paint.add_concave_poly_filled([imgui.ImVec2(*start), *places], ink(COLOURS["ρ"], 0.3 * alpha))
    paint.add_polyline(places, imgui.IM_COL32(0, 0, 0, round(200 * alpha)), thick + 3.0 * scale, 0)
    paint.add_polyline(places, colour, thick, 0)
    x, y = rim[len(rim) // 2]
    line, width = imgui.get_font_size(), plate_width(text)
    long = max(hypot(x - start[0], y - start[1]), 1.0)
    close = 2.0 * openness(start, rim) < width + line
    far = (beyond + 2.2 * line) / long if close else 1.0 + (0.6 * line + 0.5 * width) / long
    left = start[0] + far * (x - start[0]) - 0.5 * width
    top = start[1] + far * (y - start[1]) - 0.6 * line
    return {"ρ": (left, top, plate((left, top), "ρ", lit, text), 1.2 * line)}


def openness(start: Point, rim: list[Point]) -> float:
    """How far, in pixels, the rim of a sector lies from the line through its middle."""
    x, y = rim[len(rim) // 2]
    dx, dy = x - start[0], y - start[1]
    long = max(hypot(dx, dy), 1e-9)
    return max(abs((px - start[0]) * dy - (py - start[1]) * dx) / long for px, py in rim)


def _towards_us(at: Point, symbol: str, alpha: float, thick: float) -> None:
    """An arrow seen from its tip: a ring with a dot, as physics writes it."""
    paint, centre = imgui.get_window_draw_list(), imgui.ImVec2(*at)
    rim, colour = imgui.IM_COL32(0, 0, 0, round(200 * alpha)), ink(COLOURS[symbol], alpha)
    paint.add_circle(centre, 2.6 * thick, rim, 0, 1.1 * thick + 3.0)
    paint.add_circle(centre, 2.6 * thick, colour, 0, 0.8 * thick)
    paint.add_circle_filled(centre, thick + 1.5, rim)
    paint.add_circle_filled(centre, thick, colour)


def plate_width(text: str) -> float:
    """How wide the plate of a symbol is."""
    return float(imgui.calc_text_size(text).x) + 0.5 * imgui.get_font_size()


def plate(at: Point, symbol: str, lit: str, text: str = "") -> float:
    """A symbol in black on its colour, upper left corner ``at``; returns its width."""
    text, size = text or symbol, imgui.get_font_size()
    paint, width = imgui.get_window_draw_list(), plate_width(text or symbol)
    low, high = imgui.ImVec2(*at), imgui.ImVec2(at[0] + width, at[1] + 1.2 * size)
    alpha = max(strength(symbol, lit), 0.55)
    paint.add_rect_filled(low, high, ink(COLOURS[symbol], alpha), 0.25 * size)
    paint.add_rect(low, high, imgui.IM_COL32(0, 0, 0, 110), 0.25 * size)
    if symbol == lit:
        strong = imgui.get_color_u32(imgui.Col_.text)
        paint.add_rect(low, high, strong, 0.25 * size, 2.0)
    black = imgui.IM_COL32(0, 0, 0, 255)
    paint.add_text(imgui.ImVec2(at[0] + 0.25 * size, at[1] + 0.08 * size), black, text)
    return width


def around(places: list[Point], margin: float) -> Rect:
    """The rectangle that holds the places and a margin."""
    across, down = zip(*places, strict=True)
    left, top = min(across) - margin, min(down) - margin
    return left, top, max(across) + margin - left, max(down) + margin - top


def apart(rect: Rect, taken: list[Rect]) -> Rect:
    """``rect``, or the nearest one straight below that covers none of those taken."""
    x, y, width, height = rect
    for left, top, wide, high in sorted(taken, key=lambda other: other[1]):
        beside = x + width <= left or left + wide <= x
        if not beside and y < top + high and top < y + height:
            y = top + high
    return x, y, width, height


def tips(arrows: Arrows, lit: str, taken: list[Rect], rho: float | None = None) -> dict[str, Rect]:
    """Plates beyond the tips of arrows; returns where they are.

    An arrow that points at us carries its plate to the lower left, and ρ beside it.
    """
    line, made = imgui.get_font_size(), dict[str, Rect]()
    for symbol, (start, end) in arrows.items():
        dx, dy = end[0] - start[0], end[1] - start[1]
        long = hypot(dx, dy)
        if long < line:
            dx, dy, long = -1.0, 1.3, 1.0
        far, width = 0.9 * line / long, plate_width(symbol)
        text = f"ρ {rho:.0f}°" if symbol == "v" and rho is not None else ""
        wide = width + (plate_width(text) + 3.0 if text else 0.0)
        place = (end[0] + far * dx - 0.5 * width, end[1] + far * dy - 0.6 * line)
        rect = apart((*place, wide, 1.25 * line), taken)
        taken.append(rect)
        plate(rect[:2], symbol, lit)
        made[symbol] = (*rect[:2], width, 1.2 * line)
        if text:
            place = (rect[0] + width + 3.0, rect[1])
            plate(place, "ρ", lit, text)
            made["ρ"] = (*place, wide - width, 1.2 * line)
    return made


def touched(arrows: Arrows, plates: dict[str, Rect], scale: float) -> str:
    """The symbol whose plate or arrow is under the mouse; near its start an arrow is no one's."""
    mouse = imgui.get_io().mouse_pos
    for symbol, (x, y, width, height) in plates.items():
        if x <= mouse.x <= x + width and y <= mouse.y <= y + height:
            return symbol
    return nearest((mouse.x, mouse.y), arrows, REACH * scale)


def nearest(mouse: Point, arrows: Arrows, reach: float) -> str:
    """The symbol of the arrow under the mouse, or nothing."""
    far = {}
    for symbol, (start, end) in arrows.items():
        dx, dy = end[0] - start[0], end[1] - start[1]
        if hypot(dx, dy) > 2.0 * reach:
            third = (start[0] + dx / 3.0, start[1] + dy / 3.0)
            far[symbol] = distance(mouse, third, end)
    best = min(far, key=lambda symbol: far[symbol], default="")
    return best if best and far[best] <= reach else ""


def distance(point: Point, start: Point, end: Point) -> float:
    """How far a point is from a segment."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    square = dx * dx + dy * dy
    along = (point[0] - start[0]) * dx + (point[1] - start[1]) * dy
    share = min(max(along / square, 0.0), 1.0) if square else 0.0
    return hypot(point[0] - start[0] - share * dx, point[1] - start[1] - share * dy)
