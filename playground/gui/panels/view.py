"""Which shading, and which pictures beside each other."""

from __future__ import annotations

from dataclasses import replace
from typing import TypeVar

from imgui_bundle import imgui

from playground.gui.actions import frame_objects, kept_apart, play, reset
from playground.gui.panels.overlays import overlay_switches
from playground.gui.state import State
from playground.gui.widgets import Ui, attempt, bare, edit
from playground.scene.knob import knobs

Item = TypeVar("Item")


def draw(state: State, ui: Ui) -> State:
    """Shading mode, layout of the pictures, camera."""
    before = state
    settings = _row(state.setup.settings, "shading", ui)
    if settings is not state.setup.settings:
        state = state.with_setup(replace(state.setup, settings=settings))
    state = _row(state, "layout", ui)
    if state.layout in ("side by side", "wipe", "difference"):
        state = edit(ui, state, only=("other",))
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


def _row(item: Item, name: str, ui: Ui) -> Item:
    """A choice over the whole width, without a label: its words say what it is."""
    imgui.set_next_item_width(-1)
    return attempt(ui, item, name, bare(knobs(type(item))[name], name, getattr(item, name)))
