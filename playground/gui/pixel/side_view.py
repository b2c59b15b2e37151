"""The vectors of a point seen from the side, so that ρ appears in its true size.

In the picture v always points into the eye, and the plane of r and v is seen edge-on:
from there nobody can see an angle between them.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from math import pi

import numpy as np
from imgui_bundle import imgui
from numpy.typing import NDArray

from playground.explain.pixel import ShadedPoint
from playground.gui.pixel import vector_pen as pen
from playground.gui.pixel.arrows import vectors
from playground.gui.widget.directions import LEAST, arc

Array = NDArray[np.float64]
DISC = 0.9  # radius of the disc, in lengths of an arrow
ARC = 0.6  # radius of the arc, in the same
NARROW = 35.0  # degrees


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


@dataclass(frozen=True, eq=False)
class Side:
    """A drawing in lengths of an arrow, right and up from the point: nothing of the screen."""

    arrows: dict[str, pen.Point]  # where the tips are
    rim: tuple[pen.Point, ...]  # of a disc that touches the surface
    arc: tuple[pen.Point, ...]  # from r to v; empty without a light
    rho: float | None  # degrees between them
    lowest: float


@lru_cache(maxsize=8)
def side(point: ShadedPoint, light: int, blinn: bool) -> Side:
    """The drawing for a point and one of its lights (-1 for none); a point never changes."""
    found = vectors(point, light, blinn)
    normal, last = found["n"], found["v"]
    first = found.get("r", normal)
    axes = side_axes(normal, first, last)
    flat = {symbol: axes @ vector for symbol, vector in found.items()}
    tilt = max(1.0 - float(flat["n"] @ flat["n"]), 0.0) ** 0.5  # of the disc towards us
    return Side(
        arrows={symbol: (float(tip[0]), float(tip[1])) for symbol, tip in flat.items()},
        rim=_points(_disc(normal) @ axes.T),
        arc=_points(arc(first, last) @ axes.T) if light >= 0 else (),
        rho=point.lights[light].rho if light >= 0 else None,
        lowest=min(-DISC * tilt, *(float(tip[1]) for tip in flat.values())),
    )


def _disc(normal: Array, count: int = 48) -> Array:
    """The rim (count, 3) of a disc that touches the surface at the point."""
    one = np.cross(normal, np.eye(3)[int(np.argmin(np.abs(normal)))])
    one = one / np.linalg.norm(one)
    two = np.cross(normal, one)
    turns = np.linspace(0.0, 2.0 * pi, count, endpoint=False)[:, None]
    return np.asarray(DISC * (np.cos(turns) * one + np.sin(turns) * two))


def _points(places: Array) -> tuple[pen.Point, ...]:
    return tuple((right, up) for right, up in places.tolist())


def draw(of: Side, lit: str, scale: float) -> str:
    """The drawing at the cursor, with ``lit`` lit; returns the symbol under the mouse."""
    at, width = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail().x
    line = imgui.get_font_size()
    room = imgui.ImVec2(width, 10.5 * line)
    if not imgui.is_rect_visible(room):
        imgui.dummy(room)
        return ""
    radius = (room.y - 2.9 * line) / max(1.0 - of.lowest, 1.1)
    x, y = at.x + 0.5 * width, at.y + 1.9 * line + radius
    paint = imgui.get_window_draw_list()
    paint.push_clip_rect(at, imgui.ImVec2(at.x + room.x, at.y + room.y), True)
    rim, path = on_screen(of, x, y, radius)
    paint.add_convex_poly_filled(rim, imgui.get_color_u32(imgui.Col_.frame_bg))
    border = imgui.get_color_u32(imgui.Col_.text_disabled)
    paint.add_polyline([*rim, rim[0]], border, 1.0, 0)
    arrows = {
        symbol: ((x, y), (x + radius * right, y - radius * up))
        for symbol, (right, up) in of.arrows.items()
    }
    for symbol, (start, end) in arrows.items():
        pen.arrow(start, end, symbol, lit, 0.8 * scale)
    plates = {}
    if of.rho is not None:
        strong, thick = imgui.get_color_u32(imgui.Col_.text), 4.0 if lit == "ρ" else 2.0
        paint.add_polyline(path, strong, thick, 0)
        plates["ρ"] = _rho(of.arc, of.rho, (x, y), ARC * radius, lit)
    plates |= pen.tips(arrows, lit, list(plates.values()))
    paint.pop_clip_rect()
    imgui.dummy(room)
    return pen.touched(arrows, plates, scale) if imgui.is_item_hovered() else ""


@lru_cache(maxsize=2)
def on_screen(of: Side, x: float, y: float, radius: float) -> tuple[pen.Places, pen.Places]:
    """The rim and the arc on the screen; as long as they stand there, once."""
    rim = [imgui.ImVec2(x + radius * right, y - radius * up) for right, up in of.rim]
    near = ARC * radius
    return rim, [imgui.ImVec2(x + near * right, y - near * up) for right, up in of.arc]


def _rho(
    path: tuple[pen.Point, ...], rho: float, at: pen.Point, radius: float, lit: str
) -> pen.Rect:
    """The symbol beside the angle; returns where it is."""
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
