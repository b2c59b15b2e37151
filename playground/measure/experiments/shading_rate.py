"""Flat, per-vertex and per-fragment shading on finer and finer spheres."""

from __future__ import annotations

from collections.abc import Iterator

from playground.measure.experiments.sentences import of, reach, sentence, times, took
from playground.measure.experiments.spheres import (
    QUICK_SIZE,
    REFERENCE,
    SIZE,
    exact_sphere,
    sphere,
)
from playground.measure.pictures import picture, picture_errors
from playground.measure.record import Candidate, Errors, Experiment
from playground.measure.rows import Row, ratio, slope
from playground.measure.timing import frames_of
from playground.percent import percent

SHADINGS = ("flat", "per-vertex", "per-fragment")
TESSELLATIONS = (8, 16, 32, 64, 128, 256, 512, 1024)
QUICK = (8, 32, 128)


def groups(quick: bool) -> Iterator[list[Candidate]]:
    """Every shading at every tessellation, all in turn."""
    size = QUICK_SIZE if quick else SIZE
    tessellations = QUICK if quick else TESSELLATIONS
    yield [_candidate(s, t, size) for t in tessellations for s in SHADINGS]


def _candidate(shading: str, tessellation: int, size: tuple[int, int]) -> Candidate:
    setup = sphere(tessellation).with_(shading=shading)

    def errors() -> Errors:
        exact = exact_sphere(size)
        return picture_errors(picture(setup, size), exact.image, REFERENCE, exact.covered)

    knobs = {"tessellation": tessellation}
    return Candidate(shading, knobs, frames_of(setup, size), errors)


def finding(rows: list[Row]) -> str:
    """Which shading reaches 1 % first, and how the errors fall."""
    bound = 0.01
    tried = [s for s in SHADINGS if of(rows, s)]
    found = {s: reach(of(rows, s), bound) for s in tried}
    there = sorted((row for row in found.values() if row is not None), key=lambda row: row.median)
    parts = [f"no shading reaches an error of {percent(bound)}" if tried and not there else ""]
    if there:
        best = there[0]
        parts = [f"an error of {percent(bound)} is reached first by {best.label} ({took(best)})"]
        parts += [f"by {r.label} in {times(ratio(r, best))} that" for r in there[1:]]
        never = [s for s, row in found.items() if row is None]
        parts.append(f"not by {' or '.join(never)} on any of these spheres" if never else "")
    falls = {s: slope(of(rows, s), "tessellation") for s in tried}
    orders = [f"{p:.1f} ({s})" for s, p in falls.items() if p is not None]
    if orders:
        parts.append(f"the error goes as the tessellation to the power {', '.join(orders)}")
    return sentence(*parts)


EXPERIMENT = Experiment(
    "shading-rate",
    "Shading rate",
    "What does it cost to evaluate the model per triangle, per vertex or per pixel, and how far "
    "is the picture from the exact one?",
    groups,
    finding,
    REFERENCE,
    show=("rmse", "max", "flip", "off", "left_out"),
)
