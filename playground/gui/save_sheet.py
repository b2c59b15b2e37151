"""Save as: a name for the setup, with the folder it goes to."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from imgui_bundle import imgui

from playground.gui.actions import save_as
from playground.gui.state import State


def draw(state: State) -> State:
    """A field for the path; Enter saves."""
    if imgui.is_window_appearing():
        imgui.set_keyboard_focus_here()
    imgui.set_next_item_width(-6 * imgui.get_font_size())
    flags = imgui.InputTextFlags_.enter_returns_true.value
    entered, typed = imgui.input_text("##path", state.typed, flags)
    state = replace(state, typed=typed)
    imgui.same_line()
    if imgui.button("Save", imgui.ImVec2(-1, 0)) or entered:
        return save_as(state, target(state.typed))
    path = target(state.typed)
    if path.exists():
        imgui.text(f"{path} is there already and will be replaced")
    else:
        imgui.text_disabled(f"{path.absolute()}")
    return state


def target(typed: str) -> Path:
    """The file that is meant: .toml unless another ending stands there."""
    path = Path(typed).expanduser()
    return path if path.suffix else path.with_name(f"{path.name or 'setup'}.toml")
