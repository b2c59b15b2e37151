"""Fresnel's equations over the angle, with the ray of the bench on them."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from imgui_bundle import imgui

from playground.gui.pixel.vector_pen import Places
from playground.gui.rays.snell import Bench, Shares, shares

HIGH = 10.5  # in heights of the text
COUNT = 181  # points of a curve
NAMES = ("s", "p", "mean", "schlick")
WORDS = {"s": "R_s", "p": "R_p", "mean": "mean", "schlick": "Schlick (dashed)"}
Rgb = tuple[int, int, int]
COLOURS: dict[str, dict[str, Rgb]] = {  # Okabe & Ito, darkened for light paper
    "dark": {
        "s": (86, 180, 233),
        "p": (230, 159, 0),
        "mean": (240, 240, 240),
        "schlick": (204, 121, 167),
    },
    "light": {
        "s": (0, 114, 178),
        "p": (213, 94, 0),
        "mean": (20, 20, 20),
        "schlick": (170, 60, 130),
    },
}
TICKS = (0, 30, 60, 90)


@lru_cache(maxsize=8)
def curves(above: float, below: float) -> tuple[tuple[float, ...], Shares]:
    """Angles in degrees, close together where the curves bend, and what is reflected at each."""
    angles = np.linspace(0.0, 90.0, COUNT)
    critical = Bench(above=above, below=below).critical
    if critical is not None:
        near = critical - np.geomspace(1e-4, 2.0, 24)
        angles = np.unique(np.concatenate([angles, near[near > 0.0], [critical]]))
    return tuple(angles.tolist()), shares(Bench(above=above, below=below), angles)


def draw(bench: Bench, scale: float, theme: str) -> None:
    """The plot at the cursor, over the width that is there, and its legend."""
    line = imgui.get_font_size()
    at, width = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail().x
    room = imgui.ImVec2(width, (HIGH + 2.2) * line)
    imgui.dummy(room)
    if imgui.is_rect_visible(at, imgui.ImVec2(at.x + room.x, at.y + room.y)):
        left, top = at.x + 2.0 * line, at.y + 0.6 * line
        box = (left, top, width - 2.8 * line, (HIGH - 0.6) * line)
        _grid(box)
        angles, reflected = curves(bench.above, bench.below)
        for name in NAMES:
            thick = (2.5 if name == "mean" else 1.5) * scale
            _curve(box, angles, getattr(reflected, name), name, theme, thick)
        _point(box, bench, theme, scale)
    _legend(theme)


def _place(box: tuple[float, float, float, float], angle: float, share: float) -> imgui.ImVec2:
    left, top, wide, high = box
    return imgui.ImVec2(left + angle / 90.0 * wide, top + (1.0 - share) * high)


def _grid(box: tuple[float, float, float, float]) -> None:
    """Lines at every 30 degrees and at 0, a half and all."""
    paint, line = imgui.get_window_draw_list(), imgui.get_font_size()
    grey, faint = (imgui.get_color_u32(c) for c in (imgui.Col_.border, imgui.Col_.text_disabled))
    for angle in TICKS:
        low, words = _place(box, angle, 0.0), f"{angle}°"
        paint.add_line(_place(box, angle, 1.0), low, grey)
        half = 0.5 * imgui.calc_text_size(words).x
        paint.add_text(imgui.ImVec2(low.x - half, low.y + 0.2 * line), faint, words)
    for share in (0.0, 0.5, 1.0):
        left, words = _place(box, 0.0, share), f"{share:g}"
        paint.add_line(left, _place(box, 90.0, share), grey)
        wide = imgui.calc_text_size(words).x
        paint.add_text(imgui.ImVec2(left.x - wide - 0.4 * line, left.y - 0.6 * line), faint, words)


def _curve(
    box: tuple[float, float, float, float],
    angles: tuple[float, ...],
    values: np.ndarray,
    name: str,
    theme: str,
    thick: float,
) -> None:
    places: Places = [_place(box, a, v) for a, v in zip(angles, values.tolist(), strict=True)]
    paint, colour = imgui.get_window_draw_list(), imgui.IM_COL32(*COLOURS[theme][name], 255)
    if name != "schlick":
        paint.add_polyline(places, colour, thick, 0)
        return
    for start in range(0, len(places) - 1, 8):
        paint.add_polyline(places[start : start + 5], colour, thick, 0)


def _point(box: tuple[float, float, float, float], bench: Bench, theme: str, scale: float) -> None:
    """The present angle, and what is reflected there."""
    paint, reflected = imgui.get_window_draw_list(), bench.shares
    strong = imgui.get_color_u32(imgui.Col_.text)
    low, top = _place(box, bench.angle, 0.0), _place(box, bench.angle, 1.0)
    paint.add_line(low, top, imgui.get_color_u32(imgui.Col_.text_disabled))
    for name in NAMES:
        spot = _place(box, bench.angle, float(getattr(reflected, name)[0]))
        paint.add_circle_filled(spot, 4.5 * scale, imgui.IM_COL32(0, 0, 0, 200))
        paint.add_circle_filled(spot, 3.3 * scale, imgui.IM_COL32(*COLOURS[theme][name], 255))
    share = float(reflected.mean[0])
    words, line = f"{share:.3f}", imgui.get_font_size()
    at = _place(box, bench.angle, share)
    wide = imgui.calc_text_size(words).x
    aside = -wide - 0.6 * line if bench.angle > 60.0 else 0.6 * line
    down = max(at.y - 1.3 * line, box[1] + 0.1 * line)
    paint.add_text(imgui.ImVec2(at.x + aside, down), strong, words)


def _legend(theme: str) -> None:
    for i, name in enumerate(NAMES):
        if i:
            imgui.same_line(0.0, imgui.get_font_size())
        red, green, blue = (c / 255.0 for c in COLOURS[theme][name])
        imgui.text_colored(imgui.ImVec4(red, green, blue, 1.0), WORDS[name])
