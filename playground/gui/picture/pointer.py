"""The mouse over the pictures of the view: what it points at, and whether it taps there."""

from __future__ import annotations

from imgui_bundle import imgui

from playground.gui.picture.comparison import Picture

Place = tuple[int, tuple[float, float]]  # number of a picture; shares of its width and height


def pointed(shown: tuple[Picture, ...], origin: imgui.ImVec2) -> Place | None:
    """Which picture is under the mouse, and where in it; ``origin`` is the view's upper left."""
    io = imgui.get_io()
    mouse, dense = io.mouse_pos, io.display_framebuffer_scale
    return place(shown, (mouse.x - origin.x) * dense.x, (mouse.y - origin.y) * dense.y)


def place(shown: tuple[Picture, ...], x: float, y: float) -> Place | None:
    """Which picture is at a pixel of the view, and where in it."""
    for number, picture in enumerate(shown):
        left, top, width, height = picture.box
        across, down = (x - left) / width, (y - top) / height
        first, last = picture.part
        if first <= across < last and 0.0 <= down < 1.0:
            return number, (across, down)
    return None


def tapped(button: int) -> bool:
    """Whether the last item, the view, was clicked: the button let go where it was pressed."""
    if not (imgui.is_item_hovered() and imgui.is_item_deactivated()):
        return False
    moved = imgui.get_mouse_drag_delta(button)  # 0 until the mouse is dragged
    return imgui.is_mouse_released(button) and moved.x == 0.0 and moved.y == 0.0


def moving() -> bool:
    """Whether the mouse is somewhere else than in the last frame."""
    delta = imgui.get_io().mouse_delta
    return bool(delta.x or delta.y)


def pressing() -> bool:
    """Whether a button is down."""
    return any(imgui.get_io().mouse_down[i] for i in range(3))
