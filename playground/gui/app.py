"""The window itself: moderngl-window holds it, `frame.draw` fills it."""

from __future__ import annotations

import traceback
from dataclasses import replace
from pathlib import Path
from time import perf_counter
from typing import Any

import moderngl_window
import numpy as np
from imgui_bundle import imgui  # before glfw: it brings the glfw library that both then use
from numpy.typing import NDArray

from playground.errors import PlaygroundError
from playground.files import write_whole
from playground.gui import frame, memory
from playground.gui.actions import fresh, open_setup
from playground.gui.command_line import copied
from playground.gui.lesson.lesson_course import open_lesson
from playground.gui.lesson.lesson_run import LessonRun
from playground.gui.lightmap.bake_run import BakeRun
from playground.gui.measuring import Measuring
from playground.gui.picture.comparison import Box
from playground.gui.reading_run import ReadingRun
from playground.gui.run_loop import loop
from playground.gui.scene_view import Slots
from playground.gui.shader.shader_edit import Watch, reloaded
from playground.gui.state import State, shown, start
from playground.gui.status import GAP
from playground.gui.ui_loop import UiLoop
from playground.gui.widget import theme
from playground.render.gl.driver import software
from playground.render.image_file import png_bytes
from playground.scene.setup import Setup

SAMPLES = 4  # per pixel, on a GPU
SMOOTH = 0.9  # of the old value stays in the running mean of the time per frame


class NoWindowError(RuntimeError):
    """The system refuses a window or a GL context for it."""


