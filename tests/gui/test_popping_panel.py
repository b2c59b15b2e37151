"""The popping scope: its path, its measuring beside the window, and how it is asked for."""

from dataclasses import replace
from threading import Event
from time import monotonic, sleep

import numpy as np
import pytest

from playground.gui import actions, guess
from playground.gui.measure import scope_path, scope_run
from playground.gui.measure.scope_path import angle_of, measured, off_path, outdated, scrubbed
from playground.gui.panels.popping import curve
from playground.gui.state import start
from playground.gui.work import aside
from playground.gui.work.aside import Aside
from playground.measure.popping import Brightness, Step, largest_jump, orbit
from playground.scene.library import load

PANEL = "//Controls/Popping scope"
ANGLES = tuple(3.0 * i for i in range(20))  # fewer than the window's: tests are in a hurry


def asked(name="popping", **changes):
    return measured(start(load(name).with_(**changes)))


@pytest.mark.parametrize("angle", [0.0, 1.0, 90.0, 200.5, 359.0])
def test_the_angle_is_read_off_the_camera(angle):
    base = load("popping").camera
    assert angle_of(base, orbit(base, angle), angle) == pytest.approx(angle, abs=1e-9)


def test_only_cameras_on_the_path_have_an_angle():
    base = load("popping").camera
    x, y, z = base.eye
    for other in (
        replace(base, eye=(x, y + 0.01, z)),
        replace(base, eye=(1.01 * x, y, z)),
        replace(base, fov=base.fov + 1),
        replace(base, target=(0.1, 0, 0)),
    ):
        assert angle_of(base, other, 0.0) is None


def test_the_end_of_the_slider_is_not_its_beginning():
    base = load("popping").camera
    assert angle_of(base, orbit(base, 360.0), 360.0) == pytest.approx(360.0)
    assert angle_of(base, orbit(base, 360.0), 0.0) == pytest.approx(0.0)


def test_scrubbing_moves_the_camera_and_nothing_else():
    state = asked()
    moved = scrubbed(state, 90.0)
    assert moved.setup.camera == orbit(state.setup.camera, 90.0)
    assert replace(moved.setup, camera=state.setup.camera) == state.setup
    assert not outdated(moved) and not off_path(moved)
    assert scrubbed(moved, 0.0).setup.camera.eye == pytest.approx(state.setup.camera.eye)


def test_what_makes_a_measurement_outdated():
    state = asked()
    assert outdated(start(load("popping")))
    assert not outdated(state)
    assert outdated(state.with_setup(state.setup.with_(shininess=5)))
    assert outdated(state.with_setup(state.setup.with_(curve="srgb"))) is True
    assert not outdated(state.with_setup(state.setup.with_(shading="flat", samples=4)))
    assert outdated(state.with_setup(state.setup.with_(bugs=("missing-max",))))


def test_a_camera_off_the_path_begins_a_new_one():
    state = asked()
    state = state.with_setup(state.setup.with_(eye=(0, 2, 4)))
    assert off_path(state)
    again = measured(state)
    assert again.scope.of.camera == state.setup.camera and not off_path(again)
    on = measured(scrubbed(asked(), 90.0))
    assert on.scope.of.camera == asked().setup.camera
    assert on.scope.angle == pytest.approx(90.0)


def test_playing_goes_round_and_stops_when_the_camera_is_taken_away():
    state = asked()
    state = replace(state, scope=replace(state.scope, playing=True))
    for _ in range(200):
        state = scope_path.walked(state, 0.1)
    assert state.scope.playing
    assert state.scope.angle == pytest.approx(200 * 0.1 * scope_path.SPEED % 360.0)
    state = state.with_setup(state.setup.with_(eye=(0, 2, 4)))
    assert not scope_path.walked(state, 0.1).scope.playing


def test_a_riddle_is_measured_with_its_mistake():
    state = guess.begin(start(load("popping")))
    assert measured(state).scope.of.settings.bugs == (guess.answer(state.guess),)
    assert state.setup.settings.bugs == ()


def test_curves_are_what_the_plot_takes():
    steps = tuple(Step(a, {"flat": Brightness(2.0 * a, 3.0)}) for a in (0.0, 3.0))
    angles, values = curve(steps, "flat", lambda value: value.peak)
    np.testing.assert_array_equal(angles, [0, 3])
    np.testing.assert_array_equal(values, [0, 6])
    assert curve((), "flat", lambda value: value.peak)[1].size == 0


def test_aside_delivers_in_order_tells_errors_and_stops(monkeypatch):
    def items():
        yield from range(5)
        raise OSError("gone")

    work = Aside(items())
    found = ()
    until = monotonic() + 300
    while work.working and monotonic() < until:
        found += work.take()
        sleep(0.001)
    assert found == (0, 1, 2, 3, 4)
    assert str(work.error) == "gone"

    def endless():
        while True:
            sleep(0.001)
            yield 1

    work = Aside(endless())
    monkeypatch.setattr(aside, "PATIENCE", 300.0)
    work.close()
    assert not work._thread.is_alive()


