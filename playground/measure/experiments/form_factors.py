"""Every way to compute form factors, at every setting of its knob, against the exact ones."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack
from functools import lru_cache

from playground.measure.blocks_box import empty_box
from playground.measure.experiments.sentences import of, reach, sentence, times
from playground.measure.matrix_errors import SUM_OFF, exact_rows, row_errors, some_rows
from playground.measure.record import Candidate, Errors, Experiment, Timer
from playground.measure.row_methods import row_maker, timer_of
from playground.measure.rows import Row, slope
from playground.percent import percent
from playground.render.radiosity.patch.patches import Patches
from playground.shading.floats import Array

PARTS, QUICK_PARTS = 9, 5  # of an edge of a wall: 486 and 150 patches
ROWS, QUICK_ROWS = 48, 15
# Method, renderer, and the values of its knob.
WAYS: dict[str, tuple[str, str, str, tuple[int, ...]]] = {
    "hemicube, GL": ("hemicube", "gl", "resolution", (16, 32, 64, 128, 256)),
    "hemicube, NumPy": ("hemicube", "numpy", "resolution", (16, 64)),
    "hemisphere": ("hemisphere", "numpy", "samples", (256, 1024, 4096, 16384)),
    "closed form, GL": ("closed-form", "gl", "points", (1, 2, 3, 4)),
    "closed form, NumPy": ("closed-form", "numpy", "points", (1, 2, 3, 4)),
    "point to polygon": ("point-to-polygon", "numpy", "", (0,)),
    "point to point": ("point-to-point", "numpy", "", (0,)),
}
QUICK_MOST = {"resolution": 64, "samples": 1024, "points": 3}
REFERENCE = "what two polygons exchange, by closed form in float64"
BOUND = 0.01


def groups(quick: bool) -> Iterator[list[Candidate]]:
    """All of them in turn, in an empty box: nothing hides anything, so all is known exactly."""
    parts, count = (QUICK_PARTS, QUICK_ROWS) if quick else (PARTS, ROWS)
    found = []
    for name, (_, _, knob, values) in WAYS.items():
        kept = [v for v in values if not quick or v <= QUICK_MOST.get(knob, v)]
        found += [_candidate(name, {knob: v} if knob else {}, parts, count) for v in kept]
    yield found


def _candidate(name: str, knobs: dict[str, int], parts: int, count: int) -> Candidate:
    method, renderer, _, _ = WAYS[name]

    def opened(stack: ExitStack) -> Timer:
        patches = _box(parts)
        rows = stack.enter_context(row_maker(method, renderer, patches, **knobs))
        return timer_of(rows, some_rows(patches, count))

    def errors() -> Errors:
        patches = _box(parts)
        with row_maker(method, renderer, patches, **knobs) as rows:
            got = rows(some_rows(patches, count))
        return row_errors(got, _exact(parts, count), REFERENCE)

    return Candidate(name, knobs, opened, errors, f"empty box, {6 * parts**2} patches")


@lru_cache(maxsize=2)
def _box(parts: int) -> Patches:
    return empty_box(parts)


@lru_cache(maxsize=2)
def _exact(parts: int, count: int) -> Array:
    return exact_rows(_box(parts), some_rows(_box(parts), count))


def finding(rows: list[Row]) -> str:
    """What comes within 1 % first, who else does and when, and how the errors fall."""
    best = reach(rows, BOUND)
    if best is None:
        parts = [f"no method comes within {percent(BOUND)}"] if rows else []
    else:
        parts = [f"{percent(BOUND)} is reached first by {best.label} ({best.median:.2g} ms a row)"]
    powers = []
    for name, (_, _, knob, _) in WAYS.items():
        here = of(rows, name)
        first, power = reach(here, BOUND), slope(here, knob)
        if here and first is None:
            closest = min(row.error or 0.0 for row in here)
            parts.append(f"not by {name}: {percent(closest)} off at best")
        elif first is not None and best is not None and first is not best:
            parts.append(f"by {first.label} in {times(first.median / best.median)} that")
        if power is not None:
            powers.append(f"{knob}^{power:.1f} ({name})")
    if powers:
        parts.append(f"errors go as {', '.join(powers)}")
    return sentence(*parts)


EXPERIMENT = Experiment(
    "form-factors",
    "Form factors",
    "Every method of the lecture and its knob, in a box where the exact form factors are known: "
    "what does a row cost, and how far is it off?",
    groups,
    finding,
    REFERENCE,
    error="mean",
    error_label="sum of errors / sum of form factors",
    time_label="ms per row",
    show=("mean", "rmse", "max", SUM_OFF),
)
