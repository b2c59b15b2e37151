"""How fast radiosity is: form factors beside a peer, a room step by step, a large room."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from functools import lru_cache

import numpy as np

from playground.measure.blocks_box import blocks_box
from playground.measure.experiments.sentences import listed, of, sentence
from playground.measure.large_radiosity import solved_elsewhere
from playground.measure.matrix_errors import SUM_OFF, converged_rows, row_errors, some_rows
from playground.measure.peer_viewfactor import INSTALLED, NAME, viewfactor_rows
from playground.measure.record import Batch, Candidate, Errors, Experiment, Timer
from playground.measure.row_methods import row_maker
from playground.measure.rows import Row, cases
from playground.percent import percent
from playground.render.radiosity.patch.patches import Patches
from playground.render.radiosity.result import radiosity
from playground.render.radiosity.solver.system import Step
from playground.scene.library import load
from playground.scene.setup import Setup
from playground.shading.floats import Array

BOXES, QUICK_BOXES = (594, 2376), (594,)
JUDGED, QUICK_JUDGED = 66, 22  # rows
WAYS = {"hemicube 64x64": ("hemicube", {"resolution": 64}), "closed form": ("closed-form", {})}
ROOM, LARGE = 600, 10_000
SOLVED_BY = ("hemicube", "closed-form")
FIRST, CONVERGED, WHOLE = "first picture", "converged to 1e-4", "converged, own process"
FULLY = 1e-7  # share of the light left in what the room is held against
RATE, CPU, MEGABYTES = "patches per second", "s of all processors", "megabytes"
REFERENCE = "rows: closed form and 529 rays a pair; light: the converged solution"


def groups(quick: bool) -> Iterator[list[Candidate]]:
    """All form factors of the box with blocks, then the Cornell box, then a large one."""
    for patches in QUICK_BOXES if quick else BOXES:
        group = [_matrix(name, patches, quick) for name in WAYS]
        yield [*group, _peer(patches)] if INSTALLED and not quick else group
    methods = SOLVED_BY[-1:] if quick else SOLVED_BY
    yield [_room(name, method) for method in methods for name in (FIRST, CONVERGED)]
    if not quick:
        yield [_large(method) for method in SOLVED_BY]


def _matrix(name: str, patches: int, quick: bool) -> Candidate:
    method, knobs = WAYS[name]
    count = QUICK_JUDGED if quick else JUDGED

    def opened(stack: ExitStack) -> Timer:
        rows = stack.enter_context(row_maker(method, "gl", _box(patches), **knobs))
        everybody = np.arange(patches)
        rows(everybody[:1])
        return lambda: _counted(lambda: rows(everybody), patches)

    def errors() -> Errors:
        with row_maker(method, "gl", _box(patches), **knobs) as rows:
            return _judged(rows(np.arange(patches)), patches, count)

    return Candidate(name, {}, opened, errors, _box_case(patches))


def _peer(patches: int) -> Candidate:
    def opened(_: ExitStack) -> Timer:
        viewfactor_rows(blocks_box(BOXES[0]))  # compiles it
        return lambda: _counted(lambda: viewfactor_rows(_box(patches)), patches)

    def errors() -> Errors:
        return _judged(viewfactor_rows(_box(patches)), patches, JUDGED)

    return Candidate(NAME, {}, opened, errors, _box_case(patches))


def _box_case(patches: int) -> str:
    return f"box with blocks, {patches} patches"


@lru_cache(maxsize=2)
def _box(patches: int) -> Patches:
    return blocks_box(patches)


@lru_cache(maxsize=2)
def _converged(patches: int, count: int) -> Array:
    return converged_rows(_box(patches), some_rows(_box(patches), count))


def _judged(matrix: Array, patches: int, count: int) -> Errors:
    """Errors of evenly chosen rows; the row sums are those of all."""
    chosen = some_rows(_box(patches), count)
    found = row_errors(matrix[chosen], _converged(patches, count), REFERENCE)
    sums = np.sum(matrix, axis=1, dtype=np.float64)
    found.more[SUM_OFF] = float(np.abs(sums - 1.0).max())
    return found


def _counted(work: Callable[[], object], patches: int) -> Batch:
    """One call: milliseconds, and what that means per second and in time of all processors."""
    start, used = time.perf_counter(), time.process_time()
    work()
    seconds, cpu = time.perf_counter() - start, time.process_time() - used
    return Batch([1e3 * seconds], {RATE: [patches / seconds], CPU: [cpu]})


def _room(name: str, method: str) -> Candidate:
    setup = load("cornell-box").with_(patches=ROOM, form_factors=method)

    def opened(_: ExitStack) -> Timer:
        _shown(setup, name)
        return lambda: _counted(lambda: _shown(setup, name), ROOM)

    def errors() -> Errors:
        got, want = _shown(setup, name).light, _light(method)
        off, scale = np.abs(got - want), float(np.mean(want))
        rmse = float(np.sqrt(np.mean(off**2)))
        return Errors(rmse / scale, float(off.max()) / scale, float(off.mean()) / scale, REFERENCE)

    return Candidate(f"{name}, {method}", {}, opened, errors, f"Cornell box, {ROOM} patches")


@lru_cache(maxsize=2)
def _light(method: str) -> Array:
    setup = load("cornell-box").with_(patches=ROOM, form_factors=method, convergence=FULLY)
    result = radiosity(setup).solve()
    result.close()
    return result.light


def _shown(setup: Setup, name: str) -> Step:
    """From the setup to light at the corners of its meshes: of the first shots, or of all."""
    result = radiosity(setup)
    for step in result.steps():
        if name == FIRST and step.done:
            break
    result.stored()
    result.close()
    return result.last


def _large(method: str) -> Candidate:
    def opened(_: ExitStack) -> Timer:
        def once() -> Batch:
            found = solved_elsewhere(LARGE, method)
            more = {
                RATE: found["patches"] / found["seconds"],
                CPU: found["processors"],
                MEGABYTES: found["megabytes"],
            }
            return Batch([1e3 * found["seconds"]], {name: [x] for name, x in more.items()})

        return once

    return Candidate(f"{WHOLE}, {method}", {}, opened, None, f"Cornell box, {LARGE} patches")


def finding(rows: list[Row]) -> str:
    """Rates and errors of form factors; times of the rooms."""
    parts = []
    for case in cases(rows):
        here = [row for row in rows if row.case == case]
        words = [_rate(row) for name in (*WAYS, NAME) for row in of(here, name)]
        words += [
            _time(row)
            for name in (FIRST, CONVERGED, WHOLE)
            for method in SOLVED_BY
            for row in of(here, f"{name}, {method}")
        ]
        if words:
            parts.append(f"{case}: {listed(words)}")
    return sentence(*parts)


def _rate(row: Row) -> str:
    off = "" if row.error is None else f" off by {percent(row.error)}"
    return f"{row.method} {row.more.get(RATE, 0.0):.0f} patches per second{off}"


def _time(row: Row) -> str:
    words = f"{row.method} after {row.median / 1e3:.2g} s"
    if row.error is not None:
        words += f", off by {percent(row.error)}"
    if MEGABYTES in row.more:
        words += f", {row.more[MEGABYTES]:.0f} MB"
    return words


EXPERIMENT = Experiment(
    "radiosity",
    "Speed of radiosity",
    "How many patches per second get their form factors, and how soon is there a picture?",
    groups,
    finding,
    REFERENCE,
    error="mean",
    error_label="form factors: sum of errors / sum; light: mean error / mean",
    time_label="ms in all",
    show=("mean", "max", SUM_OFF, RATE, CPU, MEGABYTES),
)
