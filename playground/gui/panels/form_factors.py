"""Form factors under the microscope: two patches, every method, the hemicube, Nusselt's picture."""

from __future__ import annotations

from dataclasses import replace

from imgui_bundle import imgui

from playground.explain.patch_pair import PatchPair
from playground.explain.patch_words import seen
from playground.gui.radiosity import factor_formula, factor_table, hemicube_view, nusselt_view
from playground.gui.radiosity.factor_told import FactorTold
from playground.gui.radiosity.factor_view import ONE, OTHER, FactorView
from playground.gui.state import State
from playground.gui.widgets import Ui, bare, tooltip
from playground.scene.knob import knobs

WORDS = "choose patches in the picture"


def draw(state: State, ui: Ui) -> State:
    """How to choose two patches, and all about those that are chosen."""
    view, told = state.factors, ui.factors
    view = _picking(view)
    if told.error:
        imgui.text_wrapped(told.error)
    elif view.one is None:
        _how(view, told)
    else:
        view = _chosen(view)
        view = _about(view, told, state.setup.settings.form_factors, ui)
    return state if view == state.factors else replace(state, factors=view)


def _picking(view: FactorView) -> FactorView:
    """The switch between choosing patches and explaining pixels."""
    knob = knobs(FactorView)["picking"]
    picking = bare(knob, "picking", view.picking)
    imgui.same_line()
    imgui.text(WORDS)
    tooltip(knob)
    return view if picking == view.picking else replace(view, picking=picking)


def _how(view: FactorView, told: FactorTold) -> None:
    """What to do next."""
    if not view.picking:
        imgui.text_wrapped("How much of the light that leaves one patch arrives at another?")
    elif told.patches is None:
        imgui.text_disabled("dividing the scene into patches...")
    else:
        imgui.text_wrapped(f"{len(told.patches)} patches. Click one of them in the picture.")


def _chosen(view: FactorView) -> FactorView:
    """The two numbers, and buttons to exchange and to forget them."""
    for letter, number, colour in (("i", view.one, ONE), ("j", view.other, OTHER)):
        imgui.align_text_to_frame_padding()
        _square(colour)
        words = f"{letter} = {number}" if number is not None else "click a second patch, j"
        imgui.text(words)
        imgui.same_line()
    if view.other is not None:
        if imgui.button("Swap##pair"):
            view = view.swapped()
        imgui.set_item_tooltip("i for j and j for i")
        imgui.same_line()
    if imgui.button("×##pair"):
        view = view.forgotten()
    imgui.set_item_tooltip("forget both (or right click into the picture)")
    return view


def _square(colour: tuple[float, float, float]) -> None:
    """The colour in which a patch is outlined in the picture."""
    size, at = imgui.get_font_size(), imgui.get_cursor_screen_pos()
    top = at.y + imgui.get_style().frame_padding.y + 0.2 * size
    low, end = imgui.ImVec2(at.x, top), imgui.ImVec2(at.x + 0.6 * size, top + 0.6 * size)
    paint = imgui.get_window_draw_list()
    paint.add_rect_filled(low, end, imgui.get_color_u32(imgui.ImVec4(*colour, 1.0)))
    imgui.set_cursor_screen_pos(imgui.ImVec2(at.x + 0.9 * size, at.y))


def _about(view: FactorView, told: FactorTold, method: str, ui: Ui) -> FactorView:
    """Everything about the chosen patch, or the two."""
    if view.other is not None:
        if told.pair is not None:
            _pair(told.pair, method)
        else:
            imgui.text_disabled("computing...")
    imgui.separator_text(f"the hemicube of i = {view.one}, unfolded")
    if told.hemicube is not None:
        view = hemicube_view.draw(view, told, ui)
    else:
        imgui.text_disabled("looking around...")
    if view.other is not None:
        imgui.separator_text("Nusselt: onto the hemisphere, then down")
        view = nusselt_view.draw(view, ui)
    return view


def _pair(pair: PatchPair, method: str) -> None:
    """Formula, table, reciprocity and row sums."""
    factor_formula.draw(pair)
    imgui.push_style_color(imgui.Col_.text, imgui.get_style().color_(imgui.Col_.text_disabled))
    imgui.text_wrapped(seen(pair))
    imgui.pop_style_color()
    factor_table.draw(pair, method)
    told = pair.told(method)
    if told is not None:
        imgui.text(f"AᵢFᵢⱼ − AⱼFⱼᵢ = {told.exchange:.2e}")
        imgui.set_item_tooltip(f"{method}, that of the settings; 0 by reciprocity")
        imgui.text(f"row sums {told.sums[0]:.5f} of i, {told.sums[1]:.5f} of j")
        imgui.set_item_tooltip(f"{method}, as they come, before any correction")
