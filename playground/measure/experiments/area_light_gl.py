"""The closed forms of a shining polygon against sums over samples of it, in GLSL."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack, closing
from dataclasses import replace

import numpy as np

from playground.measure.area_pass import AreaPass
from playground.measure.experiments.area_light import (
    CASES,
    CLOSED,
    QUICK_SAMPLES,
    QUICK_SIZE,
    REFERENCE,
    RUNS,
    SAMPLES,
    SHININESS,
    SIZE,
    finding,
    judged,
    reference,
)
from playground.measure.record import Batch, Candidate, Errors, Experiment, Timer
from playground.measure.timing import rounds_of

INTEGRALS = dict(zip(CASES, ("diffuse", "highlight"), strict=True))
EVALUATIONS = 2048  # of a timed pass at every point, shared out among the samples


def groups(quick: bool) -> Iterator[list[Candidate]]:
    """The closed form and both kinds of sampling with more and more samples, in turn."""
    size = QUICK_SIZE if quick else SIZE
    for case in CASES:
        found = [_candidate(CLOSED, 0, case, size)]
        for count in QUICK_SAMPLES if quick else SAMPLES:
            found += [
                _candidate(f"{m} samples", count, case, size) for m in ("uniform", "stratified")
            ]
        yield found


def _candidate(method: str, count: int, case: str, size: tuple[int, int]) -> Candidate:
    def drawn(stack: ExitStack) -> AreaPass:
        kind = method.split()[0]
        opened = AreaPass(INTEGRALS[case], kind, count, SHININESS, size)
        return stack.enter_context(closing(opened))

    def opened(stack: ExitStack) -> Timer:
        shown, evaluations = drawn(stack), EVALUATIONS // max(count, 32)
        timer = rounds_of(lambda: shown.run(evaluations))

        def batch() -> Batch:
            found = timer()
            points = evaluations * size[0] * size[1]
            return replace(found, times=[1e6 * t / points for t in found.times])

        return batch

    def errors() -> Errors:
        with ExitStack() as stack:
            shown = drawn(stack)
            runs = [shown.values(seed).astype(np.float64) for seed in range(RUNS if count else 1)]
        return judged(runs, reference(case, size))

    return Candidate(method, {"samples": count} if count else {}, opened, errors, case)


EXPERIMENT = Experiment(
    "area-light-gl",
    "Area light on the GPU",
    "The same square and floor in GLSL and float32: how many samples is a closed form worth there?",
    groups,
    finding,
    f"{REFERENCE}; samples: the mean of {RUNS} runs",
    error_label="RMSE, as a share of the root mean square",
    time_label="ns per point",
    show=("rmse", "max", "flip"),
)
