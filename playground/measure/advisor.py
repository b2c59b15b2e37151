"""The advisor: what each part of a setup contributes to the picture, what it costs, what to drop.

An ablation: each candidate is left out alone, and the picture without it is compared with
the full one. Then candidates are dropped together, the best ones first, as long as the
picture of all of them together stays within the budget: errors do not add.
"""

from __future__ import annotations

from collections.abc import Callable, Generator
from contextlib import ExitStack, closing
from dataclasses import dataclass, replace
from functools import partial
from math import isfinite
from typing import Any, TypeVar

from playground.errors import PlaygroundError, unknown_name
from playground.measure.advice import METRICS, Advice, Errors, Finding, error_of, errors_of
from playground.measure.candidates import ONLY, Candidate, candidates_of, without
from playground.measure.paired import Cost, Stopwatch, paired
from playground.render.checks import check_setup
from playground.render.image import Image
from playground.render.renderer import STORED, Renderer, open_renderer
from playground.scene.setup import Setup
from playground.steps import finished, retold

SIZE = (640, 480)
FIRST = 0.05  # of the progress: how far two times of one setup are apart
LAST = 0.1  # choosing, and measuring the proposal
Result = TypeVar("Result")


@dataclass(frozen=True)
class Progress:
    """How far the advisor has come: the share that is done, what it does, what it has found."""

    share: float
    doing: str
    findings: tuple[Finding, ...] = ()


Steps = Generator[Progress, None, Result]


def advise(
    setup: Setup,
    budget: float = 0.01,
    metric: str = "rmse",
    watch: Callable[[Progress], object] | None = None,
    **more: Any,
) -> Advice:
    """The advice for ``setup``, when `advising`, which takes the same, has come to its end.

    ``watch`` is called with the progress after every picture or two.
    """
    return finished(advising(setup, budget, metric, **more), watch)


def advising(
    setup: Setup,
    budget: float = 0.01,
    metric: str = "rmse",
    size: tuple[int, int] = SIZE,
    renderer: str = "auto",
    context: Any = None,
    cost: Cost | None = None,
    flip: bool = True,
    method: str = "raster",
) -> Steps[Advice]:
    """Measure ``setup`` and propose what to drop; yields after every picture or two.

    Parameters
    ----------
    setup : Setup
    budget : float
        The largest error of the proposal's picture, above 0.
    metric : {"rmse", "flip", "max"}
        What the error is: of the pictures as shown, in [0, 1].
    size : (int, int)
        Of the pictures, in pixels.
    renderer : {"auto", "gl", "numpy"}
    context : of a window, to draw in
    cost : function, optional
        Milliseconds that one picture of a setup takes; by default it is drawn and timed.
    flip : bool
        Whether FLIP is measured, too, where it is not the metric.
    method : {"raster", "ray-tracing"}
        How the pictures are made; it decides what there is to drop.

    Returns
    -------
    Advice
        As the value of the generator, when it ends.

    Raises
    ------
    PlaygroundError
        A budget that is no number above 0, an unknown metric, and what a renderer refuses.
    """
    _check(setup, budget, metric, method)
    with ExitStack() as held:
        drawn = held.enter_context(open_renderer(size, renderer, context, method))
        size = drawn.size
        warm = 0
        if cost is None:
            cost = held.enter_context(closing(Stopwatch(size, drawn.name, context, method)))
            warm = _warm(drawn.name)
        full = _picture(drawn, setup)
        compared = partial(errors_of, full, flip=flip or metric == "flip")
        control = yield from retold(
            paired(cost, setup, replace(setup), warm),
            lambda share: Progress(FIRST * share, "the setup against itself"),
        )
        candidates = candidates_of(setup, method)
        findings = yield from _findings(
            setup, candidates, drawn, compared, cost, warm, control.spread
        )
        chosen = yield from _chosen(setup, drawn, full, findings, budget, metric)
        advice = Advice(setup, setup, size, drawn.name, metric, budget, findings)
        if not chosen:
            return advice

        # What the proposal really costs and saves is measured on all of it together.
        proposed = without(setup, [finding.candidate for finding in chosen])
        errors = compared(_picture(drawn, proposed))
        timing = paired(cost, setup, proposed, warm, control.spread)
        saving = yield from retold(
            timing, lambda share: Progress(1 - (1 - share) * LAST / 2, "the proposal", findings)
        )
        if saving.saved <= 0.0:
            return replace(advice, refuted=chosen)
        return Advice(
            setup, proposed, size, drawn.name, metric, budget, findings, chosen, errors, saving
        )


