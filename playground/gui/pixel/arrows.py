"""The vectors of the picked pixel as arrows in the picture, and the mark of the pixel."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from math import dist

import numpy as np
from imgui_bundle import imgui
from numpy.typing import NDArray

from playground.explain.pixel import Explanation, ShadedPoint
from playground.gui.picture.canvas import note, segment
from playground.gui.picture.comparison import Picture
from playground.gui.picture.stand import standing, stepped, turned, viewed
from playground.gui.pixel import triangle_mark
from playground.gui.pixel import vector_pen as pen
from playground.gui.pixel.explained import chosen_corner, chosen_light, explained
from playground.gui.state import State
from playground.gui.widget.directions import arc
from playground.render.surface import Surface, surfaces
from playground.render.view import View, view_of
from playground.scene.camera import Camera
from playground.scene.scene import Scene
from playground.scene.settings import Settings, Shading

Array = NDArray[np.float64]
LONG = 1.0 / 3.0  # of the radius of the object
ARC = 0.6  # radius of the arc of ρ, in lengths of an arrow
DOT = 6.0  # pixels around a vertex of the triangle that its dot takes, at text size 1
SHORTEST, LONGEST = 0.12, 0.3  # of the height of the picture


def vectors(point: ShadedPoint, light: int, blinn: bool) -> dict[str, Array]:
    """The unit vectors of a point and one of its lights, by their symbols."""
    found = {"n": point.normal, "v": point.to_eye}
    if light >= 0:
        seen = point.lights[light]
        found |= {"l": seen.to_light, "r": seen.reflection}
        found |= {"h": seen.halfway} if blinn else {}
    return {symbol: found[symbol] for symbol in "nlrhv" if symbol in found}


def arrow_length(radius: float, distance: float, view: View, height: int) -> float:
    """How long an arrow is in the world: by the object, within limits set by the picture."""
    tall = height * view.pixel(height) * distance  # of the picture, where the arrow stands
    return float(np.clip(LONG * radius, SHORTEST * tall, LONGEST * tall))


def draw(state: State, shown: tuple[Picture, ...], origin: imgui.ImVec2, scale: float) -> State:
    """Mark the picked pixel in every picture; its vectors and triangle where it was picked."""
    if state.pixel is None or not shown:
        return state
    number = min(state.clue.picture, len(shown) - 1)
    why = explained(viewed(state, shown[number]), state.pixel)
    aside = standing(state) is not None
    lit = state.clue.lit
    for i, picture in enumerate(shown):
        if i == number and why is not None:
            # Beyond the divider of a wipe, too: the other picture shows the same scene.
            _clip(replace(picture, part=(0.0, 1.0)), origin)
            lit = _explain(state, why, picture, origin, scale)
            imgui.get_window_draw_list().pop_clip_rect()
    for picture in shown:
        _clip(picture, origin)
        _mark(state.pixel, why if aside else None, picture, origin, scale)
        imgui.get_window_draw_list().pop_clip_rect()
    state = state if lit == state.clue.lit else replace(state, clue=replace(state.clue, lit=lit))
    if why is None or not why.corners:
        return replace(state, stand=None) if state.stand is not None else state
    return _stepping(state, why, shown[number], origin, aside)


def _stepping(
    state: State, why: Explanation, picture: Picture, origin: imgui.ImVec2, aside: bool
) -> State:
    """The button in the lower left corner, and the step that it or the key has asked for."""
    size, pad = imgui.get_font_size(), imgui.get_style().frame_padding.y
    low = _screen(np.array([picture.part[0] * picture.box[2], picture.box[3]]), picture, origin)
    imgui.set_cursor_screen_pos(imgui.ImVec2(low[0] + 0.7 * size, low[1] - 1.7 * size - 2.0 * pad))
    if imgui.button("back to the viewer (O)###aside" if aside else "from the side (O)###aside"):
        state = stepped(state)
    if imgui.is_item_hovered(imgui.HoveredFlags_.for_tooltip):
        note("look at the arrows from the side, where v and ρ can be seen; the viewer stays")
    if state.stand is None or not state.stand.due:
        return state
    corner = why.corners[chosen_corner(why, state.clue)]
    light = chosen_light(corner, state.clue)
    reflection = corner.lights[light].reflection if light >= 0 else None
    return turned(state, corner.position, corner.normal, reflection)


def _mark(
    pixel: tuple[float, float],
    aside: Explanation | None,
    picture: Picture,
    origin: imgui.ImVec2,
    scale: float,
) -> None:
    """A ring around the pixel; from aside, around the point that it shows."""
    size, setup = picture.box[2:], picture.setup
    place = np.multiply(pixel, size)
    if aside is not None and aside.corners:
        point = sum(w * c.position for w, c in zip(aside.weights, aside.corners, strict=False))
        _, view = _seen(setup.scene, setup.settings, setup.camera, size)
        place, _ = view.window(np.asarray(point), size)
    if np.isfinite(place).all():
        _ring(_screen(place, picture, origin), scale)


def _explain(
    state: State, why: Explanation, picture: Picture, origin: imgui.ImVec2, scale: float
) -> str:
    """Arrows and triangle in one picture; returns the symbol that is lit from now on."""
    setup, size = picture.setup, picture.box[2:]
    everything, view = _seen(setup.scene, setup.settings, setup.camera, size)
    if why.object is None or why.object >= len(everything):
        return state.clue.lit
    surface = everything[why.object]
    taken = _triangle(why, surface, view, picture, origin, scale)
    corner = why.corners[chosen_corner(why, state.clue)]
    light = chosen_light(corner, state.clue)
    blinn = setup.settings.highlight == "blinn"
    symbols, pixels = _pixels(corner, light, blinn, surface.ball[1], view, size)
    if not pixels:
        return state.clue.lit
    start, *places = [_screen(pixel, picture, origin) for pixel in pixels]
    arrows = {symbol: (start, end) for symbol, end in zip(symbols, places, strict=False)}
    lit, rho = state.clue.lit, corner.lights[light].rho if light >= 0 else None
    plates: dict[str, pen.Rect] = {}
    if rho is not None:
        rim = places[len(symbols) :]
        beyond = max(dist(start, end) for symbol, (_, end) in arrows.items() if symbol in "rv")
        plates = pen.angle(start, rim, f"ρ {rho:.0f}°", lit, beyond, scale)
        rho = None if plates else rho
    if standing(state) is not None:
        _line_to_viewer(corner.position, np.array(why.setup.camera.eye), view, picture, origin)
    for symbol, (_, end) in arrows.items():
        pen.arrow(start, end, symbol, lit, scale)
    plates |= pen.tips(arrows, lit, [*taken, *plates.values()], rho)
    return _hovered(arrows, plates, lit, scale)


def _line_to_viewer(
    point: Array, eye: Array, view: View, picture: Picture, origin: imgui.ImVec2
) -> None:
    """On beyond the tip of v: who is there is seldom in the picture."""
    ends = segment(view, point, eye, picture.box[2:])
    if ends is not None:
        start, end = (imgui.ImVec2(*_screen(np.array(e), picture, origin)) for e in ends)
        imgui.get_window_draw_list().add_line(start, end, pen.ink(pen.COLOURS["v"], 0.6))


@lru_cache(maxsize=4)
def _pixels(
    corner: ShadedPoint, light: int, blinn: bool, radius: float, view: View, size: tuple[int, int]
) -> tuple[tuple[str, ...], list[pen.Point]]:
    """The symbols, and the pixels of the point, of the tips of its vectors, and of the arc.

    Kept while point and view are the same objects: neither ever changes. No pixels where one
    of them lies behind the eye.
    """
    found = vectors(corner, light, blinn)
    away = float(np.linalg.norm(corner.position - view.eye))
    length = arrow_length(radius, away, view, size[1])
    way = arc(found["r"], found["v"]) if light >= 0 else np.empty((0, 3))
    ends = np.vstack([list(found.values()), ARC * way])
    pixels, _ = view.window(np.vstack([corner.position, corner.position + length * ends]), size)
    return tuple(found), _points(pixels)


@lru_cache(maxsize=4)
def _triangle_pixels(
    why: Explanation, surface: Surface, view: View, size: tuple[int, int]
) -> list[pen.Point]:
    """The pixels of the corners of the triangle; none where one lies behind the eye."""
    return _points(view.window(triangle_mark.vertices(why, surface), size)[0])


def _points(pixels: Array) -> list[pen.Point]:
    """Plain numbers, or nothing where one is not finite."""
    return [(x, y) for x, y in pixels.tolist()] if np.isfinite(pixels).all() else []


@lru_cache(maxsize=2)
def _seen(
    scene: Scene, settings: Settings, camera: Camera, size: tuple[int, int]
) -> tuple[tuple[Surface, ...], View]:
    """The objects and how they are seen."""
    everything = surfaces(scene, settings.weights)
    return everything, view_of(camera, everything, size)


def _triangle(
    why: Explanation,
    surface: Surface,
    view: View,
    picture: Picture,
    origin: imgui.ImVec2,
    scale: float,
) -> list[pen.Rect]:
    """The triangle, where the model is evaluated for it; returns where no plate may stand."""
    mode = why.setup.settings.shading
    stale = why.triangle is None or why.triangle >= len(surface.mesh.faces)
    if stale or mode not in (Shading.PER_VERTEX, Shading.FLAT):
        return []
    pixels = _triangle_pixels(why, surface, view, picture.box[2:])
    if not pixels:
        return []
    places = [_screen(pixel, picture, origin) for pixel in pixels]
    labels = triangle_mark.outline(why, places, scale)
    return labels or [pen.around(places, DOT * scale)]


def _hovered(arrows: pen.Arrows, plates: dict[str, pen.Rect], lit: str, scale: float) -> str:
    """The symbol under the mouse; over the panel its word counts, elsewhere nothing is lit."""
    if imgui.is_window_hovered():
        return pen.touched(arrows, plates, scale)
    return lit if imgui.is_window_hovered(imgui.HoveredFlags_.any_window.value) else ""


def _ring(at: pen.Point, scale: float) -> None:
    """The mark of the pixel itself."""
    paint, centre = imgui.get_window_draw_list(), imgui.ImVec2(*at)
    paint.add_circle(centre, 4.0 * scale, imgui.IM_COL32(0, 0, 0, 220), 0, 3.5 * scale)
    paint.add_circle(centre, 4.0 * scale, imgui.IM_COL32(255, 255, 255, 255), 0, 1.5 * scale)


def _screen(pixel: Array | pen.Point, picture: Picture, origin: imgui.ImVec2) -> pen.Point:
    """A place of a picture in ImGui's units."""
    dense = imgui.get_io().display_framebuffer_scale
    x, y = picture.box[:2]
    return origin.x + (x + float(pixel[0])) / dense.x, origin.y + (y + float(pixel[1])) / dense.y


def _clip(picture: Picture, origin: imgui.ImVec2) -> None:
    """Draw nothing outside the part of a picture that is shown."""
    _, _, width, height = picture.box
    first, last = picture.part
    low = _screen((first * width, 0.0), picture, origin)
    high = _screen((last * width, height), picture, origin)
    imgui.get_window_draw_list().push_clip_rect(imgui.ImVec2(*low), imgui.ImVec2(*high), True)
