"""The main loop: draws while something happens, sleeps while nothing does."""

from __future__ import annotations

from time import perf_counter
from typing import TYPE_CHECKING, Any

from imgui_bundle import imgui  # before glfw, see app.py

from playground.gui.measuring import under_way

if TYPE_CHECKING:
    from playground.gui.app import LightingWindow

AWAKE = 0.7  # seconds of drawing after the last event: tooltips appear, menus settle
LEAST = 4  # frames of it, however long they take: a menu has its size in its second
SHARE = 0.85  # of the screen that the window takes, if that is enough
GLANCE = 0.05  # seconds between two looks at whether the reference picture is ready
NAP = 0.5  # seconds between two looks around while asleep: the caret of a text field blinks


def loop(window: LightingWindow) -> None:
    """Run ``window`` until it is closed."""
    _accept_drops(window)
    _fit(window)
    window.timer.start()
    until, frames = perf_counter() + AWAKE, 0
    while not window.wnd.is_closing:
        now, delta = window.timer.next_frame()
        window.wnd.use()
        window.wnd.render(now, delta)
        window.wnd.swap_buffers()
        window.ui.after_swap()
        frames += 1
        idle = frames >= LEAST and perf_counter() > until
        if busy(window) or (idle and _slept(window)):
            until, frames = perf_counter() + AWAKE, 0


def busy(window: LightingWindow) -> bool:
    """Whether the next frame will differ: an event has arrived, or the camera walks."""
    state = window.state
    moving = state.playing or state.reading is not None or under_way(state)
    rays = state.pixel is not None and (state.rays.playing or state.rays.lit >= 0)
    moving = moving or rays or window.slots.refining or window.lesson.coming
    return moving or bool(window.dropped) or _events_waiting()


def _events_waiting() -> bool:
    return len(imgui.get_current_context().input_events_queue) > 0


def _slept(window: LightingWindow) -> bool:
    """Wait for the next event; false where only time has passed and a caret must blink."""
    import glfw  # type: ignore[import-not-found, unused-ignore]

    if window.slots.coming:
        glfw.wait_events_timeout(GLANCE)
        return False
    while not window.wnd.is_closing:
        began = perf_counter()
        glfw.wait_events_timeout(NAP)
        if perf_counter() - began < 0.98 * NAP:
            return True
        if window.ui.io.want_text_input or window.watch.due():
            return False
    return True


def _fit(window: Any) -> None:
    """Let the window fill most of the screen, and never more than all of it."""
    import glfw

    x, y, wide, high = glfw.get_monitor_workarea(glfw.get_primary_monitor())
    least = window.window_size
    width = min(max(round(SHARE * wide), least[0]), wide)
    height = min(max(round(SHARE * high), least[1]), high)
    if window.wanted_size:
        width, height = min(window.wanted_size[0], wide), min(window.wanted_size[1], high)
    glfw.set_window_size(window.wnd._window, width, height)
    glfw.set_window_pos(window.wnd._window, x + (wide - width) // 2, y + (high - height) // 2)
    glfw.poll_events()


def _accept_drops(window: Any) -> None:
    # moderngl-window's glfw backend declares this event and never asks for it.
    import glfw

    def dropped(_: Any, paths: list[str]) -> None:
        window.on_files_dropped_event(0, 0, paths)

    glfw.set_drop_callback(window.wnd._window, dropped)  # type: ignore[arg-type, unused-ignore]
