"""Speed and error: the log of dots, its axes, and the measuring in the window."""

import csv
import io
from dataclasses import replace

import numpy as np
import pytest

from playground.gui import actions
from playground.gui.measure import speed_log
from playground.gui.measure.speed_log import Dot, SpeedLog, key_of
from playground.gui.panels.speed import LEAST, error
from playground.gui.state import start
from playground.gui.widget import log_axis
from playground.scene.library import load

PANEL = "//Controls/Speed and error"
DOT = Dot("teapot", "flat", 8, 100, None, 2.0, 0.01, 0.5)


def test_a_dot_takes_the_place_of_an_older_one_of_the_same():
    log = SpeedLog().with_dot(DOT).with_dot(replace(DOT, mode="per-vertex"))
    log = log.with_dot(replace(DOT, wall_ms=3.0))
    assert [(dot.mode, dot.wall_ms) for dot in log.dots] == [("per-vertex", 2.0), ("flat", 3.0)]


def test_a_dot_is_placed_by_the_best_clock_there_is():
    assert DOT.milliseconds == 2.0
    assert replace(DOT, gpu_ms=0.5).milliseconds == 0.5
    assert (DOT.label, replace(DOT, tessellation=0).label) == ("8", "100 triangles")
    assert error(DOT) == 0.01
    assert error(replace(DOT, rmse=0.0)) == LEAST


def test_the_table_has_a_row_per_dot():
    log = SpeedLog().with_dot(DOT).with_dot(replace(DOT, mode="per-vertex", gpu_ms=0.25))
    rows = list(csv.DictReader(io.StringIO(log.to_csv())))
    assert [row["mode"] for row in rows] == ["flat", "per-vertex"]
    assert [row["gpu_ms"] for row in rows] == ["", "0.25"]
    assert float(rows[0]["rmse"]) == 0.01


def test_what_has_been_tried():
    state = start(load("popping"))
    assert speed_log.untried(state)
    dot = Dot(*key_of(state.setup), None, 1.0, 0.0, 0.0)
    state = replace(state, speed=state.speed.with_dot(dot))
    assert not speed_log.untried(state)
    assert speed_log.untried(state.with_setup(state.setup.with_(tessellation=7)))
    assert speed_log.untried(state.with_setup(state.setup.with_(shading="flat")))
    assert not speed_log.untried(state.with_setup(state.setup.with_(shininess=7)))


@pytest.mark.parametrize("values", [[1.0], [0.3, 0.4], [1e-8, 1.0], [2.0, 70.0]])
def test_the_axis_holds_its_values_and_some_round_numbers(values):
    low, high = log_axis.limits(values)
    assert low < min(values) and max(values) < high
    assert np.log10(high / low) >= log_axis.SHORTEST - 1e-9
    ticks = log_axis.ticks(low, high)
    assert len(ticks) >= 2
    assert all(low <= tick <= high for tick in ticks)


@pytest.fixture
def panel(hands):
    """The window on the setup "popping" with the panel open, and closed again."""
    hands.load("popping")
    hands.do(lambda c: c.item_open(PANEL))
    hands.frames(2)
    yield hands
    hands.do(lambda c: c.item_close(PANEL))


def finish(hands):
    hands.frames(2)
    hands.until(lambda: hands.state.speed.of is None)
    assert not hands.state.speed.error


@pytest.mark.gl
def test_the_window_measures_what_is_tried(panel):
    finish(panel)
    panel.window.state = actions.shade(panel.state, "per-fragment")
    finish(panel)
    vertex, fragment = panel.state.speed.dots
    assert (vertex.mode, fragment.mode) == ("per-vertex", "per-fragment")
    assert vertex.triangles == fragment.triangles == 320
    assert vertex.wall_ms > 0.0
    assert fragment.rmse < 1e-5 < 1e-3 < vertex.rmse
    assert panel.state.speed.wall_ms > 0.0
    seen = panel.pixels()
    np.testing.assert_array_equal(seen, panel.expected((seen.shape[1], seen.shape[0])))


@pytest.mark.gl
def test_the_buttons_measure_copy_and_clear(panel, monkeypatch):
    copied = []
    monkeypatch.setattr(panel.imgui, "set_clipboard_text", copied.append)
    finish(panel)
    panel.do(lambda c: c.item_click(f"{PANEL}/Copy as CSV"))
    assert "copied" in panel.state.message
    assert copied == [panel.state.speed.to_csv()]
    panel.do(lambda c: c.item_click(f"{PANEL}/Clear"))
    panel.frames(3)
    assert panel.state.speed.dots == () and panel.state.speed.of is None
    panel.do(lambda c: c.item_click(f"{PANEL}/###measure"))
    finish(panel)
    assert len(panel.state.speed.dots) == 1
