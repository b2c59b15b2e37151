"""What the scene needs: the list with its switches, and the measuring beside the window."""

from dataclasses import replace

import numpy as np
import pytest
from one_panel import alone

from playground.gui import actions
from playground.gui.measure import needs_log, needs_run
from playground.gui.measure.needs_log import NOTHING, applied, asked, dropped, switched, walked_away
from playground.gui.measure.needs_run import NeedsRun
from playground.gui.panels import needs as needs_panel
from playground.gui.state import start
from playground.measure import advisor
from playground.measure.advisor import advise
from playground.scene.library import load
from playground.scene.light import PointLight

PANEL = "//Controls/What the scene needs"
BLACK = (0.0, 0.0, 0.0)
DARK = PointLight(position=(1, 3, 4), diffuse=BLACK, specular=BLACK, ambient=BLACK)


def cost(setup):
    """Milliseconds that grow with lights and terms: no test waits for a clock."""
    return 1.0 + len(setup.scene.lights) + 0.1 * len(setup.settings.terms)


def with_dark_light(name="sphere"):
    setup = load(name)
    return setup.with_(lights=(*setup.scene.lights, DARK))


def measured(setup=None):
    """The state of a window in which the advisor has come to its end."""
    state = asked(start(setup or with_dark_light()))
    found = advise(state.needs.of, size=(32, 24), renderer="numpy", cost=cost)
    log = replace(state.needs, running=False, findings=found.findings, advice=found)
    return replace(state, needs=log)


def candidate(state, name):
    return next(f.candidate for f in state.needs.findings if f.candidate.name == name)


def test_a_switch_drops_and_restores():
    state = measured()
    dark = candidate(state, "light 1 (point)")
    assert dropped(state) == NOTHING
    less = switched(state, dark, True)
    assert less.setup.scene.lights == state.setup.scene.lights[:1]
    assert dropped(less) == {dark}
    back = switched(less, dark, False)
    assert back.setup == state.setup and dropped(back) == NOTHING


def test_what_excludes_each_other_is_dropped_one_at_a_time():
    state = measured()
    flat = candidate(state, "shading: per-fragment → flat")
    gouraud = candidate(state, "shading: per-fragment → per-vertex")
    both = switched(switched(state, flat, True), gouraud, True)
    assert dropped(both) == {gouraud} and both.setup.settings.shading == "per-vertex"


def test_undo_finds_what_is_dropped_then():
    state = measured()
    first = switched(state, candidate(state, "specular term"), True)
    second = switched(first, candidate(state, "light 1 (point)"), True)
    for earlier in (first, state):
        assert dropped(second.with_setup(earlier.setup)) == dropped(earlier)
    assert len(dropped(second)) == 2


def test_other_changes_make_it_stale_and_the_camera_does_not():
    state = measured()
    assert dropped(state.with_setup(state.setup.with_(shininess=3))) is None
    assert dropped(state.with_setup(state.setup.with_(gate=True))) is None
    assert dropped(start(load("teapot"))) is None
    moved = state.with_setup(state.setup.with_(eye=(0, 0, 9)))
    assert dropped(moved) == NOTHING and walked_away(moved) and not walked_away(state)
    less = switched(moved, candidate(state, "light 1 (point)"), True)
    assert less.setup.camera == moved.setup.camera


def test_the_proposal_is_what_the_advisor_proposed():
    state = measured()
    assert needs_log.proposed(state).setup == state.needs.advice.proposed
    assert needs_log.proposed(state).setup != state.setup
    assert applied(needs_log.proposed(state), NOTHING).setup == state.setup


def test_the_budget_stays_when_it_is_measured_again():
    state = measured()
    state = replace(state, needs=replace(state.needs, budget=0.2, metric="flip"))
    again = asked(state).needs
    assert (again.budget, again.metric, again.findings) == (0.2, "flip", ())


@pytest.mark.gl
def test_an_error_of_the_measuring_is_told(window):
    setup = load("sphere").with_(mesh="gone.obj")
    log = NeedsRun(window.ctx).advance(asked(replace(start(load("sphere")), setup=setup)).needs)
    assert not log.running and "gone.obj" in log.error


@pytest.fixture
def panel(hands, monkeypatch):
    """The window on a setup with a light of no colour and the panel open; closed at the end."""
    monkeypatch.setattr(needs_run, "SIZE", (48, 36))
    monkeypatch.setattr(advisor, "Stopwatch", Costs)
    hands.load("sphere", lights=with_dark_light().scene.lights)
    with alone(hands, PANEL):
        yield hands


class Costs:
    """Stands in for the stopwatch: the same milliseconds every time."""

    def __init__(self, *_):
        pass

    def __call__(self, setup):
        return cost(setup)

    def close(self):
        """Nothing is held."""


def click(hands, name):
    hands.do(lambda c: c.item_click(f"{PANEL}/{name}"))


def finish(hands):
    hands.until(lambda: not hands.state.needs.running)
    assert not hands.state.needs.error


@pytest.mark.gl
def test_the_window_measures_and_applies_the_proposal(panel):
    assert not panel.state.needs.running
    before = panel.state.setup
    panel.do(lambda c: c.item_click(f"{PANEL}/###measure"))
    finish(panel)
    advice = panel.state.needs.advice
    assert "light 1 (point)" in [f.candidate.name for f in advice.chosen]
    assert panel.state.setup is before  # measuring changes nothing

    click(panel, "Apply proposal")
    assert panel.state.setup == advice.proposed
    seen = panel.pixels()
    np.testing.assert_array_equal(seen, panel.expected((seen.shape[1], seen.shape[0])))
    panel.window.state = actions.undo(panel.state)
    panel.frames(2)
    assert panel.state.setup is before and dropped(panel.state) == NOTHING
    panel.window.state = actions.redo(panel.state)
    click(panel, "Restore all")
    assert panel.state.setup == before


@pytest.mark.gl
@pytest.mark.parametrize("method", ["radiosity", "lightmap"])
def test_stored_light_is_said_not_to_be_measured(panel, method, monkeypatch):
    said = []
    monkeypatch.setattr(needs_panel.plots, "wrapped", lambda text, *_: said.append(text))
    panel.frames(1)
    assert not said
    panel.window.state = replace(panel.state, method=method)
    panel.frames(1)
    assert f"measured as rasterised, not by {method}" in said


@pytest.mark.gl
def test_a_tick_drops_and_a_change_dims_the_list(panel):
    click(panel, "###measure")
    finish(panel)
    click(panel, "needs/##specular term")
    assert "specular" not in panel.state.setup.settings.terms
    assert len(panel.state.history.past) == 1
    panel.window.state = actions.toggle_term(panel.state, "diffuse")
    panel.frames(2)
    assert dropped(panel.state) is None
    changed = panel.state.setup
    click(panel, "needs/##ambient term")
    assert panel.state.setup is changed  # nothing of a stale list can be switched


@pytest.mark.gl
def test_cancel_keeps_what_has_been_found(panel, monkeypatch, piece_by_piece):
    monkeypatch.setattr(needs_run, "SIZE", (640, 480))
    click(panel, "###measure")
    panel.until(lambda: panel.state.needs.findings)
    assert panel.state.needs.running
    click(panel, "###measure")
    log = panel.state.needs
    assert not log.running and log.findings and log.advice is None
    panel.frames(3)
    assert panel.state.needs is log
