"""A logarithmic axis: how far it reaches around its values, and where it has ticks."""

from __future__ import annotations

from collections.abc import Iterable
from math import ceil, floor, log10

SHORTEST = 1.2  # decades
MARGIN = 0.12  # of the length, beyond the outermost values
FEW = 2.5  # decades: a shorter axis has ticks at 1, 2 and 5, a longer one at 1


def limits(values: Iterable[float]) -> tuple[float, float]:
    """The ends of an axis for positive ``values``, with a margin on both sides."""
    logs = [log10(value) for value in values]
    low, high = min(logs), max(logs)
    spare = max(MARGIN * (high - low), 0.5 * (SHORTEST - (high - low)))
    return 10.0 ** (low - spare), 10.0 ** (high + spare)


def ticks(low: float, high: float) -> list[float]:
    """Round numbers from ``low`` to ``high``: decades, and 2 and 5 between them if few."""
    steps = (1, 2, 5) if log10(high / low) < FEW else (1,)
    decades = range(floor(log10(low)), ceil(log10(high)) + 1)
    every = (float(f"{step}e{decade}") for decade in decades for step in steps)
    return [tick for tick in every if low <= tick <= high]
