"""Why a pixel has its colour: vectors, one line per term and light, sum, clamp, lobe."""

from __future__ import annotations

from dataclasses import replace
from math import acos, degrees

import numpy as np
from imgui_bundle import imgui
from numpy.typing import NDArray

from playground.explain.pixel import Explanation, LightAtPoint, ShadedPoint
from playground.explain.words import CORNERS
from playground.gui import filter_bars, lobe_plot, side_view, triangle_mark
from playground.gui.arrows import vectors
from playground.gui.clue import Clue
from playground.gui.comparison import pictures
from playground.gui.equation import filtered, formula, numbers, triple, write
from playground.gui.explained import chosen_corner, chosen_light, explained
from playground.gui.pixel_pick import forget
from playground.gui.state import State
from playground.gui.widgets import Ui
from playground.scene.settings import TERMS, Shading

Array = NDArray[np.float64]
LIT_TERMS = TERMS[:3]  # those that each light adds
SYMBOLS = {"diffuse": "d", "specular": "s", "ambient": "a"}


def draw(state: State, ui: Ui) -> State:
    """The explanation of the picked pixel, or how to pick one."""
    if state.pixel is None:
        imgui.text_wrapped("Click a point of the picture, or hold Shift and move over it.")
        return state
    shown = pictures(state, *ui.view)
    picture = shown[min(state.clue.picture, len(shown) - 1)]
    why = explained(picture, state.pixel)
    if why is None:
        imgui.text_wrapped("This pixel cannot be explained.")
        return state
    forgotten = _head(why)
    over, clue = imgui.is_window_hovered(), state.clue
    lit = clue.lit if not over else ""
    if why.corners:
        clue, lit = _body(why, clue, lit, ui.scale)
    else:
        imgui.text_wrapped("No surface here: the background.")
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
    clue = _vertices(why, clue, scale)
    corner = why.corners[chosen_corner(why, clue)]
    number = chosen_light(corner, clue)
    lit = _side(why, corner, number, clue, scale) or lit
    imgui.separator_text("terms")
    for i in range(len(corner.lights)):
        clue, hit = _light(why, corner, i, clue)
        lit = hit or lit
    _emissive(why, corner)
    _display(why)
    if number >= 0:
        light = corner.lights[number]
        clue = _filter(why, corner, light, clue)
        _lobe(why, light, scale)
    return clue, lit


def _vertices(why: Explanation, clue: Clue, scale: float) -> Clue:
    """The triangle, where the model is evaluated at its vertices or its centre."""
    mode = why.setup.settings.shading
    if mode == Shading.FLAT:
        imgui.text_wrapped("Evaluated once, at the centre of the triangle.")
    if mode != Shading.PER_VERTEX or len(why.corners) != 3:
        return clue
    imgui.text_wrapped("Evaluated at the three vertices; their colours are mixed:")
    triangle_mark.enlarged(why, scale)
    for i, (name, corner) in enumerate(zip(CORNERS, why.corners, strict=False)):
        _swatch(why, corner.colour, f"vertex {name}")
        imgui.same_line()
        text = f"{name}   {why.weights[i]:.3f} · {triple(corner.colour)}###corner {name}"
        if imgui.selectable(text, i == chosen_corner(why, clue))[0]:
            clue = replace(clue, corner=i)
        imgui.set_item_tooltip("show the vectors of this vertex")
    return clue


def _side(why: Explanation, corner: ShadedPoint, number: int, clue: Clue, scale: float) -> str:
    """The vectors from the side, and their products."""
    blinn = why.setup.settings.highlight == "blinn"
    found = vectors(corner, number, blinn)
    where = f" at vertex {CORNERS[chosen_corner(why, clue)]}" if len(why.corners) == 3 else ""
    imgui.separator_text(f"from the side{where}")
    if number < 0:
        return side_view.draw(found, "nv", None, clue.lit, scale)
    light = corner.lights[number]
    hit = side_view.draw(found, "rv", light.rho, clue.lit, scale)
    parts = ("n", "·", "l", f"= {light.n_dot_l:.3f}   ", "r", "·", "v", f"= {light.r_dot_v:.3f}")
    more: tuple[str, ...] = ("  ", "ρ", f"= {light.rho:.1f}°")
    if blinn:
        more = ("  ", "n", "·", "h", f"= {light.specular_cosine:.3f}", *more)
    return write((*parts, *more), clue.lit) or hit


