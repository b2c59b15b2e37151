"""Radiosity in float32 and in float64, in a closed box that gets ever whiter."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import ExitStack
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from playground.measure.blocks_box import blocks_box, empty_box
from playground.measure.experiments.sentences import listed, of, sentence
from playground.measure.record import Candidate, Errors, Experiment, Timer
from playground.measure.row_methods import row_maker
from playground.measure.rows import Row, cases
from playground.measure.timing import rounds_of
from playground.percent import percent
from playground.render.radiosity.factor.matrix import FormFactors
from playground.render.radiosity.patch.patches import Patches
from playground.render.radiosity.solver.solve import System, solution
from playground.shading.floats import Array

BLOCKS, QUICK_PARTS = 594, 4  # the box with blocks; an empty one of 96 patches where time is short
REFLECTANCES = (0.5, 0.9, 0.99, 0.9999, 1.0 - 1e-6)
QUICK_REFLECTANCES = (0.5, 0.9999)
REFERENCE = "rows and elimination in float64"
Factors = NDArray[np.floating[Any]]


@dataclass(frozen=True)
class Way:
    """Where rows are computed, as what they are kept, whether they are normalised, and solved."""

    renderer: str
    kept: type[np.floating[Any]]
    normalised: bool
    solve: type[np.floating[Any]]


DOUBLE, SINGLE = "all in float64", "all in float32"
WAYS = {
    DOUBLE: Way("numpy", np.float64, True, np.float64),
    "float64 rows kept in float32": Way("numpy", np.float32, True, np.float64),
    "float32 rows (GL)": Way("gl", np.float32, True, np.float64),
    "float32 rows (GL), not normalised": Way("gl", np.float32, False, np.float64),
    SINGLE: Way("gl", np.float32, True, np.float32),
}


def groups(quick: bool) -> Iterator[list[Candidate]]:
    """All ways at one reflectance, in turn."""
    for rho in QUICK_REFLECTANCES if quick else REFLECTANCES:
        yield [_candidate(name, rho, quick) for name in WAYS]


def _candidate(name: str, rho: float, quick: bool) -> Candidate:
    def opened(_: ExitStack) -> Timer:
        return rounds_of(_solver(WAYS[name], rho, quick), 1)

    def errors() -> Errors:
        return judged(_solver(WAYS[name], rho, quick)(), _exact(rho, quick))

    judge = None if name == DOUBLE else errors
    return Candidate(name, {}, opened, judge, f"1 - reflectance = {1.0 - rho:.2g}")


@lru_cache(maxsize=8)
def _exact(rho: float, quick: bool) -> Array:
    return _solver(WAYS[DOUBLE], rho, quick)()


@lru_cache(maxsize=2)
def _box(quick: bool) -> Patches:
    return empty_box(QUICK_PARTS) if quick else blocks_box(BLOCKS)


@lru_cache(maxsize=4)
def _rows(renderer: str, quick: bool) -> Array:
    """All rows by closed form, as they came."""
    patches = _box(quick)
    with row_maker("closed-form", renderer, patches) as rows:
        return rows(np.arange(len(patches)))


def _solver(way: Way, rho: float, quick: bool) -> Callable[[], Array]:
    """Computes the light (N,) of a box of which one wall sends out 1, and all reflect ``rho``."""
    patches, matrix = _box(quick), _rows(way.renderer, quick)
    factors = FormFactors(
        lambda chosen: matrix[chosen], patches, way.normalised, closed=True, dtype=way.kept
    )
    emission = (patches.owner == 0) * 1.0
    # Our solver is float64, and refuses rows that sum to more than 1/rho: such light has no end.
    # Elimination gives numbers for these, too, and here they are to be seen.
    if way.solve is np.float32 or not way.normalised:
        kept = factors.matrix().astype(way.solve)
        return lambda: _eliminated(kept, way.solve(rho), emission.astype(way.solve))
    all_three = np.ones(3)
    reflectance = np.full((len(patches), 3), rho)
    system = System(factors, patches.area, reflectance, emission[:, None] * all_three)
    return lambda: solution(system, "direct").light[:, 0]


def _eliminated(matrix: Factors, rho: np.floating[Any], emission: Factors) -> Array:
    """The same by LAPACK in the precision of the matrix."""
    equations = -rho * matrix
    equations.flat[:: len(matrix) + 1] += 1.0
    return np.linalg.solve(equations, emission)


def judged(light: Array, exact: Array) -> Errors:
    """How far light (N,) is off, as shares of the mean light."""
    off = np.abs(light.astype(np.float64) - exact) / np.mean(exact)
    rmse = float(np.sqrt(np.mean(off**2)))
    return Errors(rmse, float(off.max()), float(off.mean()), REFERENCE)


def finding(rows: list[Row]) -> str:
    """How far each way is off at each reflectance."""
    parts = []
    for case in cases(rows):
        here = [row for row in rows if row.case == case]
        found = [row for name in WAYS for row in of(here, name) if row.errors is not None]
        told = [f"{percent(row.errors.max)} with {row.method}" for row in found if row.errors]
        if told:
            parts.append(f"{case}: off by {listed(told)}")
    return sentence(*parts)


EXPERIMENT = Experiment(
    "radiosity-precision",
    "Precision of radiosity",
    "Is float32 enough for form factors and for the solution, when nearly all light is reflected?",
    groups,
    finding,
    REFERENCE,
    error="max",
    error_label="largest error / mean light",
    time_label="ms to solve",
    show=("max", "rmse"),
)
