"""The lobe of the highlight: cos^sh over the angle, as a polar plot with the viewer in it."""

from __future__ import annotations

from functools import lru_cache
from math import cos, pi, radians, sin

import numpy as np
from imgui_bundle import imgui
from numpy.typing import NDArray

from playground.gui.pixel.vector_pen import COLOURS, Places, ink

EXPONENTS = (5.0, 10.0, 20.0, 80.0)  # of the lecture
Array = NDArray[np.float64]


@lru_cache(maxsize=16)
def lobe(shininess: float, count: int = 181) -> Array:
    """Points (count, 2) of the curve: right and up, for angles from -90 to 90 degrees.

    The distance from the origin is cos^sh of the angle to the axis, which points up.
    """
    angles = np.linspace(-pi / 2.0, pi / 2.0, count)
    reach = np.maximum(np.cos(angles), 0.0) ** shininess
    return np.stack([reach * np.sin(angles), reach * np.cos(angles)], axis=1)


def marker(shininess: float, degrees: float) -> tuple[float, float]:
    """Where on the curve an angle lies; the origin from 90 degrees on."""
    reach = max(cos(radians(degrees)), 0.0) ** shininess if degrees < 90.0 else 0.0
    return reach * sin(radians(degrees)), reach * cos(radians(degrees))


def draw(shininess: float, degrees: float | None, axis: str, eye: str, scale: float) -> None:
    """The curves at the cursor, over the width that is there.

    Parameters
    ----------
    shininess : float
        Of the strong curve.
    degrees : float or None
        Angle of the viewer.
    axis, eye : str
        Symbols of the axis and of the direction whose angle it is: r and v, or n and h.
    scale : float
    """
    at, width = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail().x
    line = imgui.get_font_size()
    radius = min(0.5 * width - 2.0 * line, 11.0 * line)
    height = radius + 2.6 * line
    if not imgui.is_rect_visible(imgui.ImVec2(width, height)):
        imgui.dummy(imgui.ImVec2(width, height))
        return
    x, y = at.x + 0.5 * width, at.y + height - 0.9 * line
    _grid(x, y, radius, axis)
    paint = imgui.get_window_draw_list()
    faint, strong = (imgui.get_color_u32(c) for c in (imgui.Col_.text_disabled, imgui.Col_.text))
    for exponent in EXPONENTS:
        if exponent != shininess:
            paint.add_polyline(curve(exponent, x, y, radius), faint, 1.0 * scale, 0)
    paint.add_polyline(curve(shininess, x, y, radius), strong, 2.5 * scale, 0)
    _labels(x, y, radius, shininess)
    if degrees is not None:
        _viewer(x, y, radius, shininess, degrees, eye, scale)
    paint.add_line(imgui.ImVec2(x - radius, y), imgui.ImVec2(x + radius, y), faint)
    imgui.dummy(imgui.ImVec2(width, height))


def _grid(x: float, y: float, radius: float, axis: str) -> None:
    """Half circles at a half and 1, and rays every 30 degrees."""
    paint, line = imgui.get_window_draw_list(), imgui.get_font_size()
    grey, faint = (imgui.get_color_u32(c) for c in (imgui.Col_.border, imgui.Col_.text_disabled))
    centre = imgui.ImVec2(x, y)
    for share in (0.5, 1.0):
        paint.path_arc_to(centre, share * radius, pi, 2.0 * pi, 48)
        paint.path_stroke(grey)
    for angle in (-60, -30, 0, 30, 60):
        dx, dy = sin(radians(angle)), -cos(radians(angle))
        paint.add_line(centre, imgui.ImVec2(x + radius * dx, y + radius * dy), grey)
        text = f"{abs(angle)}°" if angle else axis
        half = 0.5 * imgui.calc_text_size(text).x
        far = radius + 0.7 * line
        place = imgui.ImVec2(x + far * dx - half + 0.3 * line * dx, y + far * dy - 0.6 * line)
        paint.add_text(place, faint, text)


@lru_cache(maxsize=16)
def curve(shininess: float, x: float, y: float, radius: float) -> Places:
    """The curve on the screen, with its origin at x and y; as long as it stands there, once."""
    points = lobe(shininess).tolist()
    return [imgui.ImVec2(x + radius * right, y - radius * up) for right, up in points]


def _labels(x: float, y: float, radius: float, shininess: float) -> None:
    """Each exponent in a column on the left, tied to its curve; the present one right."""
    paint, line = imgui.get_window_draw_list(), imgui.get_font_size()
    faint, strong = (imgui.get_color_u32(c) for c in (imgui.Col_.text_disabled, imgui.Col_.text))
    for i, exponent in enumerate(EXPONENTS):
        up = 0.2 + 0.19 * i
        aside = across(exponent, up)
        height, start = y - radius * up, x - 0.5 * radius
        dot = imgui.ImVec2(x - radius * aside, height)
        paint.add_line(imgui.ImVec2(start, height), dot, faint)
        paint.add_circle_filled(dot, 0.18 * line, faint)
        text = f"{exponent:g}"
        wide = imgui.calc_text_size(text).x + 0.3 * line
        paint.add_text(imgui.ImVec2(start - wide, height - 0.6 * line), faint, text)
    place = imgui.ImVec2(x + 0.45 * radius, y - 0.14 * radius - 0.6 * line)
    paint.add_text(place, strong, f"sh = {shininess:g}")


@lru_cache(maxsize=16)
def across(shininess: float, up: float) -> float:
    """How far from its axis the curve is at the height ``up``."""
    points = lobe(shininess, 721)
    half = points[: len(points) // 2 + 1]  # from the origin up to the top
    return float(np.interp(up, half[:, 1], -half[:, 0]))


def _viewer(
    x: float, y: float, radius: float, shininess: float, degrees: float, eye: str, scale: float
) -> None:
    """The ray to the viewer, and where it meets the curve."""
    paint, line = imgui.get_window_draw_list(), imgui.get_font_size()
    angle = radians(min(degrees, 100.0))
    colour = ink(COLOURS[eye])
    end = imgui.ImVec2(x + radius * sin(angle), y - radius * cos(angle))
    paint.add_line(imgui.ImVec2(x, y), end, imgui.IM_COL32(0, 0, 0, 160), 4.0 * scale)
    paint.add_line(imgui.ImVec2(x, y), end, colour, 2.5 * scale)
    right, up = marker(shininess, degrees)
    spot = imgui.ImVec2(x + radius * right, y - radius * up)
    paint.add_circle_filled(spot, 5.5 * scale, imgui.IM_COL32(0, 0, 0, 255))
    paint.add_circle_filled(spot, 4.0 * scale, colour)
    paint.add_text(imgui.ImVec2(end.x + 0.3 * line, end.y - 0.2 * line), _text(), eye)


def _text() -> int:
    return int(imgui.get_color_u32(imgui.Col_.text))
