"""From light to the screen, and how the window looks."""

from __future__ import annotations

from dataclasses import replace

from imgui_bundle import imgui

from playground.gui.state import State
from playground.gui.widgets import Ui, edit


def draw(state: State, ui: Ui) -> State:
    """The steps of the display, then the window itself."""
    steps = ("exposure", "clamp", "curve", "samples")
    settings = edit(ui, state.setup.settings, only=steps)
    if settings is not state.setup.settings:
        state = state.with_setup(replace(state.setup, settings=settings))
    imgui.separator()
    return edit(ui, state, only=("theme", "text_size"))
