"""From raw samples to rows: medians with their spread, ratios, the Pareto front, slopes."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from math import comb
from typing import Any

import numpy as np

from playground.measure.journal import Journal
from playground.measure.record import Batch, Candidate, Errors, Experiment, Knobs

CHANCE = 0.05  # how often two equally fast candidates may be taken for different ones
BOUNDS = (0.01, 0.001)  # the errors for which the fastest candidate is named: 1 % and 0.1 %


@dataclass(frozen=True)
class Row:
    """One candidate: median, 10th and 90th percentile of its times, and its errors.

    ``rounds`` are the medians of each round, ``ratio`` the median ratio to another method in
    the same rounds; ``error`` is the one number that the experiment plots, None where
    there is no reference. ``front`` says that no candidate of the case is both
    as fast and as good.
    """

    case: str
    method: str
    knobs: Knobs
    median: float
    low: float
    high: float
    count: int
    rounds: tuple[float, ...]
    more: dict[str, float]
    errors: Errors | None = None
    error: float | None = None
    ratio: float | None = None
    front: bool = False

    @property
    def setting(self) -> str:
        """The knobs as text: ``tessellation 64``."""
        return ", ".join(f"{name} {value}" for name, value in self.knobs.items())

    @property
    def label(self) -> str:
        """Method and knobs as text."""
        return ", ".join(filter(None, (self.method, self.setting)))

    def to_dict(self) -> dict[str, Any]:
        """One flat record, for JSON and CSV."""
        flat: dict[str, Any] = {"case": self.case, "method": self.method, **self.knobs}
        flat |= {"median": self.median, "low": self.low, "high": self.high, "times": self.count}
        flat |= {"ratio": self.ratio, "front": self.front, **self.more}
        if self.errors is not None:
            numbers = self.errors.to_dict()
            flat |= numbers.pop("more")
            spread = numbers.pop("uncertainty")
            flat |= {k: v for k, v in numbers.items() if v is not None}
            flat |= {f"{name}_standard_error": value for name, value in spread.items()}
        return flat


def rows_of(experiment: Experiment, candidates: Iterable[Candidate], journal: Journal) -> list[Row]:
    """A row for each candidate that has been timed."""
    rows = []
    for candidate in candidates:
        batches = journal.batches(experiment.name, candidate)
        if any(batch.times for batch in batches.values()):
            errors = journal.errors(experiment.name, candidate)
            rows.append(_row(experiment, candidate, batches, errors))
    return with_front(_with_ratios(rows, experiment.ratio_to))


def _row(
    experiment: Experiment, candidate: Candidate, batches: dict[int, Batch], errors: Errors | None
) -> Row:
    numbers = sorted(batches)
    times = np.concatenate([batches[n].times for n in numbers])
    low, median, high = (float(x) for x in np.percentile(times, [10, 50, 90]))
    names = {name for batch in batches.values() for name in batch.more}
    return Row(
        candidate.case,
        candidate.method,
        candidate.knobs,
        median,
        low,
        high,
        len(times),
        tuple(float(np.median(batches[n].times)) for n in numbers),
        {
            name: float(np.median(np.concatenate([batches[n].more[name] for n in numbers])))
            for name in sorted(names)
        },
        errors,
        None if errors is None else float(getattr(errors, experiment.error)),
    )


def ratio(row: Row, base: Row) -> float:
    """The median over the rounds of one candidate's time over another's in the same round."""
    count = min(len(row.rounds), len(base.rounds))
    return float(np.median(np.divide(row.rounds[:count], base.rounds[:count])))


def difference(row: Row, base: Row) -> tuple[float, float, float]:
    """10 %, median, 90 % over the rounds of how much longer one takes than another."""
    count = min(len(row.rounds), len(base.rounds))
    low, middle, high = np.percentile(
        np.subtract(row.rounds[:count], base.rounds[:count]), [10, 50, 90]
    )
    return float(low), float(middle), float(high)


def told_apart(row: Row, base: Row) -> bool:
    """Whether one is faster than the other in so many rounds that chance is not to be blamed.

    The two-sided sign test at `CHANCE`: it asks for 6 rounds at least, and for all of them.
    """
    return on_one_side([a - b for a, b in zip(row.rounds, base.rounds, strict=False)])


def enough(row: Row) -> bool:
    """Whether it has been timed in so many rounds that `told_apart` can ever say yes."""
    return on_one_side([1.0] * len(row.rounds))


def on_one_side(differences: Sequence[float]) -> bool:
    """Whether so many have one sign that chance is not to be blamed: the test of `told_apart`."""
    signs = [np.sign(difference) for difference in differences]
    count = sum(sign != 0 for sign in signs)
    fewer = min(signs.count(1), signs.count(-1))
    likely = 2.0 * sum(comb(count, k) for k in range(fewer + 1)) / 2.0**count
    return bool(likely <= CHANCE)


def _with_ratios(rows: list[Row], method: str) -> list[Row]:
    bases = {row.case: row for row in rows if row.method == method}
    return [
        replace(row, ratio=ratio(row, bases[row.case])) if row.case in bases else row
        for row in rows
    ]


def with_front(rows: Sequence[Row]) -> list[Row]:
    """The rows, each told whether it is on the Pareto front of time and error of its case."""
    return [replace(row, front=_unbeaten(row, rows)) for row in rows]


def _unbeaten(row: Row, rows: Sequence[Row]) -> bool:
    if row.error is None:
        return False
    for other in rows:
        if other.case != row.case or other.error is None or other is row:
            continue
        as_good = other.median <= row.median and other.error <= row.error
        if as_good and (other.median < row.median or other.error < row.error):
            return False
    return True


def cases(rows: Iterable[Row]) -> list[str]:
    """The cases, in their order."""
    return list(dict.fromkeys(row.case for row in rows))


def fastest(rows: Iterable[Row], bound: float) -> list[Row]:
    """The fastest of the rows with an error up to ``bound``, then those as fast within its spread.

    The latter have a median below the 90th percentile of the fastest.
    """
    good = sorted(
        (row for row in rows if row.error is not None and row.error <= bound),
        key=lambda row: row.median,
    )
    return [row for row in good if row.median <= good[0].high]


def slope(rows: Iterable[Row], knob: str) -> float | None:
    """The p of error ~ knob^p, fitted to the logarithms; None for fewer than two rows."""
    points = [
        (float(row.knobs[knob]), row.error) for row in rows if knob in row.knobs and row.error
    ]
    if len({x for x, _ in points}) < 2:
        return None
    x, y = np.log(np.array(points)).T
    return float(np.polyfit(x, y, 1)[0])
