"""The race of the solvers: its numbers, its log, its books, and the panel that shows it."""

import csv
import io
from dataclasses import replace
from time import monotonic

import numpy as np
import pytest
from one_panel import alone

import playground as pg
from playground.errors import PlaygroundError
from playground.gui.radiosity import race_log, race_plot
from playground.gui.radiosity.energy_bars import MOST, bars_of, share_of, worst_imbalance
from playground.gui.radiosity.race_log import RaceLog
from playground.gui.radiosity.race_run import RaceJob, RaceRun
from playground.gui.state import start
from playground.gui.work.long_work import Piece
from playground.gui.work.process_work import ProcessWork
from playground.measure import solver_race
from playground.measure.solver_race import Account, SharedRows, racing
from playground.scene.settings import SOLVERS

PANEL = "//Controls/Solvers"
FEW = {"patches": 96}
GREY = (0.5, 0.5, 0.5)
EPS = np.finfo(float).eps


def raced(setup, solvers=SOLVERS, goal=1e-6):
    """The log of a race that has come to its end, in this process."""
    state = start(setup)
    state = race_log.started(replace(state, race=replace(state.race, solvers=solvers)))
    log = state.race
    for news in racing(log.of, solvers, goal, "numpy"):
        log = log.with_news(news)
    return replace(log, running=False)


@pytest.fixture(scope="module")
def box():
    return raced(pg.load("cornell-box").with_(**FEW))


def test_all_solvers_arrive_where_elimination_does(box):
    assert [lane.solver for lane in box.lanes] == list(SOLVERS)
    for lane in box.lanes:
        assert lane.ended and not lane.error, lane.solver
        assert lane.laps[-1].left <= 1e-6, lane.solver
        # Light that is left goes round in a box that reflects at most 0.7507: it is at most
        # 0.7507 / (1 − 0.7507) = 3.02 times itself in the light. So is, at each reflection, what
        # sending brings elsewhere than gathering, where A_i F_ij is not A_j F_ji.
        assert lane.laps[-1].error < 3.02 * (1e-6 + reciprocity(box)), lane.solver


def reciprocity(log):
    """How much gathering and sending differ: Σ |A_i F_ij − A_j F_ji| / Σ A_i F_ij."""
    factors = pg.radiosity(log.of, "numpy").form_factors
    power = factors.area[:, None] * factors.matrix()
    return float(np.abs(power - power.T).sum() / power.sum())


def test_times_and_rows_only_grow_and_all_light_is_in_the_books(box):
    for lane in box.lanes:
        first, *others = lane.laps
        assert (first.done, first.rows) == (0, 0)
        assert all(a.seconds <= b.seconds for a, b in zip(lane.laps, others, strict=False))
        assert all(a.rows <= b.rows for a, b in zip(lane.laps, others, strict=False))
        # sums over N patches, each channel; a step of theirs adds at most one rounding per term
        assert worst_imbalance(lane.laps) < 96 * EPS * 10
    rows = {lane.solver: lane.laps[1].rows for lane in box.lanes}
    assert rows["jacobi"] == rows["direct"] == box.patches  # gathering needs all at once
    assert rows["progressive"] == box.lane("progressive").laps[1].done < box.patches


def test_a_solver_pays_once_for_each_row_that_it_asks_for():
    shared = SharedRows(lambda chosen: np.eye(5)[chosen], 5)
    assert [*shared.fill()] == [1.0]
    shared.seconds[:] = (1.0, 2.0, 4.0, 8.0, 16.0)
    one, other = Account(shared), Account(shared)
    np.testing.assert_array_equal(one(np.array([3, 0])), np.eye(5)[[3, 0]])
    one(np.array([0, 1]))
    assert (one.seconds, other.seconds, one.used.sum()) == (11.0, 0.0, 3)


def test_reflectance_near_one_shows_who_still_converges():
    setup = pg.load("furnace").with_(diffuse=(0.999,) * 3, **FEW)
    log = raced(setup, ("jacobi", "overshooting", "conjugate-gradients"), 1e-3)
    done = {lane.solver: lane.laps[-1].done for lane in log.lanes}
    # Each sweep of Jacobi leaves the share 0.999 in a furnace: log(1e-3) / log(0.999) of them.
    assert done["jacobi"] == pytest.approx(np.log(1e-3) / np.log(0.999), abs=2)
    assert done["conjugate-gradients"] <= 3


def test_who_cannot_converge_says_why():
    setup = pg.load("furnace").with_(diffuse=(0.9,) * 3, normalise=False, **FEW)
    steps = racing(setup, ("jacobi", "direct"), 1e-6, "numpy")
    ended = dict(end for news in steps for end in news.ended)
    assert set(ended) == {"jacobi", "direct"}


def test_too_many_patches_are_refused(monkeypatch):
    monkeypatch.setattr(solver_race, "MOST_PATCHES", 50)
    with pytest.raises(PlaygroundError, match="at most 50"):
        next(racing(pg.load("furnace").with_(**FEW), renderer="numpy"))
    monkeypatch.setattr(race_log, "MOST_PATCHES", 50)
    state = race_log.started(start(pg.load("furnace").with_(**FEW)))
    assert state.race.of.settings.patches == 50  # the window takes as many as there may be