class LightingWindow(moderngl_window.WindowConfig):  # type: ignore[misc]
    """The glue between moderngl-window, Dear ImGui and the state."""

    gl_version = (3, 3)
    title = "Lighting Playground"
    window_size = (1280, 720)
    aspect_ratio = None
    resizable = True
    clear_color = None
    log_level = 40  # errors only
    test_engine = False
    wanted_size: tuple[int, int] | None = None  # that of the last window

    def __init__(self, **more: Any) -> None:
        super().__init__(**more)
        self.wnd.exit_key = None  # Esc closes sheets, never the window
        self.wnd.fullscreen_key = None  # F11 is one of our own keys, in the menu and on the sheet
        self.ui = UiLoop(self.wnd, self.test_engine)
        self.slots = Slots(self.ctx)
        self.measuring = Measuring(self.ctx)
        self.reading = ReadingRun()
        self.lesson = LessonRun(self.slots.lesson)
        self.baking = BakeRun()
        self.hand = frame.Hand()
        self.state = State()
        self.dropped: list[str] = []
        self.watch = Watch()
        self._told = ""
        self.milliseconds = 0.0  # of Python and GL per frame, a running mean

    def show(self, setup: Setup) -> None:
        """Begin with ``setup``, with smooth edges where a GPU makes them cheap."""
        self.state = start(setup, 1 if software(self.ctx) else SAMPLES)

    def on_render(self, time: float, frame_time: float) -> None:
        """Draw one frame and do what the state wishes."""
        began = perf_counter()
        state = self.state
        while self.dropped:
            opened = open_setup(state, self.dropped.pop(0))
            state = frame.remembered(state, opened, False)
        read = self.reading.advance(state)
        state = read if read.setup is state.setup else frame.remembered(state, read, False)
        taught = self.lesson.advance(state)
        state = taught if taught.setup is state.setup else frame.remembered(state, taught, False)
        baked = self.baking.advance(state)
        state = baked if baked.setup is state.setup else frame.remembered(state, baked, False)
        files = self.watch.changed()
        state = reloaded(state, files) if files else state
        self.ui.begin(frame_time)
        state = self._drawn(state, frame_time)
        state = self.measuring.advance(state, self.slots.milliseconds, self.milliseconds)
        self._present(state)
        self.state = self._granted(state)
        title = f"{self.state.setup.name} - {self.title}"
        if self.wnd.title != title:
            self.wnd.title = title
        took = 1e3 * (perf_counter() - began)
        self.milliseconds += (1.0 - SMOOTH if self.milliseconds else 1.0) * (
            took - self.milliseconds
        )

    def on_files_dropped_event(self, x: int, y: int, paths: list[str]) -> None:
        """Remember files that were dropped on the window until the next frame."""
        self.dropped += [str(path) for path in paths]

    def release(self) -> None:
        """Free everything while the context is still there."""
        self.measuring.close()
        self.reading.close()
        self.lesson.close()
        self.baking.close()
        self.slots.close()
        self.ui.close()

    def _drawn(self, state: State, seconds: float) -> State:
        """The interface; a bug of ours is told in the status line and does not end a lecture."""
        density, numbers = self.ui.density, self._numbers()
        try:
            return frame.draw(state, self.slots, self.hand, seconds, density, numbers)
        except Exception as error:
            if repr(error) != self._told:  # once, not at every frame
                traceback.print_exc()
                self._told = repr(error)
            return self.state.fail(f"this is a bug of ours, nothing was changed: {error!r}")

    def _numbers(self) -> str:
        """What the status line says of renderer and times."""
        name = self.ctx.info["GL_RENDERER"].split(" (")[0]
        drawn, whole = self.slots.milliseconds, self.milliseconds
        return GAP.join((name, f"drawn in {drawn:.1f} ms", f"{whole:.1f} ms a frame"))

    def _present(self, state: State) -> None:
        """Bring the frame to the window's own framebuffer."""
        self.slots.restore()
        self.wnd.use()
        self.wnd.fbo.color_mask = (True, True, True, True)
        self.ctx.clear(*theme.PALETTES[state.theme].paper)
        self.ui.end()

    def _granted(self, state: State) -> State:
        """Do what only the window can do."""
        wish = state.wish
        if not wish:
            return state
        state = replace(state, wish="")
        if wish == "quit":
            self.wnd.close()
            return state
        if wish == "full screen":
            self.wnd.fullscreen = not self.wnd.fullscreen
            return state
        if wish == "command":
            state, words = copied(state)
            if words:
                imgui.set_clipboard_text(words)
            return state
        path = fresh(Path(f"{state.setup.name}.png"))
        try:
            codes = self.pixels(self.view_box())
            write_whole(path, png_bytes(codes, shown(state), folder=path.parent))
        except PlaygroundError as error:
            return state.fail(error)
        return state.say(f"saved {path}; it carries its setup: drop it here to come back")

    def view_box(self) -> Box:
        """Where the view is, in pixels of the framebuffer from its upper left corner."""
        scale = self.state.text_size * self.ui.density
        dense = imgui.get_io().display_framebuffer_scale
        x, y, width, height = frame.areas(self.state, scale)[0]
        return (
            round(x * dense.x),
            round(y * dense.y),
            round(width * dense.x),
            round(height * dense.y),
        )

    def pixels(self, box: Box | None = None) -> NDArray[np.uint8]:
        """8-bit codes (H, W, 3) of the window or a box of it, row 0 on top."""
        width, height = self.wnd.buffer_size
        x, y, w, h = box or (0, 0, width, height)
        data = self.wnd.fbo.read(viewport=(x, height - y - h, w, h), components=3, alignment=1)
        return np.ascontiguousarray(np.frombuffer(data, np.uint8).reshape(h, w, 3)[::-1])


def run(setup: Setup, again: bool = False, lesson: Path | None = None) -> None:
    """Open the window on ``setup`` and stay until it is closed.

    With ``again``, the setup that the last window was closed on takes its place. A ``lesson``
    is opened beside it.

    Raises
    ------
    NoWindowError
        With the reason, where the system has no window or no GL context to give.
    """
    try:
        window: Any = moderngl_window.create_window_config_instance(
            LightingWindow, args=["--window", "glfw"]
        )
    except Exception as error:  # each layer below raises what it likes
        raise NoWindowError(f"the display refuses one: {error}") from error
    kept = memory.recall()
    window.show(kept.setup if again and kept.setup else setup)
    window.state = memory.recalled(window.state, kept)
    window.wanted_size = kept.size
    if lesson is not None:
        window.state = open_lesson(window.state, lesson)
    try:
        loop(window)
        memory.keep(window.state, window.wnd.size)
    finally:
        window.release()
        window.wnd.destroy()
