"""The rays behind the picked pixel as arrows in the picture, with a legend of their kinds."""

from __future__ import annotations

from dataclasses import replace
from math import hypot, sin
from typing import Any

import numpy as np
from imgui_bundle import imgui

from playground.explain.ray_tree import RayTree
from playground.gui.picture.canvas import Canvas, ink, note, segment
from playground.gui.picture.comparison import Picture
from playground.gui.picture.gizmo_math import Pixel, seen
from playground.gui.picture.stand import standing, stepped, turned, viewed
from playground.gui.pixel import vector_pen as pen
from playground.gui.rays.ray_colours import RAYS, WORDS
from playground.gui.rays.ray_lines import RayLine, lines
from playground.gui.rays.ray_trees import deepest, gone, key_of, tree_of
from playground.gui.rays.ray_view import RayView
from playground.gui.state import State
from playground.render.view import View
from playground.shading.vector import reflection

HEAD = 10.0  # length of an arrowhead, at text size 1
SHORT = 0.4  # of a ray is its head at most
WIDE, THIN = 2.5, 1.3  # of a ray and of a shadow ray
FLASH, FLASHES = 2.5, 9.0  # how much wider a pointed ray becomes; radians per second
CUT = 0.15  # of its strength keeps a ray that is cut off
WHITE, DARK = (1.0, 1.0, 1.0), (0.0, 0.0, 0.0)


def wanted(state: State, shown: tuple[Picture, ...]) -> bool:
    """Whether the explained pixel is one of a traced picture."""
    if state.pixel is None or not shown:
        return False
    return shown[min(state.clue.picture, len(shown) - 1)].traced


def draw(state: State, shown: tuple[Picture, ...], origin: Any, dense: Any, scale: float) -> State:
    """The rays over the picture whose pixel was picked; the pixel's ring over every picture."""
    assert state.pixel is not None
    number = min(state.clue.picture, len(shown) - 1)
    tree = tree_of(viewed(state, shown[number]), state.pixel)
    if tree is None:
        return state
    rays = state.rays.for_tree(key_of(tree))
    rays = rays.later(imgui.get_io().delta_time, deepest(tree))
    for i, picture in enumerate(shown):
        canvas = Canvas(origin, dense, scale, picture.box)
        view = seen(picture.setup.scene, picture.setup.camera, canvas.size)
        _clip(picture, canvas)
        if i == number:
            rays = _rays(tree, rays, picture, view, canvas)
        if standing(state) is None:
            _ring(np.multiply(state.pixel, canvas.size).tolist(), canvas)
        imgui.get_window_draw_list().pop_clip_rect()
    canvas = Canvas(origin, dense, scale, shown[number].box)
    _legend(tree, shown[number], canvas)
    state = state if rays is state.rays else replace(state, rays=rays)
    return _stepping(state, tree, shown[number], canvas)


def _rays(tree: RayTree, rays: RayView, picture: Picture, view: View, canvas: Canvas) -> RayView:
    """All arrows; returns which of them the mouse points at."""
    cut, grown = gone(tree, rays), rays.grows_to(deepest(tree))
    pointed = rays.lit if rays.lit >= 0 else rays.chosen
    places: dict[int, tuple[Pixel, Pixel]] = {}
    said: list[tuple[str, Pixel]] = []
    every = list(lines(tree, picture.setup.bounds()[1], pointed))
    for line in sorted(every, key=lambda line: (line.node == pointed, not line.shadow)):
        share = line.grown(grown)
        ends = segment(view, line.start, line.tip(share), canvas.size) if share > 0.0 else None
        if ends is None:
            continue
        alpha = CUT if line.node in cut else 1.0
        if pointed >= 0 and line.node != pointed:
            alpha *= pen.FADED
        _arrow(line, ends, canvas, alpha, line.node == rays.lit)
        if not line.shadow:
            places[line.node] = ends
        if line.words and share == 1.0:
            said.append((line.words, ends[1]))
    _words(said, canvas)
    return replace_lit(rays, _touched(places, rays.lit, canvas))


