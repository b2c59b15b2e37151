"""Soft shadows: shadow rays to each area light, and the error that their number leaves."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache

from playground.measure.experiments.sentences import reach, sentence, times, took
from playground.measure.pictures import picture, picture_errors
from playground.measure.record import Candidate, Errors, Experiment
from playground.measure.rows import Row, cases, ratio, slope
from playground.measure.timing import frames_of
from playground.percent import percent
from playground.render.image import Image
from playground.scene.library import load

SCENE = "area-light"
COUNTS, QUICK_COUNTS = (1, 2, 4, 8, 16, 32, 64, 128), (1, 8, 32)
MOST = 1024
SIZE, QUICK_SIZE = (320, 240), (160, 120)
METHOD = "shadow rays"
REFERENCE = f"{MOST} shadow rays to each light"


def groups(quick: bool) -> Iterator[list[Candidate]]:
    """Every number of shadow rays, in turn."""
    size = QUICK_SIZE if quick else SIZE
    yield [_candidate(count, size) for count in (QUICK_COUNTS if quick else COUNTS)]


def _candidate(count: int, size: tuple[int, int]) -> Candidate:
    setup = load(SCENE).with_(light_samples=count)

    def errors() -> Errors:
        got = picture(setup, size, "gl", "ray-tracing")
        return picture_errors(got, _smoothest(size), REFERENCE)

    opened = frames_of(setup, size, "gl", "ray-tracing")
    return Candidate(METHOD, {"count": count}, opened, errors, SCENE)


@lru_cache(maxsize=2)
def _smoothest(size: tuple[int, int]) -> Image:
    return picture(load(SCENE).with_(light_samples=MOST), size, "gl", "ray-tracing")


def finding(rows: list[Row]) -> str:
    """How the error falls with the number, and the fewest rays within 1 %."""
    parts = []
    for case in cases(rows):
        here = sorted((r for r in rows if r.case == case), key=lambda r: int(r.knobs["count"]))
        first, last, power = here[0], here[-1], slope(here, "count")
        if power is None:
            continue
        words = (
            f"{case}: {last.knobs['count']} shadow rays take {times(ratio(last, first))} the time "
            f"of {first.knobs['count']} and change the error from {percent(first.error or 0.0)} to "
            f"{percent(last.error or 0.0)}, as their number to the power {power:.2f}"
        )
        best = reach(here, 0.01)
        none = "; none of these numbers comes within 1 %"
        words += none if best is None else f"; 1 % takes {best.knobs['count']} ({took(best)})"
        parts.append(words)
    return sentence(*parts)


EXPERIMENT = Experiment(
    "shadow-samples",
    "Shadow rays to area lights",
    "How many shadow rays to each area light does a smooth shadow take?",
    groups,
    finding,
    REFERENCE,
    show=("rmse", "max", "flip", "off"),
)
