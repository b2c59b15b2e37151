"""Why a pixel has its colour: vectors, one line per term and light, sum, clamp, lobe."""

from __future__ import annotations

from dataclasses import replace

from imgui_bundle import imgui

from playground.explain.pixel import Explanation
from playground.explain.words import CORNERS
from playground.gui.picture.comparison import pictures
from playground.gui.picture.pixel_pick import forget
from playground.gui.picture.stand import viewed
from playground.gui.pixel import filter_bars, lobe_plot, side_view, triangle_mark
from playground.gui.pixel.clue import Clue
from playground.gui.pixel.equation import write
from playground.gui.pixel.explained import chosen_corner, chosen_light, explained
from playground.gui.pixel.telling import (
    LIT_TERMS,
    ChosenLight,
    LightTold,
    Line,
    PointTold,
    display_told,
    point_told,
)
from playground.gui.rays import ray_tree_panel
from playground.gui.state import State
from playground.gui.widgets import Ui
from playground.scene.settings import Shading

SYMBOLS = {"diffuse": "d", "specular": "s", "ambient": "a"}
PLAIN = imgui.ColorEditFlags_.no_tooltip.value | imgui.ColorEditFlags_.no_drag_drop.value


def draw(state: State, ui: Ui) -> State:
    """The explanation of the picked pixel, or how to pick one."""
    if state.pixel is None:
        imgui.text_wrapped("Click a point of the picture, or hold Shift and move over it.")
        return state
    shown = pictures(state, *ui.view)
    picture = shown[min(state.clue.picture, len(shown) - 1)]
    if picture.traced:
        return ray_tree_panel.draw(state, viewed(state, picture), ui)
    why = explained(viewed(state, picture), state.pixel)
    if why is None:
        imgui.text_wrapped("This pixel cannot be explained.")
        return state
    forgotten = _head(why)
    over, clue = imgui.is_window_hovered(), state.clue
    lit = clue.lit if not over else ""
    if why.corners:
        clue, lit = _body(why, clue, lit, ui.scale)
    else:
        itself = f"Light {why.light} itself: the colour it emits, s_d; its back is dark."
        nothing = "No surface here: the background."
        imgui.text_wrapped(nothing if why.light is None else itself)
        _display(why)
    clue = clue if clue.lit == lit else replace(clue, lit=lit)
    state = state if clue is state.clue else replace(state, clue=clue)
    return forget(state) if forgotten else state


def _head(why: Explanation) -> bool:
    """What is explained; returns whether it shall be forgotten."""
    x, y = why.pixel
    imgui.align_text_to_frame_padding()
    imgui.text(f"pixel ({x}, {y}), {why.setup.settings.shading}")
    imgui.set_item_tooltip(f"of {why.size[0]} × {why.size[1]}; computed in float64")
    imgui.same_line()
    wide = imgui.calc_text_size("×").x + 2 * imgui.get_style().frame_padding.x
    spare = imgui.get_content_region_avail().x - wide
    imgui.set_cursor_pos_x(imgui.get_cursor_pos_x() + max(spare, 0.0))
    forgotten = bool(imgui.button("×##forget"))
    imgui.set_item_tooltip("forget the pixel (Esc, or right click into the picture)")
    if why.setup.settings.bugs:
        imgui.text_wrapped("The picture makes mistakes on purpose; this is the right colour.")
    return forgotten


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
    _line(told.emissive, "emissive")
    if told.total:
        _line(told.total, "corner")
    _display(why)
    if told.chosen:
        clue = _filter(told.chosen, clue)
        _lobe(why, told.chosen, scale)
    return clue, lit


def _vertices(why: Explanation, told: PointTold, corner: int, clue: Clue, scale: float) -> Clue:
    """The triangle, where the model is evaluated at its vertices or its centre."""
    mode = why.setup.settings.shading
    if mode == Shading.FLAT:
        imgui.text_wrapped("Evaluated once, at the centre of the triangle.")
    if mode != Shading.PER_VERTEX or not told.vertices:
        return clue
    imgui.text_wrapped("Evaluated at the three vertices; their colours are mixed:")
    triangle_mark.enlarged(why, scale)
    for i, (name, vertex) in enumerate(zip(CORNERS, told.vertices, strict=False)):
        _swatch(vertex, f"vertex {name}")
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
    _swatch(light.total, f"light {i}")
    imgui.same_line()
    if imgui.selectable(f"{light.total.text}###light {i}", chosen is not None)[0]:
        clue = replace(clue, light=i)
    imgui.set_item_tooltip("show the vectors of this light")
    indent = 1.8 * imgui.get_font_size()
    imgui.indent(indent)
    for term in LIT_TERMS:
        _line(light.terms[term], f"{term} {i}")
        if chosen:
            symbols, figures = chosen.equations[term]
            hit = write(symbols, clue.lit, indent=indent) or hit
            write(figures, "", faint=True, indent=indent)
    imgui.unindent(indent)
    return clue, hit


def _display(why: Explanation) -> None:
    """From the sum to the code on the screen."""
    told = display_told(why)
    imgui.separator_text("sum and display")
    _line(told.colour, "sum")
    imgui.text_disabled(told.steps)
    _swatch(told.shown, "shown", large=True)
    imgui.same_line()
    imgui.align_text_to_frame_padding()
    imgui.text(told.shown.text)
    imgui.text_disabled(told.codes)


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


def _line(line: Line, name: str) -> None:
    """The words of a line behind its colour."""
    _swatch(line, name)
    imgui.same_line()
    imgui.text(line.text)


def _swatch(line: Line, name: str, large: bool = False) -> None:
    """The colour of a line."""
    side = imgui.get_frame_height() if large else imgui.get_text_line_height()
    size = imgui.ImVec2((2.0 if large else 1.4) * side, side)
    imgui.color_button(f"##{name}", line.colour, PLAIN, size)