def test_bars_stand_on_each_other_up_to_what_is_emitted(box):
    laps = box.lane("progressive").laps
    for channel in race_log.CHANNELS:
        some, parts = bars_of(laps, channel)
        assert some[0] is laps[0] and some[-1] is laps[-1] and len(some) <= MOST
        np.testing.assert_allclose(parts.sum(axis=1), 100.0, rtol=1e-12)
    assert share_of((1.0, 2.0, 4.0), "summed") == 7.0
    assert share_of((1.0, 2.0, 4.0), "blue") == 4.0


def test_curves_leave_out_what_a_logarithm_cannot_show(box):
    laps = box.lane("jacobi").laps
    steps, left = race_plot.curve_of(laps, "steps", "light left")
    np.testing.assert_array_equal(steps, [lap.done for lap in laps[1:]])
    np.testing.assert_array_equal(left, [lap.left for lap in laps[1:]])
    seconds, error = race_plot.curve_of(laps, "time", "error")
    assert np.all(np.diff(seconds) >= 0.0) and np.all(error >= race_plot.LEAST)


def test_the_table_has_a_row_per_step(box):
    rows = list(csv.DictReader(io.StringIO(box.to_csv())))
    assert len(rows) == sum(len(lane.laps) for lane in box.lanes)
    first = box.lanes[0].laps[0]
    assert float(rows[0]["emitted"]) == sum(first.emitted)


def test_when_a_race_is_no_longer_that_of_the_setup():
    state = race_log.started(start(pg.load("furnace").with_(**FEW)))
    assert not race_log.outdated(state)
    assert not race_log.outdated(state.with_setup(state.setup.with_(eye=(0.1, 0.2, 0.3))))
    assert not race_log.outdated(state.with_setup(state.setup.with_(solver="direct")))
    assert not race_log.outdated(state.with_setup(state.setup.with_(lightmap="baked.npz")))
    assert race_log.outdated(state.with_setup(state.setup.with_(patches=50)))
    assert race_log.outdated(state.with_setup(state.setup.with_(diffuse=GREY)))


class Counting:
    """A job for the other process."""

    def __init__(self, count):
        self.count = count

    def pieces(self):
        for i in range(self.count):
            yield Piece((i + 1) / self.count, i)


def all_of(work):
    found, until = [], monotonic() + 300
    while not work.done and monotonic() < until:
        found += work.take()
    return found


def test_a_process_makes_the_pieces_and_ends():
    job = RaceJob(pg.load("furnace").with_(**FEW), ("conjugate-gradients",), 1e-6)
    work = ProcessWork(job)
    try:
        news = all_of(work)
    finally:
        work.close()
    assert news[-1].ended == (("conjugate-gradients", ""),)
    assert work.progress.share == 1.0


def test_an_error_of_the_process_is_told():
    empty = pg.load("sphere").with_(lights=())
    run, state = RaceRun(), race_log.started(start(empty))
    log, until = state.race, monotonic() + 300
    while log.running and monotonic() < until:
        log = run.advance(log)
    assert not log.running and "light" in log.error


def test_a_process_that_is_killed_is_told():
    work = ProcessWork(RaceJob(pg.load("cornell-box"), SOLVERS, 1e-6))
    work._process.kill()
    with pytest.raises(PlaygroundError, match="ended by itself"):
        all_of(work)
    work.close()


@pytest.fixture
def panel(hands):
    """The window on a furnace with the panel open, and closed again."""
    hands.load("furnace", **FEW)
    with alone(hands, PANEL):
        yield hands


def click(hands, name):
    hands.do(lambda c: c.item_click(f"{PANEL}/{name}"))


def finish(hands):
    hands.until(lambda: not hands.state.race.running)
    assert not hands.state.race.error


@pytest.mark.gl
def test_the_window_races_those_that_are_chosen(panel, monkeypatch, held_back):
    click(panel, "lanes/##jacobi")
    assert panel.state.race.solvers == SOLVERS[1:]
    before = panel.state.setup
    click(panel, "###race")
    assert panel.state.race.running
    held_back()
    finish(panel)
    log = panel.state.race
    assert [lane.solver for lane in log.lanes] == list(SOLVERS[1:])
    assert all(lane.ended and lane.laps for lane in log.lanes)
    assert panel.state.setup is before
    for knob in ("steps##against", "error##drawn"):
        click(panel, knob)
    copied = []
    monkeypatch.setattr(panel.imgui, "set_clipboard_text", copied.append)
    click(panel, "Copy as CSV")
    assert copied == [panel.state.race.to_csv()]


@pytest.mark.gl
def test_a_race_is_stopped_and_run_again(panel, held_back):
    panel.window.state = panel.state.with_setup(panel.state.setup.with_(patches=2000))
    click(panel, "###race")
    panel.frames(3)
    assert panel.state.race.running
    click(panel, "###race")
    assert not panel.state.race.running
    held_back()
    panel.frames(3)
    panel.window.state = panel.state.with_setup(panel.state.setup.with_(**FEW))
    panel.frames(2)
    click(panel, "###race")
    finish(panel)
    assert isinstance(panel.state.race, RaceLog) and panel.state.race.patches < 200
