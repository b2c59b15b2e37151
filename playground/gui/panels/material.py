"""What one object does with light: its colours, its shininess, its texture."""

from __future__ import annotations

from dataclasses import replace

from imgui_bundle import imgui

from playground.gui.state import State
from playground.gui.widgets import LABELS, Ui, attempt, edit, label
from playground.scene.material import Material
from playground.scene.presets import PRESETS, look, preset, preset_of
from playground.scene.scene import Object

COLOURS = ("diffuse", "specular", "ambient", "emissive")
TRACED = ("reflectance", "transmittance", "index", "absorption", "priority")
SHININESS = (5, 10, 20, 80)  # the four pictures of the lecture


def draw(state: State, ui: Ui) -> State:
    """The material of the chosen object."""
    state = pick_object(state)
    objects = state.setup.scene.objects
    if not objects:
        imgui.text_disabled("this setup has no object")
        return state
    item = objects[state.chosen]
    material = _preset(item.material)
    material = edit(ui, material, only=(*COLOURS, "shininess"))
    material = _four_exponents(material, ui)
    material = edit(ui, material, only=("texture",))
    if material.texture:
        material = edit(ui, material, only=("texture_encoding",))
    imgui.separator_text("mirror and glass, by ray tracing")
    material = edit(ui, material, only=TRACED)
    if material is item.material:
        return state
    return with_object(state, replace(item, material=material), item)


def pick_object(state: State) -> State:
    """A row of choices where there are several objects."""
    objects = state.setup.scene.objects
    chosen = min(state.chosen, len(objects) - 1)
    if len(objects) > 1:
        names = [f"{i}  {item.mesh.rsplit('/', 1)[-1]}" for i, item in enumerate(objects)]
        imgui.align_text_to_frame_padding()
        imgui.text("object")
        imgui.same_line(LABELS * imgui.get_font_size())
        imgui.set_next_item_width(-1)
        _, chosen = imgui.combo("##object", chosen, names)
    return replace(state, chosen=max(chosen, 0)) if chosen != state.chosen else state


def with_object(state: State, item: Object, before: Object) -> State:
    """The state in which the chosen object is ``item``; the same one if nothing changed."""
    if item == before:
        return state
    objects = list(state.setup.scene.objects)
    objects[state.chosen] = item
    return state.with_setup(state.setup.with_(objects=tuple(objects)))


def _preset(material: Material) -> Material:
    """A list of well known materials; the present one stands in it if it is one of them."""
    label("preset")
    imgui.same_line(LABELS * imgui.get_font_size())
    imgui.set_next_item_width(-1)
    now = preset_of(material)
    if imgui.begin_combo("##preset", now or "choose..."):
        for name in PRESETS:
            red, green, blue = look(preset(name))
            size = imgui.get_font_size()
            imgui.color_button(f"##{name}", (red, green, blue, 1.0), 0, imgui.ImVec2(size, size))
            imgui.same_line()
            if imgui.selectable(name, name == now)[0]:
                material = preset(name, material)
        imgui.end_combo()
    imgui.set_item_tooltip("the teapots of the OpenGL guide (1994), and materials for ray tracing")
    return material


def _four_exponents(material: Material, ui: Ui) -> Material:
    imgui.dummy(imgui.ImVec2(0, 0))
    imgui.same_line(LABELS * imgui.get_font_size())
    for i, exponent in enumerate(SHININESS):
        if i:
            imgui.same_line()
        if imgui.button(f"{exponent}##sh"):
            material = attempt(ui, material, "shininess", float(exponent))
        imgui.set_item_tooltip(f"shininess {exponent}, as in the lecture")
    return material
