"""What a change of the setup saves: both drawn in turn, and the median of the differences.

Machines grow warm and neighbours wake up; two pictures drawn one right after the other
suffer the same, so that their difference says more than two means would. What is left is
where in memory a renderer's buffers happen to lie (Mytkowicz et al., Producing wrong data
without doing anything obviously wrong, 2009): a setup timed against itself shows how much.
"""

from __future__ import annotations

from collections.abc import Callable, Generator
from dataclasses import dataclass
from itertools import count
from math import comb
from statistics import median
from time import perf_counter
from typing import Any

import numpy as np

from playground.render.renderer import Renderer, open_renderer
from playground.scene.setup import Setup

Cost = Callable[[Setup], float]  # milliseconds that one picture of a setup takes

# At most: a neighbour who wakes up spoils few of many; at least: the fewest that allow `DOUBT`.
PAIRS, FEWEST = 51, 8
PATIENCE = 1000.0  # milliseconds of drawing after which the fewest pairs are enough
DOUBT = 0.01  # chance that the interval of a saving misses the true median


@dataclass(frozen=True)
class Saving:
    """Milliseconds per picture: with everything, without, and the median of the differences.

    ``low`` and ``high`` hold the true median with a probability of 1 − `DOUBT`. ``floor`` is
    what the full setup seemed to save against itself.
    """

    full: float
    without: float
    median: float
    low: float
    high: float
    floor: float = 0.0

    @property
    def saved(self) -> float:
        """The median, or 0 where the noise does not tell it from none; below 0 for a loss."""
        unsure = self.low <= 0.0 <= self.high or abs(self.median) <= self.floor
        return 0.0 if unsure else self.median

    @property
    def spread(self) -> float:
        """The end of the interval that lies farther from 0."""
        return max(abs(self.low), abs(self.high))

    def __str__(self) -> str:
        """The saving with its interval, or that there is none."""
        if self.saved == 0.0:
            return "none"
        return f"{self.saved:.3g} ({self.low:.3g}, {self.high:.3g})"


def paired(
    cost: Cost, full: Setup, other: Setup, warm: int = 0, floor: float = 0.0
) -> Generator[float, None, Saving]:
    """Time both in turn; yields the share that is done, returns the `Saving`.

    ``warm`` pairs come first and do not count: compilers and caches get ready.
    """
    pairs: list[tuple[float, float]] = []
    for i in range(warm):
        for setup in (full, other):
            cost(setup)
            yield i / (warm + PAIRS)
    while len(pairs) < PAIRS:
        if len(pairs) % 2 == 0:
            pairs.append((cost(full), cost(other)))
        else:  # the other one first: who draws first may be at an advantage
            second = cost(other)
            pairs.append((cost(full), second))
        yield (warm + len(pairs)) / (warm + PAIRS)
        if len(pairs) >= FEWEST and sum(map(sum, pairs)) > PATIENCE:
            break
    return saving_of(pairs, floor)


def saving_of(pairs: list[tuple[float, float]], floor: float = 0.0) -> Saving:
    """The saving that pairs of times (with everything, without) show.

    The interval of the median lies between two of the sorted differences, whatever their
    distribution: the k-th smallest misses it with the chance that of n fair coins fewer
    than k show heads. Source: Thompson, On confidence ranges for the median, 1936.

    Parameters
    ----------
    pairs : milliseconds, at least `FEWEST`
    """
    differences = sorted(a - b for a, b in pairs)
    k = _rank(len(differences))
    full, without = (median(times) for times in zip(*pairs, strict=True))
    middle = median(differences)
    return Saving(full, without, middle, differences[k - 1], differences[-k], floor)


def _rank(pairs: int) -> int:
    """The largest k for which both ends together miss with a chance of at most `DOUBT`."""
    missed = 0
    for k in count():
        missed += comb(pairs, k)
        if 2 * missed > DOUBT * 2**pairs:
            return k
    raise AssertionError("the sum of all coins is 1")


class Stopwatch:
    """A `Cost` by the clock: draws 8-bit pictures with the project's own renderer.

    The two setups that were drawn last keep a renderer each: one that draws a scene again
    and again has made it as fast as it can.
    """

    def __init__(
        self,
        size: tuple[int, int],
        renderer: str = "auto",
        context: Any = None,
        method: str = "raster",
        clock: Callable[[], float] = perf_counter,
    ) -> None:
        self._arguments = (size, renderer, context, method)
        self._clock = clock
        self._codes = np.empty((size[1], size[0], 4), np.uint8)
        self._open: list[tuple[Setup, Renderer]] = []

    def __call__(self, setup: Setup) -> float:
        """Milliseconds from the call to the codes of one picture of ``setup``."""
        kept = [pair for pair in self._open if pair[0] is setup]
        others = [pair for pair in self._open if pair[0] is not setup]
        for _, old in others[:-1]:
            old.close()
        mine = kept[0] if kept else (setup, open_renderer(*self._arguments))
        self._open = [*others[-1:], mine]
        if (context := self._arguments[2]) is not None:
            context.finish()  # what the window has still to draw must not count
        began = self._clock()
        mine[1].render(setup, out=self._codes)
        return 1e3 * (self._clock() - began)

    def close(self) -> None:
        """Free what the renderers hold."""
        for _, renderer in self._open:
            renderer.close()
        self._open = []
