"""The measuring behind "Speed and error": a few draws in every frame, the reference aside."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from statistics import median
from time import perf_counter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from playground.gui.aside import Aside
from playground.gui.driver import software
from playground.gui.speed_log import Dot, SpeedLog, key_of
from playground.gui.texture_target import TextureTarget
from playground.measure.metrics import largest, rmse
from playground.render.gl.renderer import STEADY, GLRenderer
from playground.render.image import Image
from playground.render.renderer import open_renderer
from playground.scene.setup import Setup

BUDGET = 0.008  # seconds of every frame; at least one draw is made
DRAWN_SIZE = (640, 480)  # of the frames that are timed
COMPARED_SIZE = (320, 240)  # of the pictures whose error is taken
WARM, TIMED = STEADY + 4, 21  # draws before, and draws that count


class SpeedRun:
    """Measures what a `SpeedLog` asks for; `advance` is called once a frame."""

    def __init__(self, context: Any) -> None:
        self._context = context
        self._of: Setup | None = None
        self._times: Iterator[tuple[float, float] | None] = iter(())
        self._taken: list[tuple[float, float]] = []
        self._exact: Aside[NDArray[np.float32]] | None = None

    def advance(self, log: SpeedLog) -> SpeedLog:
        """The log with what this frame has added."""
        if log.of is None:
            self.stop()
            return log
        if log.of is not self._of:
            self.stop()
            self._start(log.of)
        assert self._exact is not None
        try:
            timed = self._draws()
            if self._exact.error is not None:
                raise self._exact.error
            exact = self._exact.take() if timed else ()
            dot = self._dot(log.of, exact[0]) if exact else None
        except Exception as error:  # a mesh that is gone, a shader that does not compile
            self.stop()
            return replace(log, of=None, error=str(error), automatic=False)
        if dot is None:
            return log
        self.stop()
        return log.with_dot(dot)

    def _start(self, setup: Setup) -> None:
        self._of, self._taken = setup, []
        self._times = times(setup, self._context)
        self._exact = Aside(_reference(setup))

    def _draws(self) -> bool:
        """Draw for a while; true when all is timed."""
        until = perf_counter() + BUDGET
        for pair in self._times:
            if pair is not None:
                self._taken.append(pair)
            if perf_counter() > until:
                return False
        return True

    def _dot(self, setup: Setup, exact: NDArray[np.float32]) -> Dot:
        with open_renderer(COMPARED_SIZE, "gl", self._context) as renderer:
            image = renderer.render(setup.with_(samples=1))
        assert isinstance(image, Image)
        gpu, wall = (median(column) for column in zip(*self._taken, strict=True))
        error = rmse(image.pixels, exact), largest(image.pixels, exact)
        clock = None if software(self._context) else gpu
        return Dot(*key_of(setup), clock, wall, *error)

    def stop(self) -> None:
        """Let go of what was being measured."""
        close = getattr(self._times, "close", None)
        if close is not None:
            close()
        if self._exact is not None:
            self._exact.stop()
        self._of, self._exact, self._times = None, None, iter(())

    def close(self) -> None:
        """Stop and free the GPU memory, while the context is still there."""
        exact = self._exact
        self.stop()
        if exact is not None:
            exact.close()


def times(setup: Setup, context: Any) -> Iterator[tuple[float, float] | None]:
    """Milliseconds of GPU and clock of each draw that counts; None while warming up."""
    query = context.query(time=True)
    target = TextureTarget(context, DRAWN_SIZE, 1)
    setup = setup.with_(samples=1)
    try:
        with GLRenderer(DRAWN_SIZE, context) as renderer:
            for i in range(WARM + TIMED):
                began = perf_counter()
                with query:
                    renderer.draw(setup, target)
                    target.resolve()
                context.finish()
                wall = 1e3 * (perf_counter() - began)
                yield (query.elapsed * 1e-6, wall) if i >= WARM else None
    finally:
        target.release()


def _reference(setup: Setup) -> Iterator[NDArray[np.float32]]:
    right = setup.with_(shading="per-fragment", bugs=(), samples=1)
    with open_renderer(COMPARED_SIZE, "numpy") as renderer:
        image = renderer.render(right)
    assert isinstance(image, Image)
    yield image.pixels
