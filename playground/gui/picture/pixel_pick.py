"""A click into a picture asks why that pixel has its colour; a right click forgets it."""

from __future__ import annotations

from dataclasses import replace

from imgui_bundle import imgui

from playground.gui.picture.comparison import Picture, pictures
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
    io = imgui.get_io()
    over = imgui.is_item_hovered()
    if over and imgui.is_item_deactivated() and tapped(1):
        return forget(state)
    clicked = over and imgui.is_item_deactivated() and tapped(0) and not io.key_shift
    moved = bool(io.mouse_delta.x or io.mouse_delta.y)
    followed = over and io.key_shift and moved and not any(io.mouse_down[i] for i in range(3))
    if not (clicked or followed):
        return state
    dense = io.display_framebuffer_scale
    at = ((io.mouse_pos.x - origin.x) * dense.x, (io.mouse_pos.y - origin.y) * dense.y)
    shown = pictures(state, *size)
    found = place(shown, *at)
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


def place(shown: tuple[Picture, ...], x: float, y: float) -> tuple[int, tuple[float, float]] | None:
    """Which picture is at a place of the view, and where in it as shares of width and height."""
    for number, picture in enumerate(shown):
        left, top, width, height = picture.box
        across, down = (x - left) / width, (y - top) / height
        first, last = picture.part
        if first <= across < last and 0.0 <= down < 1.0:
            return number, (across, down)
    return None


def tapped(button: int) -> bool:
    """Whether the button was let go where it was pressed."""
    moved = imgui.get_mouse_drag_delta(button)  # 0 until the mouse is dragged
    return imgui.is_mouse_released(button) and moved.x == 0.0 and moved.y == 0.0
