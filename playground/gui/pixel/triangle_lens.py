"""The triangle that a pixel sees, enlarged: as its vertices are mixed, and as it should be.

Three of them: the colours that the rasteriser mixes, with the pixel in it; the model evaluated
at every point; the difference, in false colours.
"""

from __future__ import annotations

from functools import lru_cache
from operator import mul

import numpy as np
from imgui_bundle import imgui
from numpy.typing import NDArray

from playground.explain.colour_map import colour_of
from playground.explain.pixel import Explanation
from playground.explain.triangle_inside import mixed_inside, shaded_inside
from playground.explain.words import CORNERS
from playground.gui.pixel.triangle_mark import shown_codes
from playground.gui.pixel.vector_pen import Places, Point, ink
from playground.shading.display import code8

Array = NDArray[np.float64]
Inks = tuple[int, ...]
ROWS = 9  # of small triangles in the enlarged one
UPRIGHT = 0.866  # height over side of a triangle of equal sides


def mixed(why: Explanation, scale: float) -> None:
    """A triangle lit per vertex, coloured as the rasteriser mixes it, the pixel marked in it."""
    at, width = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail().x
    line = imgui.get_font_size()
    side = min(9.5 * line, 0.7 * width)
    height = UPRIGHT * side
    if not imgui.is_rect_visible(imgui.ImVec2(width, height + 2.0 * line)):
        imgui.dummy(imgui.ImVec2(width, height + 2.0 * line))
        return
    left, top = at.x + 0.5 * (width - side), at.y + 1.5 * line
    corners = _filled(left, top, side, mixed_inks(why))
    mix = why.weights.tolist()
    spot = imgui.ImVec2(*(sum(map(mul, mix, along)) for along in zip(*corners, strict=True)))
    paint = imgui.get_window_draw_list()
    paint.add_circle(spot, 6.0 * scale, imgui.IM_COL32(0, 0, 0, 255), 0, 4.0 * scale)
    paint.add_circle(spot, 6.0 * scale, imgui.IM_COL32(255, 255, 255, 255), 0, 2.0 * scale)
    strong = imgui.get_color_u32(imgui.Col_.text)
    for i, (dx, dy) in enumerate(((-4.9, -0.6), (0.6, -0.6), (-1.6, -1.3))):
        place = imgui.ImVec2(corners[i][0] + dx * line, corners[i][1] + dy * line)
        paint.add_text(place, strong, f"{CORNERS[i]} × {mix[i]:.3f}")
    imgui.dummy(imgui.ImVec2(width, height + 2.0 * line))


def compared(why: Explanation) -> None:
    """Two triangles side by side: shaded at every point, and what is lost by not doing so."""
    at, width = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail().x
    line = imgui.get_font_size()
    side = min(8.0 * line, 0.44 * width)
    space = imgui.ImVec2(width, UPRIGHT * side + 1.6 * line)
    if not imgui.is_rect_visible(space):
        imgui.dummy(space)
        return
    paint, faint = imgui.get_window_draw_list(), imgui.get_color_u32(imgui.Col_.text_disabled)
    told = f"off by up to {largest(why):.2g}"
    for k, (words, inks) in enumerate(
        (("at every point", shaded_inks(why)), (told, difference_inks(why)))
    ):
        middle = at.x + (0.25 + 0.5 * k) * width
        _filled(middle - 0.5 * side, at.y + 0.2 * line, side, inks)
        half = 0.5 * imgui.calc_text_size(words).x
        place = imgui.ImVec2(middle - half, at.y + UPRIGHT * side + 0.4 * line)
        paint.add_text(place, faint, words)
    imgui.dummy(space)
    imgui.set_item_tooltip(
        "the model evaluated at every point of the triangle;\n"
        f"what is drawn differs by up to {largest(why):.2g} of linear light, yellow is most"
    )


def _filled(left: float, top: float, side: float, inks: Inks) -> tuple[Point, Point, Point]:
    """A triangle of small ones in these colours; returns its corners on the screen."""
    height = UPRIGHT * side
    paint = imgui.get_window_draw_list()
    for (a, b, c), colour in zip(piece_places(left, top, side, height), inks, strict=True):
        paint.add_triangle_filled(a, b, c, colour)
    corners = _corners(left, top, side, height)
    a, b, c = (imgui.ImVec2(*corner) for corner in corners)
    paint.add_triangle(a, b, c, imgui.get_color_u32(imgui.Col_.text_disabled), 1.0)
    return corners


@lru_cache(maxsize=4)
def mixed_inks(why: Explanation) -> Inks:
    """The colours of the small triangles, each mixed at its middle, as ImGui packs them."""
    return tuple(ink(code) for code in shown_codes(why, _mixed(why)).tolist())


@lru_cache(maxsize=4)
def shaded_inks(why: Explanation) -> Inks:
    """The same with the model evaluated at each middle."""
    return tuple(ink(code) for code in shown_codes(why, _shaded(why)).tolist())


@lru_cache(maxsize=4)
def difference_inks(why: Explanation) -> Inks:
    """How far the two are apart, in false colours from 0 to the largest difference."""
    share = _difference(why) / (largest(why) or 1.0)
    return tuple(ink(code) for code in code8(colour_of(share)).tolist())


@lru_cache(maxsize=4)
def largest(why: Explanation) -> float:
    """The largest difference, of any channel of linear light."""
    return float(_difference(why).max())


@lru_cache(maxsize=4)
def _difference(why: Explanation) -> Array:
    apart = np.abs(_mixed(why) - _shaded(why))
    return np.asarray(apart.max(axis=-1))


@lru_cache(maxsize=4)
def _mixed(why: Explanation) -> Array:
    return mixed_inside(why, middles())


@lru_cache(maxsize=4)
def _shaded(why: Explanation) -> Array:
    return shaded_inside(why, middles())


@lru_cache(maxsize=8)
def piece_places(left: float, top: float, side: float, height: float) -> tuple[Places, ...]:
    """The corners of the small triangles on the screen; as long as they stand there, once."""
    places = (pieces(ROWS) @ np.array(_corners(left, top, side, height))).tolist()
    return tuple([imgui.ImVec2(*place) for place in corners] for corners in places)


def _corners(left: float, top: float, side: float, height: float) -> tuple[Point, Point, Point]:
    """The corners of the enlarged triangle: below left, below right, above."""
    return (left, top + height), (left + side, top + height), (left + side / 2, top)


@lru_cache(maxsize=1)
def middles() -> Array:
    """The weights (ROWS², 3) of the middles of the small triangles."""
    return np.asarray(pieces(ROWS).mean(axis=1))


@lru_cache(maxsize=1)
def pieces(rows: int) -> Array:
    """A triangle cut into ``rows``² small ones: weights (rows², 3, 3) of their corners."""

    def weight(i: int, j: int) -> list[float]:
        return [i / rows, j / rows, (rows - i - j) / rows]

    made: list[list[list[float]]] = []
    for i in range(rows):
        for j in range(rows - i):
            made.append([weight(i, j), weight(i + 1, j), weight(i, j + 1)])
            if i + j < rows - 1:
                made.append([weight(i + 1, j), weight(i + 1, j + 1), weight(i, j + 1)])
    return np.array(made)
