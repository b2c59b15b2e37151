"""Timing frames and judging pictures: what most experiments share."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from playground.measure import metrics
from playground.measure.record import Batch, Errors, Timer
from playground.render.image import Image
from playground.render.renderer import open_renderer
from playground.scene.setup import Setup
from playground.shading.display import code8

WARM_UP = 12  # frames: enough for a still scene to get its constants built in
ROUND_MS, MOST = 10.0, 12  # a round of a candidate lasts about this long, or this many frames


def timed(work: Callable[[], Any], count: int) -> list[float]:
    """Milliseconds of each of ``count`` calls."""
    times = []
    for _ in range(count):
        start = time.perf_counter()
        work()
        times.append(1e3 * (time.perf_counter() - start))
    return times


def rounds_of(work: Callable[[], Any], warm_up: int = WARM_UP) -> Timer:
    """A timer whose rounds hold as many calls as fit in `ROUND_MS`, at least one."""
    last = timed(work, warm_up)[-1]
    count = int(np.clip(ROUND_MS / last, 1, MOST))
    return lambda: Batch(timed(work, count))


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


def picture(
    setup: Setup, size: tuple[int, int], renderer: str = "gl", method: str = "raster"
) -> Image:
    """One picture in linear light."""
    with open_renderer(size, renderer, method=method) as drawn:
        image = drawn.render(setup)
    assert isinstance(image, Image)
    return image


def picture_errors(
    got: Image, want: Image, reference: str, covered: NDArray[np.bool_] | None = None
) -> Errors:
    """The errors of a picture against another.

    ``covered`` (H, W) says where the reference shows a surface; then only pixels that both
    cover are compared, except by FLIP, which sees the whole pictures. What is not finite counts as
    a screen shows it, black or full light, and is told in ``more``.
    """
    wild = ~np.isfinite(got.pixels).all(axis=-1)
    if wild.any():
        tame = np.nan_to_num(got.pixels, nan=0.0, posinf=1.0, neginf=0.0)
        got = replace(got, pixels=tame)
    left_out = None
    mask = np.ones(got.pixels.shape[:2], dtype=bool)
    if covered is not None:
        assert got.coverage is not None
        drawn = got.coverage > 0.5
        mask, left_out = drawn & covered, int((drawn ^ covered).sum())
    a, b = got.pixels[mask], want.pixels[mask]
    shown_got, shown_want = got.shown(), want.shown()
    codes = code8(shown_got[mask]).astype(int) - code8(shown_want[mask])
    return Errors(
        rmse=metrics.rmse(a, b),
        max=metrics.largest(a, b),
        mean=float(np.mean(np.abs(np.subtract(a, b, dtype=np.float64)))),
        reference=reference,
        flip=float(np.mean(metrics.flip_map(shown_want, shown_got))),
        off=float((np.abs(codes).max(axis=-1) > 1).mean()),
        left_out=left_out,
        more={"pixels not finite": float(wild.sum())} if wild.any() else {},
    )


def jackknife(statistic: Callable[[Any], float], batches: Sequence[Any]) -> float:
    """The standard error that ``statistic`` of a mean has because the mean is of few batches.

    Source: Efron & Tibshirani, An Introduction to the Bootstrap, 1993, equation 11.5.
    """
    count = len(batches)
    total = np.sum(batches, axis=0)
    without = [statistic((total - batch) / (count - 1)) for batch in batches]
    return float(np.sqrt((count - 1) / count * np.sum(np.subtract(without, np.mean(without)) ** 2)))
