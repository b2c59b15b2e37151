"""The closed forms of a shining polygon against sums over samples of it, in NumPy."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import ExitStack
from dataclasses import replace
from functools import lru_cache

import numpy as np

from playground.measure import area_samples as light
from playground.measure import metrics
from playground.measure.experiments.sentences import of, sentence, times
from playground.measure.record import Batch, Candidate, Errors, Experiment, Timer
from playground.measure.rows import Row, cases, ratio, slope
from playground.measure.timing import rounds_of
from playground.percent import percent
from playground.shading.area_light import form_factor, lobe_integral
from playground.shading.vector import Array

SIZE, QUICK_SIZE = (48, 36), (32, 24)  # points of the floor
SAMPLES, QUICK_SAMPLES = (1, 4, 16, 64, 256, 1024), (1, 16, 256)
RUNS = 10  # independent ones: their mean error, with the standard error of this mean
SHININESS = 20.0
CASES = ("form factor", f"highlight, shininess {SHININESS:g}")
SEED = 7
CLOSED = "closed form"
REFERENCE = f"Gauss's quadrature with {light.GAUSS}² points in float64"
Work = Callable[[np.random.Generator], Array]


def groups(quick: bool) -> Iterator[list[Candidate]]:
    """The closed form and both kinds of sampling with more and more samples, in turn."""
    size = QUICK_SIZE if quick else SIZE
    for case in CASES:
        found = [_candidate(CLOSED, {}, case, size, lambda _, c=case: _closed(c, size))]  # type: ignore[misc]
        for count in QUICK_SAMPLES if quick else SAMPLES:
            for method in ("uniform", "stratified"):
                found.append(
                    _candidate(
                        f"{method} samples", {"samples": count}, case, size,
                        _sampling(case, size, count, method == "stratified"),
                    )
                )  # fmt: skip
        yield found


def _closed(case: str, size: tuple[int, int]) -> Array:
    points = light.floor(size)
    up = np.broadcast_to(light.UP, points.shape)
    if case == CASES[0]:
        return form_factor(points, up, light.CORNERS, False)
    return lobe_integral(points, light.mirror_axes(points), light.CORNERS, SHININESS, False)


def _integrand(case: str, points: Array) -> light.Integrand:
    return light.diffuse(points) if case == CASES[0] else light.highlight(points, SHININESS)


def _sampling(case: str, size: tuple[int, int], count: int, stratified: bool) -> Work:
    points = light.floor(size)
    integrand = _integrand(case, points)
    return lambda rng: light.sampled(points, integrand, count, stratified, rng)


@lru_cache(maxsize=4)
def reference(case: str, size: tuple[int, int]) -> Array:
    """The converged integral at every point of a floor of this size, (H, W)."""
    points = light.floor(size)
    rows = [light.converged(row, _integrand(case, row)) for row in points]
    return np.stack(rows)


def _candidate(
    method: str, knobs: dict[str, int], case: str, size: tuple[int, int], work: Work
) -> Candidate:
    def opened(_: ExitStack) -> Timer:
        rng = np.random.default_rng(SEED)
        timer = rounds_of(lambda: work(rng), 1)

        def batch() -> Batch:
            found = timer()
            return replace(found, times=[1e6 * t / (size[0] * size[1]) for t in found.times])

        return batch

    def errors() -> Errors:
        rng = np.random.default_rng(SEED)
        runs = [work(rng) for _ in range(RUNS if knobs else 1)]
        return judged(runs, reference(case, size))

    return Candidate(method, knobs, opened, errors, case)


def judged(runs: list[Array], want: Array) -> Errors:
    """The mean errors of independent runs, as shares of the root mean square of ``want``."""
    scale = float(np.sqrt(np.mean(want * want)))
    brightest = float(want.max())
    shown = np.repeat((want / brightest)[..., None], 3, axis=-1)
    found: dict[str, list[float]] = {"rmse": [], "max": [], "mean": [], "flip": []}
    for run in runs:
        found["rmse"].append(metrics.rmse(run, want) / scale)
        found["max"].append(metrics.largest(run, want) / scale)
        found["mean"].append(float(np.mean(np.abs(run - want))) / scale)
        got = np.repeat(np.clip(run / brightest, 0.0, 1.0)[..., None], 3, axis=-1)
        found["flip"].append(float(np.mean(metrics.flip_map(shown, got))))
    spread = {
        name: float(np.std(values, ddof=1) / np.sqrt(len(values)))
        for name, values in found.items()
        if len(values) > 1
    }
    rmse, worst, mean, flip = (float(np.mean(values)) for values in found.values())
    return Errors(rmse, worst, mean, REFERENCE, flip, uncertainty=spread)


def finding(rows: list[Row]) -> str:
    """How many samples the time of the closed form would pay for, and how their errors fall."""
    parts = []
    for case in cases(rows):
        here = [row for row in rows if row.case == case]
        closed = of(here, CLOSED)
        if closed and closed[0].error is not None:
            parts.append(_beside(case, closed[0], here))
    return sentence(*parts)


def _beside(case: str, closed: Row, here: list[Row]) -> str:
    words = f"{case}: the closed form is off by {percent(closed.error or 0.0)}"
    for method in ("uniform samples", "stratified samples"):
        found = sorted(of(here, method), key=lambda row: row.median)
        cheap = [row for row in found if row.median <= closed.median]
        power = slope(found, "samples")
        if cheap:
            best = cheap[-1]
            words += (
                f"; in its time fit {best.knobs['samples']} {method}, "
                f"off by {percent(best.error or 0.0)}"
            )
        elif found:
            words += (
                f"; {found[0].knobs['samples']} {method} take "
                f"{times(ratio(found[0], closed))} its time"
            )
        if power is not None:
            words += f", falling as their number to the power {power:.2f}"
    return words


EXPERIMENT = Experiment(
    "area-light",
    "Area light",
    "A square lights a floor: how many samples of it is a closed form worth? (No shadows.)",
    groups,
    finding,
    f"{REFERENCE}; samples: the mean of {RUNS} runs",
    error_label="RMSE, as a share of the root mean square",
    time_label="ns per point",
    needs_gl=False,
    show=("rmse", "max", "flip"),
)
