"""Every light of the scene: its type and knobs; add, remove, solo."""

from __future__ import annotations

from dataclasses import replace

from imgui_bundle import imgui

from playground.gui.picture.gizmos import tint
from playground.gui.picture.light_change import added, converted, exchanged, removed
from playground.gui.state import State
from playground.gui.widgets import Ui, edit, row
from playground.scene.knob import Knob, knobs
from playground.scene.light import LIGHTS, Light

TYPE = Knob("choice", "directional", choices=tuple(LIGHTS), help="where the light comes from")
PLAIN = imgui.ColorEditFlags_.no_tooltip.value | imgui.ColorEditFlags_.no_drag_drop.value
OVERLAP = imgui.TreeNodeFlags_.allow_overlap.value | imgui.TreeNodeFlags_.framed.value
FADING = ("constant", "linear", "quadratic")


def draw(state: State, ui: Ui) -> State:
    """One section per light and a button for a new one."""
    for i, light in enumerate(state.setup.scene.lights):
        imgui.push_id(i)
        state, gone = _light(state, i, light, ui)
        imgui.pop_id()
        if gone:
            break
    if imgui.button("Add a light"):
        state = state.with_setup(added(state.setup)).say("added a point light")
    imgui.set_item_tooltip("a point light over the viewer's right shoulder")
    return state


def _light(state: State, i: int, light: Light, ui: Ui) -> tuple[State, bool]:
    """One light: a line with its colour, solo and remove, and its knobs when unfolded."""
    imgui.color_button("##swatch", (*tint(light), 1.0), PLAIN)
    imgui.set_item_tooltip("the hue of its light; how bright it is, s_d says")
    imgui.same_line()
    unfolded = imgui.tree_node_ex(f"{i}  {light.kind}###light", OVERLAP)
    wide = imgui.calc_text_size("solo").x + imgui.calc_text_size("×").x
    padding = imgui.get_style().frame_padding.x
    end = imgui.get_window_width() - imgui.get_style().window_padding.x
    imgui.same_line(end - wide - 8 * padding)
    alone = state.solo == i
    if imgui.radio_button("solo", alone):
        state = replace(state, solo=None if alone else i)
    imgui.set_item_tooltip("this light alone; click again for all")
    imgui.same_line()
    gone = imgui.small_button("×")
    imgui.set_item_tooltip("remove this light")
    if unfolded:
        changed = _knobs(state, light, ui)
        if changed is not light:
            state = state.with_setup(exchanged(state.setup, i, changed))
        imgui.tree_pop()
    if gone:
        state = replace(state.with_setup(removed(state.setup, i)), solo=None)
    return state, gone


def _knobs(state: State, light: Light, ui: Ui) -> Light:
    light = converted(light, row(TYPE, "type", light.kind), state.setup)
    hidden = () if getattr(light, "attenuate", False) else FADING
    first = [n for n in knobs(type(light)) if n not in ("diffuse", "specular", "ambient", *hidden)]
    light = edit(ui, light, only=("diffuse", "specular", "ambient"))
    return edit(ui, light, only=first)
