"""Presentation mode: large type, nothing but the picture, a black or white background.

And the two layouts: beginners see fewer panels.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from playground.gui.state import State

LARGE = 1.6  # text size
ORDER = ("off", "black", "white")
BACKGROUNDS = {"black": (0.0, 0.0, 0.0), "white": (1.0, 1.0, 1.0)}
Rgb = tuple[float, float, float]
FOR_BEGINNERS = ("Explain", "View", "Terms", "Material", "Lights")


def presenting(state: State) -> bool:
    """Whether menu and status line are hidden."""
    return state.presentation != "off"


def next_presentation(state: State) -> State:
    """From the window to black, to white, and back to the window as it was."""
    following = ORDER[(ORDER.index(state.presentation) + 1) % len(ORDER)]
    if following == "off":
        return ended(state)
    kept = state.kept
    if not presenting(state):
        kept = (state.panel, state.theme, state.text_size, state.shaders)
        state = replace(state, panel=False, text_size=max(LARGE, state.text_size), shaders=False)
    theme = "light" if following == "white" else "dark"
    return replace(state, presentation=following, theme=theme, kept=kept)


def ended(state: State) -> State:
    """The window as it was before the presentation."""
    if not presenting(state) or state.kept is None:
        return state
    panel, theme, text_size, shaders = state.kept
    state = replace(state, presentation="off", kept=None)
    return replace(state, panel=panel, theme=theme, text_size=text_size, shaders=shaders)


def backdrop(state: State) -> Rgb | None:
    """The background of every picture while presenting."""
    return BACKGROUNDS.get(state.presentation)


def next_level(state: State) -> State:
    """From the full layout to the one for beginners, or back."""
    level = "beginner" if state.level == "full" else "full"
    return replace(state, level=level, panel=True).say(f"{level} layout")


def shows(state: State, panel: str) -> bool:
    """Whether the layout has this panel."""
    return state.level == "full" or panel in FOR_BEGINNERS
