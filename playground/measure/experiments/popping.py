"""How much a highlight jumps from frame to frame while the camera moves evenly."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from playground.measure.analytic import exact_picture
from playground.measure.experiments.sentences import listed, of, sentence
from playground.measure.experiments.spheres import REFERENCE, sphere
from playground.measure.popping import largest_jump, orbit, scope
from playground.measure.record import Candidate, Errors, Experiment
from playground.measure.rows import Row
from playground.measure.timing import frames_of
from playground.percent import percent

SHADINGS = ("flat", "per-vertex", "per-fragment")
TESSELLATIONS = (8, 16, 32, 64, 128, 256)
QUICK = (8, 32, 128)
SHININESS = 60.0
SIZE = (160, 120)
STEP = 2.0  # degrees
ANGLES = [STEP * step for step in range(90)]  # half a turn


def groups(quick: bool) -> Iterator[list[Candidate]]:
    """Every shading at every tessellation, all in turn."""
    tessellations = QUICK if quick else TESSELLATIONS
    yield [_candidate(s, t) for t in tessellations for s in SHADINGS]


def _candidate(shading: str, tessellation: int) -> Candidate:
    setup = sphere(tessellation, SHININESS).with_(shading=shading)

    def errors() -> Errors:
        found = list(scope(setup, ANGLES, (shading,), SIZE, "gl"))
        peaks = np.array([step.modes[shading].peak for step in found])
        exact = exact_peaks()
        wrong = np.abs(np.diff(peaks) - np.diff(exact))
        return Errors(
            rmse=float(np.sqrt(np.mean(wrong**2))),
            max=float(wrong.max()),
            mean=float(wrong.mean()),
            reference=REFERENCE,
            more={
                "largest jump": largest_jump(found, shading).peak,
                "peak off by": float(np.abs(peaks - exact).max()),
            },
        )

    knobs = {"tessellation": tessellation}
    return Candidate(shading, knobs, frames_of(setup, SIZE), errors)


@lru_cache(maxsize=1)
def exact_peaks() -> NDArray[np.float64]:
    """The brightest pixel of the highlight on the exact sphere at each of `ANGLES`."""
    setup = sphere(64, SHININESS).with_(terms=("specular",), background=(0, 0, 0))
    pictures = (
        exact_picture(setup.with_(camera=orbit(setup.camera, angle)), SIZE) for angle in ANGLES
    )
    return np.array([float(picture.image.pixels.max()) for picture in pictures])


def finding(rows: list[Row]) -> str:
    """Where each shading jumps most and least, and whether a highlight is missed altogether."""
    parts, missed = [], []
    for shading in SHADINGS:
        found = [row for row in of(rows, shading) if row.error is not None]
        if found:
            most = max(found, key=lambda row: row.error or 0.0)
            last = max(found, key=lambda row: int(row.knobs["tessellation"]))
            parts.append(
                f"{shading} {percent(most.error or 0.0)} at most (at {most.setting})"
                + (f", {percent(last.error or 0.0)} at {last.setting}" if last != most else "")
            )
            missed += [row.label for row in found if _misses(row)]
    if not parts:
        return sentence()
    half = "half of the highlight is lost somewhere on the way by"
    lost = f"more than {half} {listed(missed)}" if missed else ""
    return sentence(
        "from frame to frame the peak of the highlight moves this much more or less than on the "
        f"sphere itself: {'; '.join(parts)}",
        lost,
    )


def _misses(row: Row) -> bool:
    """Whether the peak, which is about 0.6 on the sphere, is lost by half at some position."""
    return row.errors is not None and row.errors.more["peak off by"] > 0.3


EXPERIMENT = Experiment(
    "popping",
    "Popping",
    f"The camera orbits in steps of {STEP:g} degrees: how far does the brightest point of the "
    "highlight jump from frame to frame?",
    groups,
    finding,
    REFERENCE,
    error="max",
    error_label="largest false jump of the peak",
    show=("max", "rmse", "largest jump", "peak off by"),
)
