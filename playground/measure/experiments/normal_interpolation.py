"""What the normalisation of the interpolated normal costs, and what leaving it out."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from playground.measure.experiments.sentences import of, sentence, signed, times
from playground.measure.experiments.spheres import (
    QUICK_SIZE,
    REFERENCE,
    SIZE,
    exact_sphere,
    sphere,
)
from playground.measure.pictures import picture, picture_errors
from playground.measure.record import Candidate, Errors, Experiment
from playground.measure.rows import Row, on_one_side
from playground.measure.timing import frames_of

METHODS = {"renormalised": (), "not renormalised": ("normal-not-renormalised",)}
TESSELLATIONS = (8, 16, 32, 64, 128, 256)
QUICK = (8, 32, 128)


def groups(quick: bool) -> Iterator[list[Candidate]]:
    """With and without, at every tessellation, all in turn."""
    size = QUICK_SIZE if quick else SIZE
    tessellations = QUICK if quick else TESSELLATIONS
    yield [_candidate(m, t, size) for t in tessellations for m in METHODS]


def _candidate(method: str, tessellation: int, size: tuple[int, int]) -> Candidate:
    setup = sphere(tessellation).with_(bugs=METHODS[method])

    def errors() -> Errors:
        exact = exact_sphere(size)
        return picture_errors(picture(setup, size), exact.image, REFERENCE, exact.covered)

    knobs = {"tessellation": tessellation}
    return Candidate(method, knobs, frames_of(setup, size), errors)


def finding(rows: list[Row]) -> str:
    """What leaving it out does to the error, and what doing it does to the time."""
    losses, prices = [], []  # prices: by tessellation, of each round
    for with_it in of(rows, "renormalised"):
        without = of(rows, "not renormalised", **with_it.knobs)
        if without:
            base = without[0]
            pairs = zip(with_it.rounds, base.rounds, strict=False)
            prices.append([taken / before - 1.0 for taken, before in pairs])
            if with_it.error and base.error is not None:
                losses.append(f"{times(base.error / with_it.error)} at {with_it.setting}")
    if not losses:
        return sentence()
    low, middle, high = np.percentile(np.concatenate(prices), [10, 50, 90])
    rounds = [float(np.median(prices_of)) for prices_of in zip(*prices, strict=False)]
    told = "" if on_one_side(rounds) else ", which is not told apart from nothing"
    return sentence(
        f"without making the normal unit length again the error is {', '.join(losses)} as large",
        f"making it so changes the time by {signed(middle)} "
        f"(10 % to 90 % of the rounds: {signed(low)} to {signed(high)}){told}",
    )


EXPERIMENT = Experiment(
    "normal-interpolation",
    "Normal interpolation",
    "An interpolated normal is too short: what does it cost to make it unit length again, and "
    "what is lost without?",
    groups,
    finding,
    REFERENCE,
    show=("rmse", "max", "flip", "off", "left_out"),
)
