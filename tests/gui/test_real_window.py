"""One smoke test with a real window, on a display that Xvfb pretends to be."""

import shutil
import subprocess
import sys
from types import SimpleNamespace

import pytest

pytestmark = pytest.mark.gl

SCRIPT = """
from playground.gui import actions, app, open_window, run_loop
from playground.scene.library import load

kept = []

class Brief(app.LightingWindow):
    def on_render(self, time, frame_time):
        super().on_render(time, frame_time)
        kept.append(self.pixels(self.view_box()).std())
        if len(kept) == 5:
            self.on_files_dropped_event(0, 0, ["nowhere.obj"])
        if len(kept) == 10:
            assert self.state.failed and "nowhere.obj" in self.state.message
            self.state = actions.quit_window(self.state)

app.LightingWindow = Brief
run_loop.AWAKE = float("inf")  # it would sleep where eleven frames take longer than that
assert open_window(load("sphere")) == 0
assert len(kept) == 11, len(kept)
assert min(kept[2:]) > 5.0, kept
print("closed")
"""


@pytest.mark.parametrize(("seconds", "frames"), [(1 / 64, 45), (0.2, 4), (5.0, 4)])
def test_some_frames_follow_an_event_however_slow_they_are(monkeypatch, seconds, frames):
    from playground.gui import run_loop

    drawn = []
    wnd = SimpleNamespace(is_closing=False, use=list, swap_buffers=list)
    wnd.render = lambda now, delta: drawn.append(now)
    timer = SimpleNamespace(start=list, next_frame=lambda: (len(drawn), seconds))
    window = SimpleNamespace(wnd=wnd, timer=timer, ui=SimpleNamespace(after_swap=list))

    def slept(window):
        window.wnd.is_closing = True
        return True

    for name in ("_accept_drops", "_fit"):
        monkeypatch.setattr(run_loop, name, lambda window: None)
    monkeypatch.setattr(run_loop, "busy", lambda window: False)
    monkeypatch.setattr(run_loop, "_slept", slept)
    monkeypatch.setattr(run_loop, "perf_counter", lambda: seconds * len(drawn))
    run_loop.loop(window)
    assert len(drawn) == frames


def test_the_window_opens_draws_and_closes(gl_context, tmp_path):
    if not (sys.platform.startswith("linux") and shutil.which("xvfb-run")):
        pytest.skip("xvfb-run is not installed")
    command = ["xvfb-run", "-a", "-s", "-screen 0 1280x720x24", sys.executable, "-c", SCRIPT]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    assert done.stdout.strip() == "closed", done.stderr
    assert not list(tmp_path.glob("*.png")), "no window: " + done.stderr