def _findings(
    setup: Setup,
    candidates: tuple[Candidate, ...],
    drawn: Renderer,
    compared: Callable[[Image], Errors],
    cost: Cost,
    warm: int,
    floor: float,
) -> Steps[tuple[Finding, ...]]:
    """Each candidate left out alone: the errors, and the time that it saves."""
    findings: list[Finding] = []
    for number, candidate in enumerate(candidates):

        def told(share: float, number: int = number, candidate: Candidate = candidate) -> Progress:
            done = (number + share) / len(candidates)
            return Progress(FIRST + (1 - FIRST - LAST) * done, candidate.name, tuple(findings))

        yield told(0.0)
        changed = candidate.change(setup)
        picture = _picture(drawn, changed)
        yield told(0.0)
        errors = compared(picture)
        saving = yield from retold(paired(cost, setup, changed, warm, floor), told)
        findings.append(Finding(candidate, errors, saving))
    return tuple(findings)


def _chosen(
    setup: Setup,
    drawn: Renderer,
    full: Image,
    findings: tuple[Finding, ...],
    budget: float,
    metric: str,
) -> Steps[tuple[Finding, ...]]:
    """What to drop: in the order of milliseconds per error, whatever still fits the budget.

    The greedy choice of a knapsack (Dantzig, Discrete-variable extremum problems, 1957),
    with every content weighed as a whole. Of candidates that exclude each other, a later
    one takes the place of an earlier one if it saves more and fits.
    """
    useful = [finding for finding in findings if finding.saving.saved > 0.0]
    useful.sort(key=lambda finding: (-finding.worth(metric), -finding.saving.saved))
    chosen: tuple[Finding, ...] = ()
    for number, finding in enumerate(useful):
        yield Progress(1 - LAST * (1 - number / len(useful) / 2), "choosing", findings)
        rivals = [f for f in chosen if f.candidate.part == finding.candidate.part]
        if any(rival.saving.saved >= finding.saving.saved for rival in rivals):
            continue
        tried = (*(f for f in chosen if f not in rivals), finding)
        less = without(setup, [f.candidate for f in tried])
        if error_of(metric, full, _picture(drawn, less)) <= budget:
            chosen = tried
    return chosen


def _picture(drawn: Renderer, setup: Setup) -> Image:
    image = drawn.render(setup)
    assert isinstance(image, Image)
    return image


def _warm(renderer: str) -> int:
    """Pairs until a renderer draws as fast as it ever will."""
    if renderer != "gl":
        return 1
    from playground.render.gl.renderer import STEADY

    return STEADY + 2


def _check(setup: Setup, budget: object, metric: str, method: str) -> None:
    check_setup(setup)
    number = isinstance(budget, (int, float)) and not isinstance(budget, bool)
    if not number or not (isfinite(budget) and budget > 0.0):  # type: ignore[arg-type, operator]
        raise PlaygroundError(
            "the error budget is not valid",
            got=budget,
            allowed="a number above 0: of the picture as shown, in [0, 1]",
            fix="Try 0.01.",
        )
    if metric not in METRICS:
        raise unknown_name("metric", metric, METRICS)
    if method in STORED:
        raise PlaygroundError(
            "the advisor measures what is drawn anew for every picture, not stored light",
            got=method,
            allowed=", ".join(ONLY),
        )
    if method not in ONLY:
        raise unknown_name("method", method, ONLY)
