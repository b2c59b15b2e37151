"""Save as: a name for the setup, with the folder it goes to."""

from __future__ import annotations

from dataclasses import replace
from os.path import exists, expanduser
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
    if entered:
        imgui.set_keyboard_focus_here(-1)  # where it fails, one can go on typing
    state = replace(state, typed=typed)
    imgui.same_line()
    if imgui.button("Save", imgui.ImVec2(-1, 0)) or entered:
        return save_as(state, target(state.typed))
    path = target(state.typed)
    if exists(path):  # unlike Path.exists, no error for a name that is too long
        imgui.text(f"{path} is there already and will be replaced")
    else:
        imgui.text_disabled(f"{path.absolute()}")
    return state


def target(typed: str) -> Path:
    """The file that is meant: .toml unless another ending stands there, and setup.toml if no name.

    Every text is a file's name to it, as somebody is still typing: "", "/" and "~nobody" too.
    """
    path = Path(expanduser(typed))  # unlike Path.expanduser, no error where there is no such user
    if typed.endswith("/") or path.name == "..":
        return path / "setup.toml"
    if path.suffix:
        return path
    return path.with_name(f"{path.name}.toml") if path.name else path / "setup.toml"
