"""Why a traced pixel has its colour: its tree of rays, each node in words, and their sum."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from imgui_bundle import imgui

from playground.explain.ray_tree import RayNode, RayTree
from playground.gui.picture.comparison import Picture
from playground.gui.picture.pixel_pick import forget
from playground.gui.pixel import rows
from playground.gui.rays import ray_diagram, ray_words
from playground.gui.rays.ray_colours import legend
from playground.gui.rays.ray_trees import deepest, gone, key_of, tree_of
from playground.gui.rays.ray_view import ALL, RayView
from playground.gui.state import State
from playground.gui.widgets import Ui

PLAIN = imgui.ColorEditFlags_.no_tooltip.value | imgui.ColorEditFlags_.no_drag_drop.value
ROWS = 9  # of the list


def draw(state: State, picture: Picture, ui: Ui) -> State:
    """The tree of the picked pixel of a traced picture; returns what the user made of it."""
    assert state.pixel is not None
    tree = tree_of(picture, state.pixel)
    if tree is None:
        imgui.text_wrapped("The rays of this pixel cannot be followed.")
        return state
    samples = tree.setup.settings.samples
    mean = f"; the picture is the mean of {samples} samples" if samples > 1 else ""
    forgotten = rows.head(
        f"pixel ({tree.pixel[0]}, {tree.pixel[1]}), {plural(len(tree.nodes))}",
        f"through the centre of the pixel, in float64{mean}",
    )
    rays = state.rays.for_tree(key_of(tree))
    if imgui.is_window_hovered(imgui.HoveredFlags_.child_windows.value):
        rays = replace(rays, lit=-1) if rays.lit >= 0 else rays
    before, cut, depth = state.rays, gone(tree, rays), deepest(tree)
    rays = _steps(rays, depth)
    hit, clicked = ray_diagram.draw(
        tree, before.lit if before.of == rays.of else -1, rays.chosen, cut, rays.grows_to(depth)
    )
    rays = _pointed_at(rays, hit, clicked)
    if hit >= 0:
        _tooltip(tree, hit)
    kinds = dict.fromkeys(node.kind for node in tree.nodes)
    legend(list(kinds))
    _sum(tree, cut)
    rays = _list(tree, rays, cut, before.lit)
    _node(tree, rays)
    state = state if rays == state.rays else replace(state, rays=rays)
    return forget(state) if forgotten else state


def plural(count: int) -> str:
    """So many rays."""
    return f"{count} ray" if count == 1 else f"{count} rays"


def _steps(rays: RayView, depth: int) -> RayView:
    """Bounce by bounce, by hand or by itself."""
    if imgui.button("−##bounce"):
        rays = rays.stepped(-1, depth)
    imgui.set_item_tooltip("one bounce less")
    imgui.same_line()
    if imgui.button("+##bounce"):
        rays = rays.stepped(1, depth)
    imgui.set_item_tooltip("one bounce more")
    imgui.same_line()
    if imgui.button("Stop###grow" if rays.playing else "Animate###grow"):
        rays = rays.played()
    imgui.set_item_tooltip("let the rays grow from the eye, bounce after bounce")
    imgui.same_line()
    now = depth if rays.step == ALL else min(rays.step, depth)
    now = min(int(rays.grown), depth) if rays.playing else now
    imgui.align_text_to_frame_padding()
    imgui.text_disabled(f"depth {now} of {depth}")
    return rays


def _pointed_at(rays: RayView, hit: int, clicked: bool) -> RayView:
    rays = replace(rays, lit=hit) if hit >= 0 else rays
    if clicked:
        rays = replace(rays, chosen=-1 if rays.chosen == hit else hit)
    return rays


def _sum(tree: RayTree, cut: frozenset[int]) -> None:
    """The pixel, without what is cut off, and whether the weights multiply out to it."""
    left, away = tree.prune(*cut), tree.branch(*cut)
    imgui.separator_text("the pixel is the sum of weight ⊗ colour")
    side = imgui.get_frame_height()
    size = imgui.ImVec2(2.0 * side, side)
    for name, colour in (("pixel", tree.colour), ("left", left)):
        imgui.color_button(f"##{name}", ray_diagram.shown(tree, colour), PLAIN, size)
        imgui.same_line()
        imgui.align_text_to_frame_padding()
        imgui.text(ray_words.numbers(colour))
        imgui.same_line()
        imgui.text_disabled("all rays" if name == "pixel" else "pruned")
    words = f"cut off is exactly {ray_words.numbers(away)}"
    imgui.text_disabled(words if cut else "untick a ray below to cut its branch off")
    off, allowed = tree.error, tree.rounding
    holds = "the weights multiply out to the pixel" if tree.adds_up else "the weights do not add up"
    by = f"{off:.1e}" if off else "0"
    imgui.text_wrapped(f"{holds}: off by {by}, rounding allows {allowed:.1e}")
    if np.any(tree.unfollowed):
        imgui.text_disabled(f"rays not followed weigh {ray_words.numbers(tree.unfollowed)}")


def _node(tree: RayTree, rays: RayView) -> None:
    """Everything about the chosen node, else the first; that under the mouse has a tooltip."""
    chosen = rays.chosen if 0 <= rays.chosen < len(tree.nodes) else 0
    imgui.separator_text(f"ray {chosen}")
    for text in ray_words.told(tree, tree.nodes[chosen]):
        if text:
            imgui.text_wrapped(text)


def _tooltip(tree: RayTree, number: int) -> None:
    """The same beside the mouse."""
    if imgui.begin_tooltip():
        imgui.push_text_wrap_pos(24.0 * imgui.get_font_size())
        for text in filter(None, ray_words.told(tree, tree.nodes[number])):
            imgui.text_unformatted(text)
        imgui.pop_text_wrap_pos()
        imgui.end_tooltip()


def _list(tree: RayTree, rays: RayView, cut: frozenset[int], lit: int) -> RayView:
    """Every node as a row; many of them scroll in a box of their own."""
    imgui.separator_text("every ray")
    if len(tree.nodes) <= ROWS:
        return _rows(tree, rays, cut, lit)
    high = ROWS * imgui.get_frame_height_with_spacing()
    if imgui.begin_child("rays", imgui.ImVec2(0.0, high)):
        rays = _rows(tree, rays, cut, lit)
    imgui.end_child()
    return rays


def _fitting(node: RayNode) -> str:
    """As much about a node as there is room for; its tooltip says all."""
    texts, room = ray_words.lines(node), imgui.get_content_region_avail().x
    return next((text for text in texts if imgui.calc_text_size(text).x <= room), texts[-1])


def _rows(tree: RayTree, rays: RayView, cut: frozenset[int], lit: int) -> RayView:
    """The ticks keep branches on the tree."""
    side = imgui.get_text_line_height()
    for node in tree.nodes:
        inset = 0.8 * imgui.get_font_size() * node.depth
        imgui.set_cursor_pos_x(imgui.get_cursor_pos_x() + inset)
        kept = imgui.checkbox(f"##keep {node.number}", node.number not in rays.pruned)[1]
        if kept == (node.number in rays.pruned):
            rays = rays.toggled(node.number)
        imgui.set_item_tooltip("on the tree, with all that grows on it")
        imgui.same_line()
        colour = ray_diagram.shown(tree, node.local)
        imgui.set_cursor_pos_y(imgui.get_cursor_pos_y() + imgui.get_style().frame_padding.y)
        imgui.color_button(f"##ray {node.number}", colour, PLAIN, imgui.ImVec2(side, side))
        imgui.same_line()
        on, faint = node.number in (rays.chosen, lit), node.number in cut
        imgui.begin_disabled(faint)
        if imgui.selectable(f"{_fitting(node)}###row {node.number}", on)[0]:
            rays = _pointed_at(rays, node.number, True)
        hovered = imgui.is_item_hovered(imgui.HoveredFlags_.allow_when_disabled.value)
        imgui.end_disabled()
        if hovered:
            rays = replace(rays, lit=node.number)
            _tooltip(tree, node.number)
    return rays