def _light(why: Explanation, corner: ShadedPoint, i: int, clue: Clue) -> tuple[Clue, str]:
    """One line per term; the formula and its numbers for the chosen light."""
    light, chosen, hit = corner.lights[i], i == chosen_light(corner, clue), ""
    total = light.diffuse + light.specular + light.ambient
    _swatch(why, total, f"light {i}")
    imgui.same_line()
    if imgui.selectable(f"light {i}  {light.kind}   {triple(total)}###light {i}", chosen)[0]:
        clue = replace(clue, light=i)
    imgui.set_item_tooltip("show the vectors of this light")
    indent = 1.8 * imgui.get_font_size()
    imgui.indent(indent)
    for term in LIT_TERMS:
        added = getattr(light, term)
        _swatch(why, added, f"{term} {i}")
        imgui.same_line()
        imgui.text(f"{term}  {triple(added)}")
        if chosen:
            hit = write(formula(term, why), clue.lit, indent=indent) or hit
            write(("=", *numbers(term, why, corner, light)), "", faint=True, indent=indent)
    imgui.unindent(indent)
    return clue, hit


def _emissive(why: Explanation, corner: ShadedPoint) -> None:
    _swatch(why, corner.emissive, "emissive")
    imgui.same_line()
    imgui.text(f"emissive  {triple(corner.emissive)}")
    if len(why.corners) > 1:
        _swatch(why, corner.colour, "corner")
        imgui.same_line()
        imgui.text(f"sum at this vertex  {triple(corner.colour)}")


def _display(why: Explanation) -> None:
    """From the sum to the code on the screen."""
    settings = why.setup.settings
    imgui.separator_text("sum and display")
    _swatch(why, why.colour, "sum")
    imgui.same_line()
    imgui.text(f"colour  {triple(why.colour)}")
    exposed = why.colour * settings.exposure
    steps = [f"× {settings.exposure:g}"] if settings.exposure != 1.0 else []
    over = float(np.max(exposed)) > 1.0
    if over:
        steps.append("cut at 1" if settings.clamp else "wrapped around")
    elif settings.clamp:
        steps.append("clamp: nothing to cut")
    steps += ["sRGB curve"] if settings.curve == "srgb" else []
    imgui.text_disabled("    " + ", ".join(steps or ["as it is"]))
    _swatch(why, why.colour, "shown", large=True)
    imgui.same_line()
    imgui.align_text_to_frame_padding()
    imgui.text(f"shown  {triple(why.shown)}")
    imgui.text_disabled("    8-bit code  " + " ".join(str(int(code)) for code in why.codes))


def _filter(why: Explanation, corner: ShadedPoint, light: LightAtPoint, clue: Clue) -> Clue:
    """The component-wise filter of one term as bars."""
    imgui.separator_text("the filter s ⊗ m")
    for term in LIT_TERMS:
        if imgui.radio_button(f"{term}##filter", clue.term == term):
            clue = replace(clue, term=term)
        imgui.same_line()
    imgui.new_line()
    s, m = filtered(clue.term, why, corner, light)
    letter = SYMBOLS[clue.term]
    filter_bars.draw(s, m, (f"s_{letter}", f"m_{letter}"))
    return clue


def _lobe(why: Explanation, light: LightAtPoint, scale: float) -> None:
    """The lobe of the highlight and where the viewer stands in it."""
    blinn = why.setup.settings.highlight == "blinn"
    cosine = float(np.clip(light.specular_cosine, -1.0, 1.0))
    angle = degrees(acos(cosine))
    imgui.separator_text("the lobe of the highlight")
    axis, eye = "nh" if blinn else "rv"
    lobe_plot.draw(why.shininess, angle, axis, eye, scale)
    factor = max(cosine, 0.0) ** why.shininess
    name = "∠ n h" if blinn else "∠ r v"
    power = f"cos^{why.shininess:g}"
    write((f"{name} = {angle:.1f}° ", f"cos = {cosine:.3f} ", f"{power} = {factor:.3g}"), "")


def _swatch(why: Explanation, colour: Array, name: str, large: bool = False) -> None:
    """A linear colour as the display shows it; its tooltip says where it was cut."""
    red, green, blue = (c / 255.0 for c in triangle_mark.shown_colour(why, colour))
    flags = imgui.ColorEditFlags_
    plain = flags.no_tooltip.value | flags.no_drag_drop.value
    side = imgui.get_frame_height() if large else imgui.get_text_line_height()
    size = imgui.ImVec2((2.0 if large else 1.4) * side, side)
    imgui.color_button(f"##{name}", (red, green, blue, 1.0), plain, size)
