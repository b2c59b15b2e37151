"""The clock of the experiments: calls, rounds of calls, and frames of a renderer."""

from __future__ import annotations

import time
from collections.abc import Callable
from contextlib import ExitStack
from typing import Any

import numpy as np

from playground.measure.record import Batch, Timer
from playground.render.renderer import open_renderer
from playground.scene.setup import Setup

WARM_UP = 12  # frames: enough for a still scene to get its constants built in
ROUND_MS, MOST = 10.0, 12  # a round of a candidate lasts about this long, or this many calls


def timed(work: Callable[[], Any], count: int) -> list[float]:
    """Milliseconds of each of ``count`` calls."""
    times = []
    for _ in range(count):
        start = time.perf_counter()
        work()
        times.append(1e3 * (time.perf_counter() - start))
    return times


def rounds_of(work: Callable[[], Any], warm_up: int = WARM_UP, parts: int = 1) -> Timer:
    """A timer whose rounds hold as many calls as fit in `ROUND_MS`, at least one.

    Its milliseconds are those of one of the equal ``parts`` that a call does.
    """
    last = timed(work, warm_up)[-1]
    count = int(np.clip(ROUND_MS / last, 1, MOST))
    return lambda: Batch([each / parts for each in timed(work, count)])


def frames_of(
    setup: Setup, size: tuple[int, int], renderer: str = "gl", method: str = "raster"
) -> Callable[[ExitStack], Timer]:
    """Opens a renderer of its own and times frames of 8-bit RGBA read into an array."""

    def opened(stack: ExitStack) -> Timer:
        drawn = stack.enter_context(open_renderer(size, renderer, method=method))
        codes = np.empty((size[1], size[0], 4), np.uint8)
        warm_up = WARM_UP if renderer == "gl" else 1
        return rounds_of(lambda: drawn.render(setup, out=codes), warm_up)

    return opened
