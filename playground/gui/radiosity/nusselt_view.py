"""Nusselt's picture on the screen: patch j on the hemisphere over a point of i, and below it."""

from __future__ import annotations

from functools import lru_cache
from math import cos, pi, sin

from imgui_bundle import imgui

from playground.explain.nusselt import Projection, projection
from playground.gui.picture.canvas import ink
from playground.gui.pixel.vector_pen import Places
from playground.gui.radiosity.factor_view import OTHER, FactorView
from playground.gui.widgets import Ui, edit
from playground.render.radiosity.patch.patches import Patches

TILT = 0.42  # the height of the base disc as it is seen aslant, in its radii
RISE = 0.90  # the height of the hemisphere there
HIGH = 11.0  # of the drawing, in heights of the text
STEPS = 48  # of a circle
Place = tuple[float, float]


@lru_cache(maxsize=4)
def kept(patches: Patches, one: int, other: int, place: Place) -> Projection:
    """The projection; the same arguments give the same again."""
    return projection(patches, one, other, place)


def draw(view: FactorView, ui: Ui) -> FactorView:
    """Both drawings and their numbers; returns the view with the point the user chose."""
    patches, one, other = view.of, view.one, view.other
    assert patches is not None and one is not None and other is not None
    view = edit(ui, view, only=("across", "along"))
    of = kept(patches, one, other, (view.across, view.along))
    at, wide = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail().x
    line = imgui.get_font_size()
    radius = min(0.235 * wide, 0.46 * HIGH * line)
    middle = at.y + 0.5 * HIGH * line
    imgui.dummy(imgui.ImVec2(wide, HIGH * line))
    _aslant(of, (at.x + 0.25 * wide, middle + 0.35 * radius), radius)
    _above(of, (at.x + 0.75 * wide, middle), radius)
    if not of.corners:
        imgui.text("j is below the horizon of this point, or turns its back")
        return view
    imgui.text(f"area / π = {of.covered:.5g}")
    imgui.set_item_tooltip("of what is filled on the base disc, which has the area π")
    imgui.text_disabled(f"Lambert's closed form from this point: {of.exact:.5g}")
    return view


def slanted(x: float, y: float, z: float) -> Place:
    """Where a point over the base disc is drawn, right and down in radii."""
    return x, -TILT * y - RISE * z


def _aslant(of: Projection, centre: Place, radius: float) -> None:
    """The hemisphere from the side: j on it, j on the base, and the fall from one to the other."""
    faint, strong = _colours()
    ring = _circle()
    base: Places = [_screen(centre, radius, slanted(x, y, 0.0)) for x, y in ring]
    dome: Places = [_screen(centre, radius, (x, -RISE * y)) for x, y in ring if y >= -1e-9]
    paint = imgui.get_window_draw_list()
    paint.add_polyline(base, faint, 1.0, imgui.ImDrawFlags_.closed.value)
    paint.add_polyline(dome, faint, 1.0, 0)
    paint.add_circle_filled(_screen(centre, radius, (0.0, 0.0)), 2.5, strong)
    if not of.corners:
        return
    outline, height = of.outline.tolist(), of.height.tolist()
    low: Places = [_screen(centre, radius, slanted(x, y, 0.0)) for x, y in outline]
    high: Places = [
        _screen(centre, radius, slanted(x, y, z)) for (x, y), z in zip(outline, height, strict=True)
    ]
    paint.add_concave_poly_filled(low, ink(OTHER, 0.55))
    paint.add_concave_poly_filled(high, ink(OTHER, 0.30))
    paint.add_polyline(high, ink(OTHER), 1.5, imgui.ImDrawFlags_.closed.value)
    for corner in of.corners:
        paint.add_line(high[corner], low[corner], faint, 1.0)


def _above(of: Projection, centre: Place, radius: float) -> None:
    """The base disc from above, j filled."""
    faint, strong = _colours()
    paint = imgui.get_window_draw_list()
    ring: Places = [_screen(centre, radius, (x, -y)) for x, y in _circle()]
    paint.add_convex_poly_filled(ring, imgui.get_color_u32(imgui.Col_.frame_bg))
    paint.add_polyline(ring, strong, 1.0, imgui.ImDrawFlags_.closed.value)
    if of.corners:
        filled: Places = [_screen(centre, radius, (x, -y)) for x, y in of.outline.tolist()]
        paint.add_concave_poly_filled(filled, ink(OTHER, 0.8))
        paint.add_polyline(filled, strong, 1.0, imgui.ImDrawFlags_.closed.value)
    paint.add_circle_filled(_screen(centre, radius, (0.0, 0.0)), 2.0, faint)


def _colours() -> tuple[int, int]:
    faint = imgui.get_color_u32(imgui.Col_.text_disabled)
    return faint, imgui.get_color_u32(imgui.Col_.text)


@lru_cache(maxsize=1)
def _circle() -> tuple[Place, ...]:
    return tuple((cos(2.0 * pi * k / STEPS), sin(2.0 * pi * k / STEPS)) for k in range(STEPS))


def _screen(centre: Place, radius: float, place: Place) -> imgui.ImVec2:
    return imgui.ImVec2(centre[0] + radius * place[0], centre[1] + radius * place[1])
