"""All solvers of radiosity at three depths, in the Cornell box made ever whiter."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack
from functools import lru_cache

import numpy as np

from playground.measure import metrics
from playground.measure.experiments.sentences import listed, of, sentence, times, took
from playground.measure.record import Candidate, Errors, Experiment, Timer
from playground.measure.rows import Row, cases
from playground.measure.timing import rounds_of
from playground.percent import percent
from playground.render.radiosity.factor.form_factors import open_rows
from playground.render.radiosity.factor.matrix import FormFactors
from playground.render.radiosity.patch.divide import divide
from playground.render.radiosity.patch.patches import Patches
from playground.render.radiosity.solver.solve import SOLVERS, Step, System, solution
from playground.scene.library import load
from playground.shading.floats import Array

PATCHES, QUICK_PATCHES = 600, 150
REFLECTANCES, QUICK_REFLECTANCES = (0.5, 0.8, 0.95, 0.99), (0.5, 0.99)
LEFT, QUICK_LEFT = (1e-2, 1e-4, 1e-6), (1e-4,)
JUDGED = 1e-4  # of the light left: what the finding speaks of
STEPS, ASKED, BOUND = "sweeps, iterations or shots", "rows asked for", "bound"
REFERENCE = "elimination in float64"


def groups(quick: bool) -> Iterator[list[Candidate]]:
    """Every solver with every share of light left, at one reflectance, in turn."""
    patches = QUICK_PATCHES if quick else PATCHES
    for rho in QUICK_REFLECTANCES if quick else REFLECTANCES:
        yield [
            _candidate(solver, rho, left, patches)
            for left in (QUICK_LEFT if quick else LEFT)
            for solver in SOLVERS
            if solver != "direct" or left == JUDGED
        ]


def _candidate(solver: str, rho: float, left: float, patches: int) -> Candidate:
    def opened(_: ExitStack) -> Timer:
        system = _system(rho, patches)
        return rounds_of(lambda: solution(system, solver, left), 1)

    def errors() -> Errors:
        system = _system(rho, patches)
        fresh = _fresh(system)
        return judged(solution(fresh, solver, left), _exact(rho, patches), fresh)

    case = f"Cornell box, {patches} patches, reflectance {rho:g}"
    return Candidate(solver, {"left": left}, opened, errors, case)


@lru_cache(maxsize=2)
def _matrix(patches: int) -> tuple[Patches, FormFactors]:
    """The Cornell box and all of its form factors: what solvers take is then their own time."""
    setup = load("cornell-box").with_(patches=patches)
    found = divide(setup)
    rows = open_rows(found, setup.settings)
    factors = FormFactors(rows, found, setup.settings.normalise)
    factors.row_sums(np.arange(len(found)))
    rows.close()
    return found, factors


@lru_cache(maxsize=4)
def _system(rho: float, patches: int) -> System:
    """The box with walls and blocks that reflect ``rho`` of every colour."""
    found, factors = _matrix(patches)
    reflects = np.asarray((found.reflectance > 0.0).any(axis=1))
    reflectance = np.outer(rho * reflects, np.ones(3))
    return System(factors, found.area, reflectance, found.emission)


@lru_cache(maxsize=4)
def _exact(rho: float, patches: int) -> Array:
    return solution(_system(rho, patches), "direct").light


def _fresh(system: System) -> System:
    """The same, with form factors that count which rows they are asked for."""
    known = system.form_factors
    again = FormFactors(known.rows, _Known(known.area), known.normalise, closed=known.closed)
    return System(again, system.area, system.reflectance, system.emission)


class _Known:
    def __init__(self, area: Array) -> None:
        self.area = area


def judged(step: Step, exact: Array, system: System) -> Errors:
    """How far the light that was followed is off, as shares of the mean light."""
    scale = float(np.mean(exact))
    got = step.exact
    return Errors(
        rmse=metrics.rmse(got, exact) / scale,
        max=metrics.largest(got, exact) / scale,
        mean=float(np.mean(np.abs(got - exact))) / scale,
        reference=REFERENCE,
        more={
            STEPS: float(step.done),
            ASKED: float(system.form_factors.computed),
            BOUND: step.bound,
        },
    )


def finding(rows: list[Row]) -> str:
    """At each reflectance the fastest, and how much longer the others take."""
    parts = []
    for case in cases(rows):
        here = [r for r in rows if r.case == case and r.knobs.get("left") == JUDGED]
        found = [of(here, solver)[0] for solver in SOLVERS if of(here, solver)]
        if not found:
            continue
        found.sort(key=lambda row: row.median)
        best, others = found[0], found[1:]
        words = f"{case}: {best.method} is the fastest to leave {percent(JUDGED)} of the light "
        words += f"({took(best)}{_steps(best)})"
        if others:
            taken = (f"{r.method} {times(r.median / best.median)}{_steps(r)}" for r in others)
            words += f"; of its time the others take: {listed(taken)}"
        parts.append(words)
    return sentence(*parts)


def _steps(row: Row) -> str:
    steps = row.errors.more.get(STEPS) if row.errors else None
    return "" if steps is None else f", {steps:.0f} step{'s' if steps != 1.0 else ''}"


EXPERIMENT = Experiment(
    "solvers",
    "Solvers",
    "Which solver needs how long, how many steps and how many rows of the matrix, "
    "as surfaces get whiter? (All rows are there already.)",
    groups,
    finding,
    REFERENCE,
    error="mean",
    error_label="mean error / mean light",
    time_label="ms to the solution",
    needs_gl=False,
    show=("mean", "max", STEPS, ASKED, BOUND),
)
