"""A window without a display, and hands for it: scripted events, or the ImGui test engine."""

import gc
import os
import warnings
from itertools import pairwise
from time import monotonic, sleep

import numpy as np
import pytest

SIZE = (1280, 720)
PATIENCE = 300.0  # seconds to wait for what takes one: for a machine that is busy, or a failure
WITHOUT_LIBRARIES = ("test_fallback.py",)  # what can be tested where no window can be


def _missing():
    """Why the libraries of the window do not load; empty where they do."""
    try:
        import imgui_bundle  # noqa: F401
    except ImportError as error:
        return str(error)
    return ""


MISSING = _missing()


def pytest_ignore_collect(collection_path):
    """Leave out the tests of the window without its libraries; where GL is required, they fail."""
    required = os.environ.get("PLAYGROUND_REQUIRE_GL") == "1"
    window = collection_path.name.startswith("test_") and collection_path.parent.name == "gui"
    if MISSING and not required and window and collection_path.name not in WITHOUT_LIBRARIES:
        print(f"left out: {collection_path.name}: {MISSING}")
        return True
    return None


def _required(reason):
    """Skip, or fail where GL is required."""
    if os.environ.get("PLAYGROUND_REQUIRE_GL") == "1":
        pytest.fail(f"PLAYGROUND_REQUIRE_GL=1, and {reason}")
    pytest.skip(reason)


@pytest.fixture(scope="module")
def window(gl_context):
    """The real app in moderngl-window's headless window, with the test engine where it works.

    It has a GL context of its own; when it is gone, the one of the other tests is current again.
    """
    with warnings.catch_warnings():
        # moderngl-window imports PyGLM by its old name
        warnings.filterwarnings("ignore", "Importing PyGLM", PendingDeprecationWarning)
        try:
            from playground.gui import app, ui_loop
        except ImportError as error:
            _required(f"the libraries of the window do not load: {error}")
    import moderngl_window

    try:
        ui_loop.without_gil()
        engine = True
    except AttributeError:
        engine = False
    kind = type("Window", (app.LightingWindow,), {"test_engine": engine})
    with warnings.catch_warnings():
        # moderngl-window's headless window calls moderngl.create_standalone_context
        warnings.filterwarnings("ignore", ".*create_standalone_context", PendingDeprecationWarning)
        made = moderngl_window.create_window_config_instance(
            kind, args=["--window", "headless", "--backend", "egl"]
        )
    yield made
    made.release()
    made.wnd.destroy()
    moderngl_window.ContextRefs.WINDOW = moderngl_window.ContextRefs.CONTEXT = None
    del made
    gc.collect()
    gl_context.__enter__()


@pytest.fixture(autouse=True)
def _settings_of_its_own(tmp_path, monkeypatch):
    """No test, and no process that one starts, touches the user's settings."""
    monkeypatch.setenv("PLAYGROUND_SETTINGS", str(tmp_path / "settings"))


@pytest.fixture
def piece_by_piece(monkeypatch):
    """Work in the window's own thread makes one piece a frame, on a fast machine too."""
    from playground.gui.work import long_work

    monkeypatch.setattr(long_work, "BUDGET", 0.0)


@pytest.fixture
def held_back(monkeypatch):
    """Nothing arrives from other processes until this is called: what they do goes on."""
    from playground.gui.work.process_work import ProcessWork

    take = ProcessWork.take
    monkeypatch.setattr(ProcessWork, "take", lambda work: ())
    return lambda: monkeypatch.setattr(ProcessWork, "take", take)


