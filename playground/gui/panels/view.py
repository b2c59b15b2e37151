"""Which shading, and which pictures beside each other."""

from __future__ import annotations

from dataclasses import replace
from typing import TypeVar

from imgui_bundle import imgui

from playground.gui.actions import frame_objects, kept_apart, play, reset
from playground.gui.panels.overlays import overlay_switches
from playground.gui.shortcuts import keys_of
from playground.gui.state import CHOSEN, METHODS, PAIRED, RASTER, TRACED, State
from playground.gui.widgets import Ui, attempt, bare, edit, fits, tooltip
from playground.scene.knob import knobs
from playground.scene.scene import Scene
from playground.scene.settings import Shading

Item = TypeVar("Item")
TRACING = "Ray tracing, or back"
METHOD_KEYS = (TRACING, "Radiosity, or back", "Lightmap, or back")
SHADING_KEYS = "\n".join(f"{mode}: {keys_of(mode)}" for mode in Shading)


def draw(state: State, ui: Ui) -> State:
    """Shading mode, layout of the pictures, camera."""
    before = state
    state = _methods(state)
    _keys("\n".join(f"{name}: {keys_of(name)}" for name in METHOD_KEYS))
    imgui.begin_group()
    settings = _row(state.setup.settings, "shading", ui)
    imgui.end_group()
    _keys(SHADING_KEYS)
    if settings is not state.setup.settings:  # who chooses a shading wants to see it
        state = replace(state, method=RASTER, first=CHOSEN)
        state = state.with_setup(replace(state.setup, settings=settings))
    if state.method == RASTER and state.other != TRACED and _hidden(state.setup.scene):
        imgui.text_wrapped(f"Mirrors and glass show by ray tracing ({keys_of(TRACING)}).")
    state = _row(state, "layout", ui)
    if state.layout in PAIRED:
        state = edit(ui, state, only=("first", "other"))
    state = kept_apart(before, state)
    if imgui.button("Frame"):
        state = frame_objects(state)
    imgui.set_item_tooltip("move the camera until every object is in view (F)")
    imgui.same_line()
    if imgui.button("Stop orbit###orbit" if state.playing else "Orbit###orbit"):
        state = play(state)
    imgui.set_item_tooltip("the camera walks around the target (Space)")
    imgui.same_line()
    if imgui.button("Reset"):
        state = reset(state)
    imgui.set_item_tooltip("back to the setup as it was loaded (R)")
    return overlay_switches(state)


def _methods(state: State) -> State:
    """A button for each method, as many in a row as fit."""
    imgui.begin_group()
    for i, method in enumerate(METHODS):
        if i:
            imgui.same_line()
            if not fits([method]):
                imgui.new_line()
        if imgui.radio_button(f"{method}##method", method == state.method):
            state = replace(state, method=method, first=CHOSEN)
        tooltip(knobs(State)["method"])
    imgui.end_group()
    return state


def _hidden(scene: Scene) -> bool:
    """Whether something is a mirror or glass."""
    materials = (item.material for item in scene.objects)
    return any(any((*m.reflectance, *m.transmittance)) for m in materials)


def _keys(words: str) -> None:
    """The keys of the last item, below what its tooltip says."""
    if imgui.is_item_hovered(imgui.HoveredFlags_.for_tooltip) and imgui.begin_tooltip():
        imgui.text_disabled(words)
        imgui.end_tooltip()


def _row(item: Item, name: str, ui: Ui) -> Item:
    """A choice over the whole width, without a label: its words say what it is."""
    imgui.set_next_item_width(-1)
    return attempt(ui, item, name, bare(knobs(type(item))[name], name, getattr(item, name)))
