"""Why a pixel has its colour: vectors, one line per term and light, sum, clamp, lobe."""

from __future__ import annotations

from dataclasses import replace

from imgui_bundle import imgui

from playground.explain.pixel import Explanation
from playground.explain.words import CORNERS
from playground.gui.picture.comparison import pictures
from playground.gui.picture.pixel_pick import forget
from playground.gui.picture.stand import viewed
from playground.gui.pixel import filter_bars, lobe_plot, rows, side_view, triangle_lens
from playground.gui.pixel.clue import Clue
from playground.gui.pixel.equation import write
from playground.gui.pixel.explained import chosen_corner, chosen_light, explained
from playground.gui.pixel.telling import (
    LIT_TERMS,
    ChosenLight,
    LightTold,
    PointTold,
    point_told,
)
from playground.gui.radiosity import stored_panel
from playground.gui.rays import ray_tree_panel
from playground.gui.state import State
from playground.gui.widgets import Ui
from playground.scene.settings import Shading

SYMBOLS = {"diffuse": "d", "specular": "s", "ambient": "a"}
BY_CHANCE = (
    "The pixels of this picture are means of paths by chance: none has terms of its own. Click the "
    "same point in another picture, by radiosity say."
)


def draw(state: State, ui: Ui) -> State:
    """The explanation of the picked pixel, or how to pick one."""
    if state.pixel is None:
        imgui.text_wrapped("Click a point of the picture, or hold Shift and move over it.")
        return state
    shown = pictures(state, *ui.view)
    picture = shown[min(state.clue.picture, len(shown) - 1)]
    if picture.traced:
        return ray_tree_panel.draw(state, viewed(state, picture), ui)
    if picture.stored:
        return stored_panel.draw(state, picture, ui)
    why = explained(viewed(state, picture), state.pixel)
    if picture.paths:
        imgui.text_wrapped(BY_CHANCE)
        return state
    if why is None:
        imgui.text_wrapped("This pixel cannot be explained.")
        return state
    forgotten = rows.head(
        f"pixel ({why.pixel[0]}, {why.pixel[1]}), {why.setup.settings.shading}",
        f"of {why.size[0]} × {why.size[1]}; computed in float64",
    )
    if why.setup.settings.bugs:
        imgui.text_wrapped("The picture makes mistakes on purpose; this is the right colour.")
    over, clue = imgui.is_window_hovered(), state.clue
    lit = clue.lit if not over else ""
    if why.corners:
        clue, lit = _body(why, clue, lit, ui.scale)
    else:
        itself = f"Light {why.light} itself: the colour it emits, s_d; its back is dark."
        nothing = "No surface here: the background."
        imgui.text_wrapped(nothing if why.light is None else itself)
        rows.display(why)
    clue = clue if clue.lit == lit else replace(clue, lit=lit)
    state = state if clue is state.clue else replace(state, clue=clue)
    return forget(state) if forgotten else state


def _body(why: Explanation, clue: Clue, lit: str, scale: float) -> tuple[Clue, str]:
    """Everything about a point of a surface."""
    corner = chosen_corner(why, clue)
    number = chosen_light(why.corners[corner], clue)
    told = point_told(why, corner, number)
    clue = _vertices(why, told, corner, clue, scale)
    lit = _side(why, told, corner, number, clue, scale) or lit
    imgui.separator_text("terms")
    for i, light in enumerate(told.lights):
        clue, hit = _light(light, i, told.chosen if i == number else None, clue)
        lit = hit or lit
    rows.line(told.emissive, "emissive")
    if told.total:
        rows.line(told.total, "corner")
    rows.display(why)
    if told.chosen:
        clue = _filter(told.chosen, clue)
        _lobe(why, told.chosen, scale)
    return clue, lit


def _vertices(why: Explanation, told: PointTold, corner: int, clue: Clue, scale: float) -> Clue:
    """The triangle, where the model is evaluated at its vertices or its centre."""
    mode = why.setup.settings.shading
    if mode == Shading.FLAT:
        imgui.text_wrapped("Evaluated once, at the centre of this triangle:")
        triangle_lens.compared(why)
    if mode != Shading.PER_VERTEX or not told.vertices:
        return clue
    imgui.text_wrapped("Evaluated at the three vertices; their colours are mixed:")
    triangle_lens.mixed(why, scale)
    triangle_lens.compared(why)
    for i, (name, vertex) in enumerate(zip(CORNERS, told.vertices, strict=False)):
        rows.swatch(vertex, f"vertex {name}")
        imgui.same_line()
        if imgui.selectable(f"{vertex.text}###corner {name}", i == corner)[0]:
            clue = replace(clue, corner=i)
        imgui.set_item_tooltip("show the vectors of this vertex")
    return clue


def _side(
    why: Explanation, told: PointTold, corner: int, number: int, clue: Clue, scale: float
) -> str:
    """The vectors from the side, and their products."""
    blinn = why.setup.settings.highlight == "blinn"
    where = f" at vertex {CORNERS[corner]}" if len(why.corners) == 3 else ""
    imgui.separator_text(f"from the side{where}")
    hit = side_view.draw(side_view.side(why.corners[corner], number, blinn), clue.lit, scale)
    return (write(told.chosen.products, clue.lit) if told.chosen else "") or hit


def _light(light: LightTold, i: int, chosen: ChosenLight | None, clue: Clue) -> tuple[Clue, str]:
    """One line per term; the formula and its numbers for the chosen light."""
    hit = ""
    rows.swatch(light.total, f"light {i}")
    imgui.same_line()
    if imgui.selectable(f"{light.total.text}###light {i}", chosen is not None)[0]:
        clue = replace(clue, light=i)
    imgui.set_item_tooltip("show the vectors of this light")
    indent = 1.8 * imgui.get_font_size()
    imgui.indent(indent)
    for term in LIT_TERMS:
        rows.line(light.terms[term], f"{term} {i}")
        if chosen:
            symbols, figures = chosen.equations[term]
            hit = write(symbols, clue.lit, indent=indent) or hit
            write(figures, "", faint=True, indent=indent)
    imgui.unindent(indent)
    return clue, hit


def _filter(chosen: ChosenLight, clue: Clue) -> Clue:
    """The component-wise filter of one term as bars."""
    imgui.separator_text("the filter s ⊗ m")
    for term in LIT_TERMS:
        if imgui.radio_button(f"{term}##filter", clue.term == term):
            clue = replace(clue, term=term)
        imgui.same_line()
    imgui.new_line()
    letter = SYMBOLS[clue.term]
    filter_bars.draw(*chosen.filters[clue.term], (f"s_{letter}", f"m_{letter}"))
    return clue


def _lobe(why: Explanation, chosen: ChosenLight, scale: float) -> None:
    """The lobe of the highlight and where the viewer stands in it."""
    axis, eye = "nh" if why.setup.settings.highlight == "blinn" else "rv"
    imgui.separator_text("the lobe of the highlight")
    lobe_plot.draw(why.shininess, chosen.angle, axis, eye, scale)
    write(chosen.lobe, "")