def open_panel(hands, deed=lambda c: None):
    def script(context):
        context.item_open(PANEL)
        deed(context)

    hands.do(script)


def finish(hands):
    hands.until(lambda: not hands.state.scope.running)
    assert not hands.state.scope.error


@pytest.fixture
def panel(hands, monkeypatch, piece_by_piece):
    """The window on the setup "popping" with the panel open, and closed again."""
    for module in (scope_path, scope_run):
        monkeypatch.setattr(module, "ANGLES", ANGLES)
    hands.load("popping")
    open_panel(hands)
    hands.frames(2)
    yield hands
    hands.do(lambda c: c.item_close(PANEL))


@pytest.mark.gl
def test_the_window_measures_beside_its_frames(panel):
    assert panel.state.scope.running
    assert len(panel.state.scope.drawn) < len(ANGLES)
    finish(panel)
    scope = panel.state.scope
    assert [step.angle for step in scope.drawn] == list(ANGLES)
    assert [step.angle for step in scope.exact] == list(ANGLES)
    peaks = {mode: largest_jump(scope.drawn, mode).peak for mode in scope_path.DRAWN}
    assert peaks["per-vertex"] > 3 * peaks["per-fragment"]
    for drawn, exact in zip(scope.drawn, scope.exact, strict=True):
        difference = drawn.modes["per-fragment"].mean - exact.modes["reference"].mean
        assert abs(difference) < 1e-4
    panel.frames(3)
    assert panel.state.scope is scope or panel.state.scope.of is scope.of  # not again


@pytest.mark.gl
def test_cancel_stops_and_a_change_measures_again(panel, monkeypatch):
    finish(panel)
    wanted = Event()

    def held(*_):
        assert wanted.wait(60.0)
        yield from ()

    monkeypatch.setattr(scope_run, "scope", held)  # no reference comes, so that it goes on
    panel.window.state = actions.toggle_term(panel.state, "diffuse")
    panel.frames(2)
    assert panel.state.scope.running
    panel.do(lambda c: c.item_click(f"{PANEL}/###measure"))
    assert not panel.state.scope.running and panel.state.scope.progress.share < 1.0
    panel.frames(3)
    assert not panel.state.scope.running
    panel.window.state = actions.toggle_term(panel.state, "specular")
    panel.frames(2)
    assert panel.state.scope.running
    assert panel.state.scope.of.settings.terms == panel.state.setup.settings.terms
    wanted.set()


@pytest.mark.gl
def test_the_slider_moves_the_camera_as_one_step(panel):
    finish(panel)
    panel.do(lambda c: c.item_input_value(f"{PANEL}/##angle", 90.0))
    base = panel.state.scope.of.camera
    assert panel.state.setup.camera.eye == pytest.approx(orbit(base, 90.0).eye, rel=1e-6)
    assert not panel.state.scope.running
    panel.do(lambda c: c.item_click(f"{PANEL}/###play"))
    panel.frames(5)
    assert panel.state.scope.playing and panel.state.scope.angle > 90.0
    panel.do(lambda c: c.item_click(f"{PANEL}/###play"))
    assert not panel.state.scope.playing


@pytest.mark.gl
def test_measuring_leaves_the_picture_as_it_is(panel):
    finish(panel)
    seen = panel.pixels()
    np.testing.assert_array_equal(seen, panel.expected((seen.shape[1], seen.shape[0])))


@pytest.mark.gl
def test_the_line_in_a_plot_is_dragged_along_the_path(panel):
    finish(panel)
    panel.do(lambda c: c.item_input_value(f"{PANEL}/##angle", 90.0))
    places, others = [], ("View", "Terms", "Material")
    for name in others:  # all of the panel is to be seen
        panel.do(lambda c, name=name: c.item_close(f"//Controls/{name}"))
    panel.frames(3)
    first = "##brightest point of the highlight"
    panel.do(lambda c: places.append(c.item_info(f"{PANEL}/{first}").rect_full))
    (plot,) = places
    high, wide = (plot.min.y + plot.max.y) / 2.0, plot.max.x - plot.min.x
    # 90 is a quarter of the axis, which begins right of its numbers.
    for x in range(int(plot.min.x + 0.25 * wide), int(plot.min.x + 0.5 * wide), 4):
        panel.drag((float(x), high), (x + 0.3 * wide, high), steps=2)
        if panel.state.scope.angle != 90.0:
            break
    for name in others:
        panel.do(lambda c, name=name: c.item_open(f"//Controls/{name}"))
    assert 150.0 < panel.state.scope.angle < 270.0
    assert len(panel.state.history.past) == 2  # the typed angle, and the drag
