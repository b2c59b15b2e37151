"""The measuring instruments themselves: the scene they share, and what they report."""

import sys

import numpy as np
import pytest

import playground as pg
from playground.measure.experiments.first_image import run
from playground.measure.frames_scene import TESSELLATION, eye, frames_setup

SIZE = (160, 90)


def test_a_process_is_measured_by_itself():
    """Not by the memory of the one that started it, which has NumPy and a ballast loaded."""
    ballast = np.ones(40_000_000)
    seconds, megabytes = run([sys.executable, "-S", "-c", "pass"])
    assert 0 < seconds < 30
    assert megabytes < 100 < ballast.nbytes / 2**20
    with pytest.raises(RuntimeError, match="status 3"):
        run([sys.executable, "-c", "raise SystemExit(3)"])


def test_the_camera_of_the_frames_walks_a_circle():
    for step in (0, 7, 100):
        assert np.hypot(eye(step)[0], eye(step)[2]) == pytest.approx(3.0)
    assert [20 * f**2 for f in TESSELLATION.values()] == [980, 100_820, 1_003_520]


@pytest.mark.gl
def test_the_floor_draws_the_same_picture_as_ours(gl, monkeypatch):
    from playground.measure import floor, frames_scene

    monkeypatch.setattr(frames_scene, "SIZE", SIZE)
    setup = frames_setup("1k")
    drawn = floor.Floor(setup.scene.objects[0].geometry().mesh).frame(3)[::-1]
    ours = np.empty((SIZE[1], SIZE[0], 4), np.uint8)
    with pg.open_renderer(SIZE, "gl") as renderer:
        renderer.render(setup.with_(eye=eye(3)), out=ours)
    off = np.abs(drawn.astype(int) - ours).max(axis=-1)
    # The same formula in another order of operations: one code, on few pixels.
    assert np.quantile(off, 0.999) <= 1
    assert (off > 0).mean() < 0.01
