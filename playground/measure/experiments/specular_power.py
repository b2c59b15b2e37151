"""Ways to compute the power of the highlight, in GLSL and in NumPy."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack, closing
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from playground.measure import metrics
from playground.measure.experiments.sentences import listed, of, reach, sentence, times
from playground.measure.power_methods import Method, exact, methods, normals
from playground.measure.power_pass import PowerPass
from playground.measure.record import Batch, Candidate, Errors, Experiment, Timer
from playground.measure.rows import Row, cases, ratio
from playground.measure.timing import rounds_of
from playground.percent import percent

SHININESS, QUICK_SHININESS = (5, 20, 80, 1000), (20,)
SIZES, QUICK_SIZES = (16, 64, 256, 1024, 4096), (16, 256)
LANGUAGES = ("GLSL", "NumPy")
SIDE, QUICK_SIDE = 256, 128
EVALUATIONS = 32  # at every pixel of a timed pass
REFERENCE = "max(r·v, 0)^sh in float64"


def groups(quick: bool) -> Iterator[list[Candidate]]:
    """Every method at one shininess in one language, in turn."""
    side = QUICK_SIDE if quick else SIDE
    for shininess in QUICK_SHININESS if quick else SHININESS:
        found = methods(shininess, QUICK_SIZES if quick else SIZES)
        for language in LANGUAGES:
            case = f"{language}, shininess {shininess}"
            yield [_candidate(m, language, case, shininess, side) for m in found]


def _candidate(method: Method, language: str, case: str, shininess: int, side: int) -> Candidate:
    def glsl(stack: ExitStack) -> Timer:
        drawn = stack.enter_context(closing(PowerPass(method, side)))
        return _per_evaluation(rounds_of(lambda: drawn.run(EVALUATIONS)), EVALUATIONS * side**2)

    def numpy(_: ExitStack) -> Timer:
        points = normals(side)
        return _per_evaluation(rounds_of(lambda: method.numpy(points), 1), side**2)

    def errors() -> Errors:
        if language == "NumPy":
            return _errors(method.numpy(normals(side)), exact(normals(side), shininess))
        with closing(PowerPass(method, side)) as drawn:
            return _errors(drawn.values(), exact(normals(side), shininess))

    knobs = {"texels": method.texels} if method.texels else {}
    return Candidate(method.name, knobs, glsl if language == "GLSL" else numpy, errors, case)


def _per_evaluation(timer: Timer, count: int) -> Timer:
    """Nanoseconds of one evaluation, from milliseconds of ``count``."""

    def batch() -> Batch:
        found = timer()
        return replace(found, times=[1e6 * time / count for time in found.times])

    return batch


def _errors(got: ArrayLike, want: ArrayLike) -> Errors:
    difference = np.abs(np.subtract(got, want, dtype=np.float64))
    shown = [np.repeat(np.clip(x, 0.0, 1.0)[..., None], 3, axis=-1) for x in (want, got)]
    return Errors(
        rmse=metrics.rmse(got, want),
        max=float(difference.max()),
        mean=float(difference.mean()),
        reference=REFERENCE,
        flip=float(np.mean(metrics.flip_map(*shown))),
        off=float((difference > 1.0 / 255.0).mean()),
    )


def finding(rows: list[Row]) -> str:
    """In each language what pow costs beside the fastest within 1 %, and Schlick's errors."""
    parts = []
    for language in LANGUAGES:
        here = [row for row in rows if row.case.startswith(language)]
        beside = [_beside([row for row in here if row.case == case]) for case in cases(here)]
        words = [
            f"{case.split()[-1]}: {text}"
            for case, text in zip(cases(here), beside, strict=True)
            if text
        ]
        if words:
            parts.append(
                f"{language}, pow beside the fastest within 1 %, at shininess {listed(words)}"
            )
    wrong = [row.error for row in of(rows, "Schlick") if row.error is not None]
    if wrong:
        least, most = percent(min(wrong)), percent(max(wrong))
        range_ = least if least == most else f"{least} to {most}"
        parts.append(f"Schlick's form is off by up to {range_}")
    return sentence(*parts)


def _beside(here: list[Row]) -> str:
    power, best = of(here, "pow"), reach(here, 0.01)
    if not power or best is None:
        return ""
    if best == power[0]:
        return "it is the fastest"
    return f"{times(ratio(power[0], best))} as long as {best.label}"


EXPERIMENT = Experiment(
    "specular-power",
    "Specular power",
    "The highlight is a cosine to the power of the shininess: what is gained by computing it "
    "another way, and what is lost? (Light and viewer are far away; the vectors are paid for.)",
    groups,
    finding,
    REFERENCE,
    error="max",
    error_label="largest error of the highlight",
    time_label="ns per evaluation",
    show=("max", "rmse", "flip", "off"),
)
