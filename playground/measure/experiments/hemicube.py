"""The hemicube: its resolution, whether each is turned, and what is drawn in it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack
from functools import lru_cache

from playground.measure.blocks_box import empty_box
from playground.measure.experiments.sentences import of, sentence, times
from playground.measure.matrix_errors import SUM_OFF, row_errors, some_rows
from playground.measure.record import Candidate, Errors, Experiment, Timer
from playground.measure.row_methods import row_maker, timer_of
from playground.measure.rows import Row, ratio, slope
from playground.percent import percent
from playground.render.radiosity.factor.form_factors import point_to_polygon
from playground.render.radiosity.patch.patches import Patches
from playground.shading.floats import Array

PARTS, QUICK_PARTS = 9, 5  # of an edge of a wall: 486 and 150 patches
ROWS, QUICK_ROWS = 96, 30
RESOLUTIONS, QUICK_RESOLUTIONS = (16, 32, 64, 128, 256, 512), (16, 64)
PARENTS, STRAIGHT, PLAIN = "parents", "parents, not turned", "every patch"
WAYS = {PARENTS: {}, STRAIGHT: {"rotate": False}, PLAIN: {"plain": True}}
REFERENCE = "Lambert's closed form from the centre of a patch"


def groups(quick: bool) -> Iterator[list[Candidate]]:
    """All ways at all resolutions, in turn."""
    parts, count = (QUICK_PARTS, QUICK_ROWS) if quick else (PARTS, ROWS)
    resolutions = QUICK_RESOLUTIONS if quick else RESOLUTIONS
    yield [_candidate(way, each, parts, count) for each in resolutions for way in WAYS]


def _candidate(way: str, resolution: int, parts: int, count: int) -> Candidate:
    knobs = {"resolution": resolution, **WAYS[way]}

    def opened(stack: ExitStack) -> Timer:
        rows = stack.enter_context(row_maker("hemicube", "gl", _box(parts), **knobs))
        return timer_of(rows, some_rows(_box(parts), count))

    def errors() -> Errors:
        with row_maker("hemicube", "gl", _box(parts), **knobs) as rows:
            got = rows(some_rows(_box(parts), count))
        return row_errors(got, _from_centres(parts, count), REFERENCE)

    case = f"empty box, {6 * parts**2} patches"
    return Candidate(way, {"resolution": resolution}, opened, errors, case)


@lru_cache(maxsize=2)
def _box(parts: int) -> Patches:
    return empty_box(parts)


@lru_cache(maxsize=2)
def _from_centres(parts: int, count: int) -> Array:
    return point_to_polygon(_box(parts), some_rows(_box(parts), count), occlusion=False)


def finding(rows: list[Row]) -> str:
    """Errors and row sums with the resolution; what turning and drawing parents change."""
    parts = []
    found = sorted(of(rows, PARENTS), key=lambda row: int(row.knobs["resolution"]))
    power = slope(found, "resolution")
    if power is not None:
        first, last = found[0], found[-1]
        parts.append(
            f"from {first.knobs['resolution']} to {last.knobs['resolution']} pixels the error "
            f"goes from {percent(first.error or 0.0)} to {percent(last.error or 0.0)}, as the "
            f"resolution to the power {power:.1f}, in {times(last.median / first.median)} the time"
        )
    sums = [row.errors.more[SUM_OFF] for row in found if row.errors and SUM_OFF in row.errors.more]
    if sums:
        parts.append(f"row sums are off by {max(sums):.1g} at most")
    for other, words in ((STRAIGHT, "hemicubes that are not turned"), (PLAIN, "drawing patches")):
        parts.append(_beside(found, of(rows, other), words))
    return sentence(*parts)


def _beside(ours: list[Row], others: list[Row], words: str) -> str:
    """How another way compares at the same resolutions: errors and times, least and most."""
    pairs = [(a, b) for a in ours for b in others if a.knobs == b.knobs and a.error and b.error]
    if not pairs:
        return ""
    errors = sorted((b.error or 0.0) / (a.error or 1.0) for a, b in pairs)
    taken = sorted(ratio(b, a) for a, b in pairs)
    return (
        f"{words} has {_range(errors)} the error and takes {_range(taken)} the time"
        if words.startswith("drawing")
        else f"{words} have {_range(errors)} the error and take {_range(taken)} the time"
    )


def _range(values: list[float]) -> str:
    low, high = values[0], values[-1]
    return times(low) if times(low) == times(high) else f"{low:.2g} to {times(high)}"


EXPERIMENT = Experiment(
    "hemicube",
    "Hemicube",
    "How many pixels must a hemicube have? Is it worth turning each by its own angle, and what "
    "does drawing the undivided surfaces in place of all patches save?",
    groups,
    finding,
    REFERENCE,
    error="mean",
    error_label="sum of errors / sum of form factors",
    time_label="ms per row",
    show=("mean", "rmse", "max", SUM_OFF),
)
