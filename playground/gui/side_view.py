"""The vectors of a point seen from the side, so that ρ appears in its true size.

In the picture v always points into the eye, and the plane of r and v is seen edge-on:
from there nobody can see an angle between them.
"""

from __future__ import annotations

from math import pi

import numpy as np
from imgui_bundle import imgui
from numpy.typing import NDArray

from playground.gui import vector_pen as pen

Array = NDArray[np.float64]
DISC = 0.9  # radius of the disc, in lengths of an arrow
NARROW = 35.0  # degrees
LEAST = 1e-3  # sine of an angle below which two directions count as one


def side_axes(normal: Array, a: Array, b: Array) -> Array:
    """Axes (2, 3) of a drawing, right and up: it shows the plane of ``a`` and ``b`` unturned.

    Up is the normal as far as the drawing shows it; ``b`` leans to the right.
    """
    pairs = ((a, b), (normal, b), *((normal, axis) for axis in np.eye(3)))
    ahead = next(c for c in (np.cross(*pair) for pair in pairs) if np.linalg.norm(c) > LEAST)
    ahead = ahead / np.linalg.norm(ahead)
    up = normal - (normal @ ahead) * ahead
    if np.linalg.norm(up) < 0.1:  # seen along the normal
        up = a + b - ((a + b) @ ahead) * ahead
    up = up / np.linalg.norm(up) if np.linalg.norm(up) > LEAST else np.cross(ahead, b)
    right = np.cross(up, ahead)
    return np.stack([right if right @ b >= 0.0 else -right, up])


def arc(a: Array, b: Array, count: int = 25) -> Array:
    """Unit vectors (count, 3) on the way from ``a`` to ``b``."""
    angle = float(np.arccos(np.clip(a @ b, -1.0, 1.0)))
    shares = np.linspace(0.0, 1.0, count)[:, None]
    if angle < LEAST or angle > pi - LEAST:
        return np.repeat(a[None], count, axis=0)
    mixed = np.sin((1.0 - shares) * angle) * a + np.sin(shares * angle) * b
    return np.asarray(mixed / np.sin(angle))


def draw(vectors: dict[str, Array], ends: str, rho: float | None, lit: str, scale: float) -> str:
    """The drawing at the cursor; returns the symbol under the mouse.

    Parameters
    ----------
    vectors : dict
        Unit vectors (3,) by their symbols; n and v among them.
    ends : str
        The two symbols that the arc joins.
    rho : float or None
        Degrees between them; None for no arc.
    lit : str
        The symbol that is lit.
    scale : float
    """
    at, width = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail().x
    line = imgui.get_font_size()
    height = 10.5 * line
    first, last = vectors.get(ends[0], vectors["n"]), vectors[ends[1]]
    axes = side_axes(vectors["n"], first, last)
    flat = {symbol: axes @ vector for symbol, vector in vectors.items()}
    tilt = max(1.0 - float(flat["n"] @ flat["n"]), 0.0) ** 0.5  # of the disc towards us
    lowest = min(-DISC * tilt, *(float(place[1]) for place in flat.values()))
    radius = (height - 2.9 * line) / max(1.0 - lowest, 1.1)
    x, y = at.x + 0.5 * width, at.y + 1.9 * line + radius
    paint = imgui.get_window_draw_list()
    corner = imgui.ImVec2(at.x + width, at.y + height)
    paint.push_clip_rect(at, corner, True)
    _surface(axes, vectors["n"], x, y, radius)
    arrows = {
        symbol: ((x, y), (x + radius * float(place[0]), y - radius * float(place[1])))
        for symbol, place in flat.items()
    }
    for symbol, (start, end) in arrows.items():
        pen.arrow(start, end, symbol, lit, 0.8 * scale)
    plates = {}
    if rho is not None:
        plates["ρ"] = _arc(axes, first, last, (x, y), 0.6 * radius, rho, lit)
    plates |= pen.tips(arrows, lit, list(plates.values()))
    paint.pop_clip_rect()
    imgui.dummy(imgui.ImVec2(width, height))
    return pen.touched(arrows, plates, scale) if imgui.is_item_hovered() else ""


def _surface(axes: Array, normal: Array, x: float, y: float, radius: float) -> None:
    """A disc that touches the surface at the point."""
    one = np.cross(normal, np.eye(3)[int(np.argmin(np.abs(normal)))])
    one = one / np.linalg.norm(one)
    two = np.cross(normal, one)
    turns = np.linspace(0.0, 2.0 * pi, 48, endpoint=False)[:, None]
    rim = (DISC * (np.cos(turns) * one + np.sin(turns) * two) @ axes.T).tolist()
    places: pen.Places = [imgui.ImVec2(x + radius * p[0], y - radius * p[1]) for p in rim]
    paint = imgui.get_window_draw_list()
    paint.add_convex_poly_filled(places, imgui.get_color_u32(imgui.Col_.frame_bg))
    border = imgui.get_color_u32(imgui.Col_.text_disabled)
    paint.add_polyline([*places, places[0]], border, 1.0, 0)


def _arc(
    axes: Array, a: Array, b: Array, at: pen.Point, radius: float, rho: float, lit: str
) -> pen.Rect:
    """The angle in its true size, its symbol beside it; returns where that is."""
    path = (axes @ arc(a, b).T).T.tolist()
    places: pen.Places = [
        imgui.ImVec2(at[0] + radius * right, at[1] - radius * up) for right, up in path
    ]
    paint = imgui.get_window_draw_list()
    colour = imgui.get_color_u32(imgui.Col_.text)
    paint.add_polyline(places, colour, 4.0 if lit == "ρ" else 2.0, 0)
    line = imgui.get_font_size()
    half = 0.5 * pen.plate_width("ρ")
    if rho < NARROW:  # beside the arrows: between them there is no room
        aside = max(right for right, _ in path)
        spot = (radius * aside + 1.2 * line, radius * path[len(path) // 2][1])
    else:
        right, up = path[len(path) // 3]
        spot = ((radius + 1.1 * line) * right, (radius + 1.1 * line) * up)
    place = (at[0] + spot[0] - half, at[1] - spot[1] - 0.6 * line)
    return (*place, pen.plate(place, "ρ", lit), 1.2 * line)
