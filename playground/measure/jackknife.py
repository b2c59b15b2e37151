"""The jackknife: how far off a statistic is that follows from the mean of a few batches."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np


def jackknife(statistic: Callable[[Any], float], batches: Sequence[Any]) -> float:
    """The standard error that ``statistic`` of a mean has because the mean is of few batches.

    Source: Efron & Tibshirani, An Introduction to the Bootstrap, 1993, equation 11.5.
    """
    count = len(batches)
    total = np.sum(batches, axis=0)
    without = [statistic((total - batch) / (count - 1)) for batch in batches]
    return float(np.sqrt((count - 1) / count * np.sum(np.subtract(without, np.mean(without)) ** 2)))
