"""What the scene needs, as a value: what was measured, and what is dropped at the moment."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from playground.gui.work.long_work import Progress
from playground.measure.advice import METRICS, Advice, Finding
from playground.measure.candidates import Candidate, without
from playground.scene.knob import Declared, choice, number
from playground.scene.setup import Setup

if TYPE_CHECKING:
    from playground.gui.state import State

Dropped = frozenset[Candidate]
REMEMBERED = 200  # setups that switches have made: as many as undo leads back to
NOTHING: Dropped = frozenset()


@dataclass(frozen=True)
class NeedsLog(Declared):
    """What the advisor has found so far, and about which setup.

    ``made`` are the setups that the switches have made of it, each with what it lacks: so
    the list knows after undo and redo, too, what is dropped.
    """

    label = "needs"

    of: Setup | None = None
    method: str = "raster"
    running: bool = False
    progress: Progress = field(default_factory=Progress)
    doing: str = ""
    findings: tuple[Finding, ...] = ()
    advice: Advice | None = None
    error: str = ""
    made: tuple[tuple[Setup, Dropped], ...] = ()
    budget: float = number(
        0.01, 1e-6, 1.0, scale="log", help="the largest error that the proposal may make"
    )
    metric: str = choice(
        "rmse", METRICS, help="the error of a picture as shown: mean square, as noticed, largest"
    )


def asked(state: State) -> State:
    """Measure the setup as it is."""
    of = replace(state.setup)  # a new object, noticed by identity
    before = state.needs
    method = "ray-tracing" if state.method == "ray-tracing" else "raster"
    log = NeedsLog(of=of, method=method, running=True, budget=before.budget, metric=before.metric)
    return replace(state, needs=log)


def cancelled(state: State) -> State:
    """Stop measuring; what has been found stays."""
    return replace(state, needs=replace(state.needs, running=False))


def dropped(state: State) -> Dropped | None:
    """What the present setup lacks of the measured one; None if it differs in other ways.

    The camera does not count: what has been dropped may be looked at from all sides.
    """
    log = state.needs
    if log.of is None:
        return None
    for setup, lacks in (*reversed(log.made), (log.of, NOTHING)):
        if _same(setup, state.setup):
            return lacks
    return None


def walked_away(state: State) -> bool:
    """Whether the camera stands elsewhere than where it was measured."""
    return state.needs.of is not None and state.needs.of.camera != state.setup.camera


def switched(state: State, candidate: Candidate, drop: bool) -> State:
    """Drop one candidate or take it back; those that it excludes come back."""
    lacks = dropped(state) or NOTHING
    if drop:
        lacks = frozenset(c for c in lacks if c.part != candidate.part) | {candidate}
    else:
        lacks -= {candidate}
    return applied(state, lacks)


def proposed(state: State) -> State:
    """Drop what the advisor proposes, and nothing else."""
    advice = state.needs.advice
    chosen = advice.chosen if advice is not None else ()
    return applied(state, frozenset(finding.candidate for finding in chosen))


def applied(state: State, lacks: Dropped) -> State:
    """The measured setup without ``lacks``, seen from where the camera is now."""
    log = state.needs
    assert log.of is not None
    less = without(log.of, lacks)
    setup = replace(less, camera=state.setup.camera, name=state.setup.name)
    log = replace(log, made=(*log.made, (setup, lacks))[-REMEMBERED:])
    return replace(state.with_setup(setup), needs=log, solo=None)


def _same(a: Setup, b: Setup) -> bool:
    alike = a.scene is b.scene or a.scene == b.scene
    return alike and (a.settings is b.settings or a.settings == b.settings)
