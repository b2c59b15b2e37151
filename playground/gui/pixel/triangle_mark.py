"""The triangle that a pixel sees: its outline in the picture, vertex colours and weights."""

from __future__ import annotations

from functools import lru_cache
from math import hypot
from typing import TYPE_CHECKING

import numpy as np
from imgui_bundle import imgui
from numpy.typing import NDArray

from playground.explain.pixel import Explanation
from playground.explain.words import CORNERS
from playground.gui.pixel.vector_pen import Point, Rect, ink
from playground.render.surface import Surface
from playground.shading.display import code8, display_colour

if TYPE_CHECKING:
    from playground.explain.stored_pixel import StoredPixel

Array = NDArray[np.float64]


def shown_codes(why: Explanation | StoredPixel, colours: Array) -> NDArray[np.uint8]:
    """Linear colours (..., 3) as the display shows them."""
    settings = why.setup.settings
    return code8(display_colour(colours, settings.exposure, settings.clamp, settings.curve))


def shown_colour(why: Explanation | StoredPixel, colour: Array) -> tuple[int, int, int]:
    """A linear colour as the display shows it."""
    red, green, blue = shown_codes(why, colour).tolist()
    return red, green, blue


@lru_cache(maxsize=2)
def vertices(why: Explanation, surface: Surface) -> Array:
    """World positions (3, 3) of the corners of the triangle that is seen."""
    positions = surface.mesh.positions[surface.mesh.faces[why.triangle]].astype(np.float64)
    return np.asarray(positions @ surface.linear.T + surface.origin)


def vertex_colours(why: Explanation) -> Array:
    """Linear colours (3, 3) of the three vertices; one colour three times if it is flat."""
    colours = np.array([corner.colour for corner in why.corners])
    return colours if len(colours) == 3 else np.repeat(colours[:1], 3, axis=0)


def outline(why: Explanation, places: list[Point], scale: float) -> list[Rect]:
    """The outline in the picture, vertex colours as dots, weights; returns where these are."""
    labels: list[Rect] = []
    paint = imgui.get_window_draw_list()
    corners = [imgui.ImVec2(*place) for place in places]
    white, black = imgui.IM_COL32(255, 255, 255, 255), imgui.IM_COL32(0, 0, 0, 200)
    sides = [(corners[i - 1], corners[i]) for i in range(3)]
    for thick, colour in ((4.0, black), (1.6, white)):
        for start, end in sides:
            paint.add_line(start, end, colour, thick * scale)
    across, down = zip(*places, strict=True)
    large = max(max(across) - min(across), max(down) - min(down)) > 5.0 * imgui.get_font_size()
    middle = sum(across) / 3.0, sum(down) / 3.0
    for i, (place, colour) in enumerate(zip(places, vertex_inks(why), strict=True)):
        at = imgui.ImVec2(*place)
        size = (5.0 if large else 3.0) * scale
        paint.add_circle_filled(at, size + 2.5, black)
        paint.add_circle_filled(at, size + 1.0, white)
        paint.add_circle_filled(at, size, colour)
        if large and len(why.corners) == 3:
            dx, dy = place[0] - middle[0], place[1] - middle[1]
            far = 1.8 * imgui.get_font_size() / max(hypot(dx, dy), 1.0)
            beside = place[0] + far * dx, place[1] + far * dy
            labels.append(_tag(beside, f"{CORNERS[i]} {why.weights[i]:.2f}"))
    return labels


@lru_cache(maxsize=4)
def vertex_inks(why: Explanation) -> tuple[int, ...]:
    """The colours of the three vertices as ImGui packs them; an explanation never changes."""
    return tuple(ink(code) for code in shown_codes(why, vertex_colours(why)).tolist())


def _tag(centre: Point, text: str) -> Rect:
    """White letters on a dark plate; returns where it is."""
    size, pad = imgui.calc_text_size(text), 0.2 * imgui.get_font_size()
    x, y = centre[0] - 0.5 * size.x, centre[1] - 0.5 * size.y
    paint = imgui.get_window_draw_list()
    low, high = imgui.ImVec2(x - pad, y - pad / 2), imgui.ImVec2(x + size.x + pad, y + size.y + pad)
    paint.add_rect_filled(low, high, imgui.IM_COL32(0, 0, 0, 180), pad)
    paint.add_text(imgui.ImVec2(x, y), imgui.IM_COL32(255, 255, 255, 255), text)
    return low.x, low.y, high.x - low.x, high.y - low.y
