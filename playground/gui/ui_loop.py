"""Dear ImGui inside a moderngl-window: its native backends, frame by frame.

With a glfw window the platform backend feeds mouse and keyboard; headless, a test puts
events into `imgui.get_io` itself, or lets the ImGui test engine do it.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from typing import Any

from imgui_bundle import _imgui_bundle, imgui, implot  # type: ignore[attr-defined]

from playground.gui.widget import theme

GLSL = "#version 330"


class UiLoop:
    """One ImGui context over one window, from the first frame to `close`."""

    def __init__(self, window: Any, test_engine: bool = False) -> None:
        self._window = window
        self.context = imgui.create_context()
        self._plots = implot.create_context()
        self.io = imgui.get_io()
        self.io.set_ini_filename("")
        self.io.config_windows_move_from_title_bar_only = True
        self.io.config_dpi_scale_fonts = True
        # After an exception in a panel, ImGui closes what was left open and goes on.
        self.io.config_error_recovery_enable_assert = False
        self.io.config_error_recovery_enable_tooltip = False
        theme.load_font()
        self._native = window.name == "glfw"
        if self._native:
            # Chains to moderngl-window's callbacks, so those go on working.
            handle = ctypes.cast(window._window, ctypes.c_void_p).value or 0
            imgui.backends.glfw_init_for_opengl(handle, True)
        imgui.backends.opengl3_init(GLSL)
        self._new_frame: Callable[[], Any] = imgui.new_frame
        self._render: Callable[[], Any] = imgui.render
        self.engine: Any = None
        if test_engine:
            self._new_frame, self._render = without_gil()
            self.engine = _start_engine(self.context)

    def begin(self, seconds: float) -> None:
        """Start a frame, ``seconds`` after the one before."""
        imgui.backends.opengl3_new_frame()  # without it, drawing crashes the process
        if self._native:
            imgui.backends.glfw_new_frame()
        else:
            self.io.display_size = imgui.ImVec2(*self._window.size)
            self.io.delta_time = max(seconds, 1e-4)
        self._new_frame()

    def end(self) -> None:
        """Draw what the frame has built into the framebuffer that is bound."""
        self._render()
        imgui.backends.opengl3_render_draw_data(imgui.get_draw_data())

    def after_swap(self) -> None:
        """Let the test engine, if there is one, go on to its next step."""
        if self.engine is not None:
            imgui.test_engine.post_swap(self.engine)

    @property
    def density(self) -> float:
        """How much larger than usual the screen wants things, apart from the font."""
        return float(imgui.get_main_viewport().dpi_scale or 1.0) if self._native else 1.0

    def close(self) -> None:
        """Shut down in the order that Dear ImGui needs."""
        if self.engine is not None:
            imgui.test_engine.stop(self.engine)
        imgui.backends.opengl3_shutdown()
        if self._native:
            imgui.backends.glfw_shutdown()
        implot.destroy_context(self._plots)
        imgui.destroy_context(self.context)
        if self.engine is not None:
            imgui.test_engine.destroy_context(self.engine)


def without_gil() -> tuple[Callable[[], Any], Callable[[], Any]]:
    """`imgui.new_frame` and `imgui.render` that let other Python threads run meanwhile.

    The test engine runs tests on a thread of its own and waits for it inside these two;
    Python's bindings would hold the lock that the test needs.

    Raises
    ------
    AttributeError
        The symbols are not exported under these names (not on Linux).
    """
    library = ctypes.CDLL(_imgui_bundle.__file__)
    new_frame, render = library._ZN5ImGui8NewFrameEv, library._ZN5ImGui6RenderEv
    for function in (new_frame, render):
        function.restype, function.argtypes = None, []
    return new_frame, render


def _start_engine(context: Any) -> Any:
    test_engine = imgui.test_engine
    engine = test_engine.create_context()
    options = test_engine.get_io(engine)
    options.config_run_speed = test_engine.TestRunSpeed.fast
    options.config_no_throttle = True
    options.config_saved_settings = False
    options.config_log_to_tty = True
    options.config_verbose_level = test_engine.TestVerboseLevel.warning
    test_engine.start(engine, context)
    return engine