class Hands:
    """Drives a window frame by frame."""

    def __init__(self, window):
        from imgui_bundle import imgui

        self.window, self.imgui, self.io = window, imgui, window.ui.io

    @property
    def state(self):
        return self.window.state

    def load(self, name, **changes):
        from playground.gui.frame import Hand
        from playground.gui.state import start
        from playground.scene.library import load

        self.window.hand = Hand()
        self.window.state = start(load(name).with_(**changes))
        self.io.add_mouse_pos_event(-1.0, -1.0)
        self.frames(3)

    def frames(self, count=2):
        for _ in range(count):
            self.window.wnd.use()
            self.window.wnd.render(0.0, 1 / 60)
            self.window.wnd.swap_buffers()
            self.window.ui.after_swap()
        assert not self.state.message.startswith("this is a bug"), self.state.message

    def until(self, over):
        """Draw frames until it is over, and a few more; fail where that does not come."""
        end = monotonic() + PATIENCE
        while not over():
            assert monotonic() < end, self.state.message
            self.frames(1)
            sleep(0.001)  # for those that are waited for
        self.frames()

    def drag(self, *points, button=0, steps=6):
        """Press at the first point, move through the others, let go at the last."""
        self.io.add_mouse_pos_event(*points[0])
        self.frames()
        self.io.add_mouse_button_event(button, True)
        self.frames()
        for a, b in pairwise(points):
            for i in range(1, steps + 1):
                share = i / steps
                self.io.add_mouse_pos_event(
                    a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])
                )
                self.frames(1)
        self.io.add_mouse_button_event(button, False)
        self.frames()

    def click(self, x, y, button=0):
        self.drag((x, y), button=button)

    def wheel(self, x, y, notches):
        self.io.add_mouse_pos_event(x, y)
        self.frames()
        self.io.add_mouse_wheel_event(0.0, notches)
        self.frames()

    def key(self, name, *modifiers):
        keys = self.imgui.Key
        held = [getattr(keys, f"mod_{m}") for m in modifiers]
        for key in (*held, getattr(keys, name)):
            self.io.add_key_event(key, True)
        self.frames()
        for key in (getattr(keys, name), *held):
            self.io.add_key_event(key, False)
        self.frames()

    def do(self, script):
        """Run ``script(engine)`` by the ImGui test engine, which finds widgets by their labels.

        It finds only what is built, so that all panels are, in sight or not.
        """
        from playground.gui.widget import out_of_sight

        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(out_of_sight, "MARGIN", float("inf"))
            self._run(script)

    def _run(self, script):
        if self.window.ui.engine is None:
            pytest.skip("the ImGui test engine cannot run here")
        engine = self.window.ui.engine
        tests = self.imgui.test_engine
        errors = []

        def guarded(context):
            try:
                script(context)
            except BaseException as error:  # the engine would swallow it
                errors.append(error)

        test = tests.register_test(engine, "gui", f"test {id(script)}")
        test.test_func = guarded
        tests.queue_test(engine, test)
        for _ in range(4000):
            self.frames(1)
            if tests.is_test_queue_empty(engine):
                break
        if errors:
            raise errors[0]
        assert test.output.status == tests.TestStatus.success, self.state.message

    def expected(self, size, **changes):
        """The codes (H, W, 3) that the renderer gives for the present setup with changes."""
        from playground.render.gl.renderer import GLRenderer

        codes = np.empty((size[1], size[0], 4), dtype=np.uint8)
        with GLRenderer(size, self.window.ctx) as renderer:
            renderer.render(self.state.setup.with_(**changes), out=codes)
        return codes[..., :3]

    def pixels(self):
        """The codes (H, W, 3) of the view, float64."""
        self.frames(1)
        return self.window.pixels(self.window.view_box()).astype(np.float64)


@pytest.fixture
def hands(window, monkeypatch):
    """The window on the teapot, and whatever a test asks of it; no GL error is left behind.

    A pixel is explained in the frame that asks for it, however long that takes: tests count frames.
    """
    from playground.gui.pixel import explained

    monkeypatch.setattr(explained, "SHORT", float("inf"))
    made = Hands(window)
    made.load("teapot")
    yield made
    assert window.ctx.error == "GL_NO_ERROR"