def replace_lit(rays: RayView, lit: int) -> RayView:
    """The same with another node pointed at."""
    return rays if lit == rays.lit else replace(rays, lit=lit)


def _arrow(
    line: RayLine, ends: tuple[Pixel, Pixel], canvas: Canvas, alpha: float, flashes: bool
) -> None:
    """A line with a head at its end; thin and broken for a shadow ray."""
    (x, y), (tip_x, tip_y) = ends
    right, down = tip_x - x, tip_y - y
    long = hypot(right, down)
    if long < 2.0:
        return
    wide, colour = THIN if line.shadow else WIDE, RAYS[line.kind]
    if flashes:
        wide += FLASH * (0.5 + 0.5 * sin(FLASHES * imgui.get_time()))
    head = min((HEAD + 2.0 * wide) * canvas.unit, SHORT * long)
    right, down = right / long * head, down / long * head
    neck = (tip_x - 0.8 * right, tip_y - 0.8 * down)
    if line.shadow:
        _dashes((x, y), neck, canvas, line.kind, wide, alpha)
    else:
        canvas.line((x, y), neck, colour, wide, alpha)
    left = (tip_x - right - 0.4 * down, tip_y - down + 0.4 * right)
    other = (tip_x - right + 0.4 * down, tip_y - down - 0.4 * right)
    corners = canvas.at(ends[1]), canvas.at(left), canvas.at(other)
    paint = imgui.get_window_draw_list()
    paint.add_triangle_filled(*corners, ink(colour, alpha))
    paint.add_triangle(*corners, ink(DARK, 0.6 * alpha), canvas.scale)


def _dashes(a: Pixel, b: Pixel, canvas: Canvas, kind: str, wide: float, alpha: float) -> None:
    """A broken line over a dark one."""
    paint, colour = imgui.get_window_draw_list(), ink(RAYS[kind], alpha)
    under = ink(DARK, 0.5 * alpha)
    paint.add_line(canvas.at(a), canvas.at(b), under, (wide + 1.5) * canvas.scale)
    count = int(min(max(hypot(b[0] - a[0], b[1] - a[1]) / (9.0 * canvas.unit), 1.0), 80.0))
    for i in range(count):
        low, high = i / count, (i + 0.6) / count
        start = (a[0] + low * (b[0] - a[0]), a[1] + low * (b[1] - a[1]))
        end = (a[0] + high * (b[0] - a[0]), a[1] + high * (b[1] - a[1]))
        paint.add_line(canvas.at(start), canvas.at(end), colour, wide * canvas.scale)


def _words(said: list[tuple[str, Pixel]], canvas: Canvas) -> None:
    """What blocks shadow rays, beside their ends; no plate covers another."""
    paint, pad, taken = imgui.get_window_draw_list(), 4.0 * canvas.scale, list[pen.Rect]()
    for words, at in said:
        place, size = canvas.at(at), imgui.calc_text_size(words)
        rect = place.x + 3.0 * pad, place.y - 0.5 * size.y, size.x + 2.0 * pad, size.y
        x, y, wide, high = pen.apart(rect, taken)
        taken.append((x, y, wide, high))
        paint.add_rect_filled(imgui.ImVec2(x, y), imgui.ImVec2(x + wide, y + high), ink(DARK, 0.65))
        paint.add_text(imgui.ImVec2(x + pad, y), ink(WHITE), words)


def _touched(places: dict[int, tuple[Pixel, Pixel]], lit: int, canvas: Canvas) -> int:
    """The node whose ray is under the mouse; over the panel the one that its diagram says."""
    if not imgui.is_window_hovered():
        return lit if imgui.is_window_hovered(imgui.HoveredFlags_.any_window.value) else -1
    mouse = imgui.get_io().mouse_pos
    far = {}
    for node, (a, b) in places.items():
        start, end = canvas.at(a), canvas.at(b)
        far[node] = pen.distance((mouse.x, mouse.y), (start.x, start.y), (end.x, end.y))
    best = min(far, key=lambda node: far[node], default=-1)
    return best if best >= 0 and far[best] <= pen.REACH * canvas.scale else -1


