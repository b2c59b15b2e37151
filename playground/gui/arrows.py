"""The vectors of the picked pixel as arrows in the picture, and the mark of the pixel."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np
from imgui_bundle import imgui
from numpy.typing import NDArray

from playground.explain.pixel import Explanation, ShadedPoint
from playground.gui import triangle_mark
from playground.gui import vector_pen as pen
from playground.gui.comparison import Picture
from playground.gui.explained import chosen_corner, chosen_light, explained
from playground.gui.state import State
from playground.render.surface import Surface, surfaces
from playground.render.view import View, view_of
from playground.scene.camera import Camera
from playground.scene.scene import Scene
from playground.scene.settings import Settings, Shading

Array = NDArray[np.float64]
LONG = 1.0 / 3.0  # of the radius of the object
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
    lit = state.clue.lit
    for i, picture in enumerate(shown):
        _clip(picture, origin)
        if i == number:
            lit = _explain(state, picture, origin, scale)
        _ring(_screen(np.multiply(state.pixel, picture.box[2:]), picture, origin), scale)
        imgui.get_window_draw_list().pop_clip_rect()
    return state if lit == state.clue.lit else replace(state, clue=replace(state.clue, lit=lit))


def _explain(state: State, picture: Picture, origin: imgui.ImVec2, scale: float) -> str:
    """Arrows and triangle in one picture; returns the symbol that is lit from now on."""
    assert state.pixel is not None
    why = explained(picture, state.pixel)
    setup = picture.setup
    everything, view = _seen(setup.scene, setup.settings, setup.camera, picture.box[2:])
    if why is None or why.object is None or why.object >= len(everything):
        return state.clue.lit
    surface, size = everything[why.object], picture.box[2:]
    taken = _triangle(why, surface, view, picture, origin, scale)
    corner = why.corners[chosen_corner(why, state.clue)]
    light = chosen_light(corner, state.clue)
    found = vectors(corner, light, setup.settings.highlight == "blinn")
    away = float(np.linalg.norm(corner.position - view.eye))
    length = arrow_length(surface.ball[1], away, view, size[1])
    tips = corner.position + length * np.array(list(found.values()))
    pixels, _ = view.window(np.vstack([corner.position, tips]), size)
    if not np.isfinite(pixels).all():
        return state.clue.lit
    places = [_screen(pixel, picture, origin) for pixel in pixels]
    arrows = {symbol: (places[0], end) for symbol, end in zip(found, places[1:], strict=True)}
    for symbol, (start, end) in arrows.items():
        pen.arrow(start, end, symbol, state.clue.lit, scale)
    rho = corner.lights[light].rho if light >= 0 else None
    plates = pen.tips(arrows, state.clue.lit, taken, rho)
    return _hovered(arrows, plates, state.clue.lit, scale)


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
    """The triangle, where the model is evaluated for it; returns where its labels are."""
    mode = why.setup.settings.shading
    stale = why.triangle is None or why.triangle >= len(surface.mesh.faces)
    if stale or mode not in (Shading.PER_VERTEX, Shading.FLAT):
        return []
    pixels, _ = view.window(triangle_mark.vertices(why, surface), picture.box[2:])
    if not np.isfinite(pixels).all():
        return []
    places = [_screen(pixel, picture, origin) for pixel in pixels]
    return triangle_mark.outline(why, places, scale)


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


def _screen(pixel: Array, picture: Picture, origin: imgui.ImVec2) -> pen.Point:
    """A place of a picture in ImGui's units."""
    dense = imgui.get_io().display_framebuffer_scale
    x, y = picture.box[:2]
    return origin.x + (x + float(pixel[0])) / dense.x, origin.y + (y + float(pixel[1])) / dense.y


def _clip(picture: Picture, origin: imgui.ImVec2) -> None:
    """Draw nothing outside the part of a picture that is shown."""
    _, _, width, height = picture.box
    first, last = picture.part
    low = _screen(np.array([first * width, 0.0]), picture, origin)
    high = _screen(np.array([last * width, height]), picture, origin)
    imgui.get_window_draw_list().push_clip_rect(imgui.ImVec2(*low), imgui.ImVec2(*high), True)
