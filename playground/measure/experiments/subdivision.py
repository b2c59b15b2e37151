"""How finely to divide: even patches and refined ones, against light gathered without them."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack
from functools import lru_cache

from playground.measure.experiments.sentences import of, reach, sentence, times
from playground.measure.gathered import REFERENCE, Gathered, gathered_picture, light_errors
from playground.measure.record import Batch, Candidate, Errors, Experiment, Timer
from playground.measure.rows import Row, slope
from playground.measure.timing import timed
from playground.percent import percent
from playground.render.radiosity.result import Radiosity, radiosity
from playground.render.renderer import open_renderer
from playground.scene.library import load
from playground.scene.setup import Setup

SIZE, QUICK_SIZE = (80, 60), (32, 24)
EVEN, QUICK_EVEN = (100, 300, 600, 1200, 2400, 5000), (100, 400)
REFINED, QUICK_REFINED = ((100, 1), (100, 2), (100, 3), (300, 1), (300, 2)), ((100, 1),)
UNIFORM, ADAPTIVE = "even", "refined"
PATCHES = "patches"
BOUND = 0.05


def groups(quick: bool) -> Iterator[list[Candidate]]:
    """All divisions of the Cornell box, in turn."""
    asked = [(count, 0) for count in (QUICK_EVEN if quick else EVEN)]
    asked += QUICK_REFINED if quick else REFINED
    yield [_candidate(count, rounds, quick) for count, rounds in asked]


def _candidate(count: int, rounds: int, quick: bool) -> Candidate:
    setup = _scene().with_(patches=count, refinement=rounds)

    def opened(_: ExitStack) -> Timer:
        def batch() -> Batch:
            found: list[Radiosity] = []
            taken = timed(lambda: found.append(_solved(setup)), 1)
            return Batch(taken, {PATCHES: [float(len(found[0].patches))]})

        return batch

    def errors() -> Errors:
        size = QUICK_SIZE if quick else SIZE
        with open_renderer(size, method="radiosity") as drawn:
            image = drawn.render(setup)
        return light_errors(image.pixels, _reference(quick))  # type: ignore[union-attr]

    knobs = {"at first": count, "rounds": rounds} if rounds else {"at first": count}
    return Candidate(ADAPTIVE if rounds else UNIFORM, knobs, opened, errors, "Cornell box")


def _scene() -> Setup:
    return load("cornell-box").with_(terms=("diffuse", "emissive"))


def _solved(setup: Setup) -> Radiosity:
    result = radiosity(setup).solve()
    result.close()
    return result


@lru_cache(maxsize=2)
def _reference(quick: bool) -> Gathered:
    return gathered_picture(_scene(), QUICK_SIZE if quick else SIZE, quick)


def finding(rows: list[Row]) -> str:
    """How the error falls, and whether refining reaches a bound sooner than dividing evenly."""
    parts = []
    even = sorted(of(rows, UNIFORM), key=lambda row: int(row.knobs["at first"]))
    power = slope(even, "at first")
    if power is not None:
        parts.append(
            f"{even[0].knobs['at first']} even patches are off by {percent(even[0].error or 0.0)}, "
            f"{even[-1].knobs['at first']} by {percent(even[-1].error or 0.0)}: "
            f"as their number to the power {power:.2f}"
        )
    found = {method: reach(of(rows, method), BOUND) for method in (UNIFORM, ADAPTIVE)}
    for method, row in found.items():
        if row is not None:
            parts.append(f"{percent(BOUND)} takes {_told(row)}")
        elif of(rows, method):
            parts.append(f"no {method} patches come within {percent(BOUND)}")
    first, second = found.values()
    if first is not None and second is not None:
        parts[-1] += f", {times(second.median / first.median)} the time"
    return sentence(*parts)


def _told(row: Row) -> str:
    return f"{row.more.get(PATCHES, 0.0):.0f} {row.method} patches ({row.median / 1e3:.2g} s)"


EXPERIMENT = Experiment(
    "subdivision",
    "Subdivision",
    "Into how many patches must a room be divided, and is it better to refine them where the "
    "light changes?",
    groups,
    finding,
    REFERENCE,
    error="mean",
    error_label="mean error / mean light",
    time_label="ms to the solution",
    needs_gl=False,
    show=("mean", "rmse", PATCHES),
)