def _ring(at: list[float], canvas: Canvas) -> None:
    """The mark of the pixel itself."""
    paint, centre = imgui.get_window_draw_list(), canvas.at((at[0], at[1]))
    paint.add_circle(centre, 4.0 * canvas.scale, ink(DARK, 0.85), 0, 3.5 * canvas.scale)
    paint.add_circle(centre, 4.0 * canvas.scale, ink(WHITE), 0, 1.5 * canvas.scale)


def _legend(tree: RayTree, picture: Picture, canvas: Canvas) -> None:
    """The kinds of rays that this tree has, in the lower left corner."""
    shadows = {ray.kind for node in tree.nodes for light in node.lights for ray in light.rays}
    present = {node.kind for node in tree.nodes} | shadows
    kinds = [kind for kind in RAYS if kind in present]
    size, pad = imgui.get_font_size(), 0.4 * imgui.get_font_size()
    wide = max(imgui.calc_text_size(WORDS[kind]).x for kind in kinds) + 2.2 * size + 2.0 * pad
    corner = canvas.at((picture.part[0] * canvas.size[0], float(canvas.size[1])))
    left, top = corner.x + 0.7 * size, corner.y - 3.1 * size - (len(kinds) * 1.15) * size - pad
    paint, high = imgui.get_window_draw_list(), len(kinds) * 1.15 * size + 2.0 * pad
    low, end = imgui.ImVec2(left, top), imgui.ImVec2(left + wide, top + high)
    paint.add_rect_filled(low, end, ink(DARK, 0.65), 4.0 * canvas.scale)
    for i, kind in enumerate(kinds):
        y = top + pad + 1.15 * size * i
        a = imgui.ImVec2(left + pad, y + 0.6 * size)
        b = imgui.ImVec2(left + pad + 1.5 * size, y + 0.6 * size)
        paint.add_line(a, b, ink(RAYS[kind]), (THIN if kind in shadows else WIDE) * canvas.scale)
        at = imgui.ImVec2(left + pad + 1.9 * size, y)
        paint.add_text(at, ink(WHITE), WORDS[kind])


def _stepping(state: State, tree: RayTree, picture: Picture, canvas: Canvas) -> State:
    """The button in the lower left corner, and the step aside that it or the key has asked for."""
    root = tree.root
    if root.end is None or root.normal is None:
        return replace(state, stand=None) if state.stand is not None else state
    size, pad = imgui.get_font_size(), imgui.get_style().frame_padding.y
    low = canvas.at((picture.part[0] * canvas.size[0], float(canvas.size[1])))
    imgui.set_cursor_screen_pos(imgui.ImVec2(low.x + 0.7 * size, low.y - 1.7 * size - 2.0 * pad))
    aside = standing(state) is not None
    if imgui.button("back to the viewer (O)###aside" if aside else "from the side (O)###aside"):
        state = stepped(state)
    if imgui.is_item_hovered(imgui.HoveredFlags_.for_tooltip):
        note("look at the rays from the side: from the eye, the first one is a point")
    if state.stand is None or not state.stand.due:
        return state
    mirrored = reflection(root.normal, -root.direction)
    words = "from the side; the picture is the one seen from here"
    return turned(state, root.end, root.normal, mirrored).say(words)


def _clip(picture: Picture, canvas: Canvas) -> None:
    """Draw nothing outside the part of a picture that is shown."""
    first, last = (share * canvas.size[0] for share in picture.part)
    low, high = canvas.at((first, 0.0)), canvas.at((last, float(canvas.size[1])))
    imgui.get_window_draw_list().push_clip_rect(low, high, True)
