"""Ray tracing: its knobs, how far the picture is, what it leaves out, and what to expect of it."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

from imgui_bundle import imgui

from playground.explain.colour_map import VIRIDIS
from playground.gui.rays.traced_aside import MOST
from playground.gui.state import TRACED, State
from playground.gui.widget import plots
from playground.gui.widget.theme import PALETTES
from playground.gui.widgets import Ui, edit
from playground.render.trace.bvh import bvh_of
from playground.scene.scene import Object

KNOBS = ("depth", "threshold", "light_samples", "fresnel", "surfaces", "clear_shadows")


def draw(state: State, ui: Ui) -> State:
    """The knobs of ray tracing, then the picture that is there, then boxes and tests."""
    settings = edit(ui, state.setup.settings, only=KNOBS)
    if settings is not state.setup.settings:
        state = state.with_setup(replace(state.setup, settings=settings))
    _told(state, ui)
    imgui.separator_text("boxes that spare most of the tests")
    chalk = edit(ui, state.chalk)
    if chalk is not state.chalk:
        state = replace(state, chalk=chalk)
    if state.chalk.boxes:
        _boxes(state)
    if state.chalk.tests:
        _scale(state)
    return state


def _told(state: State, ui: Ui) -> None:
    """How far the picture is, what the cut-offs left out, warnings."""
    tracing, alarm = ui.tracing, PALETTES[state.theme].alarm
    if tracing.refused:
        plots.wrapped(f"NumPy traces beside the window: {tracing.refused}", alarm)
    if not tracing.on:
        if not tracing.refused and TRACED not in (state.method, state.other):
            imgui.text_disabled("choose ray-tracing in View, or press Y")
        return
    imgui.progress_bar(tracing.share, imgui.ImVec2(-1.0, 0.4 * imgui.get_font_size()), "")
    imgui.set_item_tooltip("first coarse, then every pixel, then more samples of each")
    imgui.push_text_wrap_pos(0.0)
    imgui.text_disabled(tracing.left_out or "tracing...")
    imgui.pop_text_wrap_pos()
    imgui.set_item_tooltip(
        "depth and threshold cut rays off. Had these rays met light of brightness 1,\n"
        "the picture would be brighter by this: on average over the pixels, and at most"
    )
    for warning in tracing.warnings:
        plots.wrapped(warning, alarm)


def _boxes(state: State) -> None:
    """What the tree of the chosen object is like."""
    objects = state.setup.scene.objects
    if not objects:
        return
    item: Object = objects[min(state.chosen, len(objects) - 1)]
    bvh = bvh_of(item.geometry().mesh)
    level = min(state.chalk.level, bvh.depth - 1)
    count = len(bvh.level(level)[0]) if bvh.nodes else 0
    plural = "box" if count == 1 else "boxes"
    imgui.text_disabled(
        f"{item.mesh.rsplit('/', 1)[-1]}: {bvh.depth} levels, {bvh.nodes} boxes, "
        f"{len(bvh.order)} triangles"
    )
    imgui.text_disabled(f"level {level} has {count} {plural}")


def _scale(state: State) -> None:
    """The colours of the numbers of tests."""
    if state.method != TRACED and state.other != TRACED:
        imgui.text_disabled("shown in the place of the traced picture")
    at, size = imgui.get_cursor_screen_pos(), imgui.get_font_size()
    wide = imgui.get_content_region_avail().x
    paint, step = imgui.get_window_draw_list(), wide / (len(VIRIDIS) - 1)
    inks = [imgui.get_color_u32(imgui.ImVec4(r, g, b, 1.0)) for r, g, b in VIRIDIS.tolist()]
    for i, (a, b) in enumerate(pairwise(inks)):
        low = imgui.ImVec2(at.x + i * step, at.y)
        high = imgui.ImVec2(at.x + (i + 1) * step, at.y + 0.8 * size)
        paint.add_rect_filled_multi_color(low, high, a, b, b, a)
    ink, marks = imgui.get_color_u32(imgui.Col_.text_disabled), ("1", "10", "100", f"{MOST}+ tests")
    for i, mark in enumerate(marks):
        x = at.x + i / (len(marks) - 1) * (wide - imgui.calc_text_size(mark).x)
        paint.add_text(imgui.ImVec2(x, at.y + 0.9 * size), ink, mark)
    imgui.dummy(imgui.ImVec2(wide, 2.1 * size))
