"""A click into a picture asks why that pixel has its colour; a right click forgets it."""

from __future__ import annotations

from dataclasses import replace

from imgui_bundle import imgui

from playground.gui.picture.comparison import pictures
from playground.gui.picture.pointer import moving, pointed, pressing, tapped
from playground.gui.state import State

PANEL = "Explain"


def picked(state: State, origin: imgui.ImVec2, size: tuple[int, int]) -> State:
    """What clicks and Shift-hovering over the last item, the view, pick or forget.

    Parameters
    ----------
    state : State
    origin : ImVec2
        Upper left corner of the view.
    size : tuple of int
        Of the view, in pixels of the framebuffer.
    """
    if tapped(1):
        return forget(state)
    shift = imgui.get_io().key_shift
    clicked = tapped(0) and not shift
    followed = shift and imgui.is_item_hovered() and moving() and not pressing()
    if not (clicked or followed):
        return state
    shown = pictures(state, *size)
    found = pointed(shown, origin)
    if found is None:
        return state
    number, share = found
    seen = (state.layout, shown[number].box[2:])
    clue = replace(state.clue, picture=number, corner=None, seen=seen)
    state = replace(state, pixel=share, clue=clue)
    return replace(state, unfold=PANEL) if clicked else state


def forget(state: State) -> State:
    """No pixel is explained any more."""
    return state if state.pixel is None else state.unpicked()
