"""One thing that can be done: its name, its keys, its menu. All of them are in `shortcuts`."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from imgui_bundle import imgui

from playground.gui.state import State


@dataclass(frozen=True)
class Action:
    """One thing that can be done.

    ``chords`` are ImGui key chords, all of which are written in ``keys``.
    ``repeats`` says that holding the key repeats it. ``on`` says whether what the action
    switches is on: the menu shows a tick then.
    """

    menu: str
    name: str
    keys: str
    chords: tuple[int, ...]
    do: Callable[[State], State]
    repeats: bool = False
    on: Callable[[State], bool] | None = None


def key(name: str, modifiers: int = 0) -> int:
    """The chord of a key by its name in ImGui, with modifiers."""
    return int(getattr(imgui.Key, name).value) | modifiers
