"""The switches of what is laid over the pictures."""

from __future__ import annotations

from dataclasses import replace

from imgui_bundle import imgui

from playground.gui.picture.overlay_knobs import Overlays
from playground.gui.state import State
from playground.gui.widgets import fits, tooltip
from playground.scene.knob import knobs


def overlay_switches(state: State) -> State:
    """One switch after the other, as many in a row as fit."""
    imgui.separator_text("over the picture")
    for i, (name, knob) in enumerate(knobs(Overlays).items()):
        words, on = name.replace("_", " "), getattr(state.overlays, name)
        if i:
            imgui.same_line()
            if not fits([words]):
                imgui.new_line()
        now = imgui.checkbox(words, on)[1]
        tooltip(knob)
        if now != on:
            state = replace(state, overlays=replace(state.overlays, **{name: now}))
    return state
