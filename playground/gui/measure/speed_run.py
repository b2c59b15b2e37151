"""The measuring behind "Speed and error": a few draws in every frame, then the reference aside."""

from __future__ import annotations

from dataclasses import replace
from statistics import median
from time import perf_counter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from playground.gui.measure.scope_path import Texts
from playground.gui.measure.speed_log import Dot, SpeedLog, key_of
from playground.gui.picture import reference_pieces
from playground.gui.picture.texture_target import TextureTarget
from playground.gui.work.long_work import LongWork, Piece, Pieces, Progress, part
from playground.gui.work.two_works import TwoWorks
from playground.measure.metrics import largest, rmse
from playground.render.gl.driver import software
from playground.render.gl.program import ShaderError
from playground.render.gl.renderer import STEADY, GLRenderer
from playground.render.image import Image
from playground.scene.setup import Setup

Times = tuple[float, float]  # milliseconds: of the GPU's own clock, and of the wall's
Pixels = NDArray[np.float32]
DRAWING = 0.5  # of the work, about; the rest is the reference
DRAWN_SIZE = (640, 480)  # of the frames that are timed
COMPARED_SIZE = (320, 240)  # of the pictures whose error is taken
WARM, TIMED = STEADY + 4, 21  # draws before, and draws that count


class SpeedRun(TwoWorks[Times | Image, Pixels]):
    """Measures what a `SpeedLog` asks for; `advance` is called once a frame."""

    def __init__(self, context: Any) -> None:
        super().__init__(context)
        self._found: list[Times | Image] = []

    def advance(self, log: SpeedLog) -> SpeedLog:
        """The log with what this frame has added."""
        if log.of is None:
            self.stop()
            return log
        if log.of is not self._of or self._drawn is None:
            self.stop()
            self._of, self._found = log.of, []
            self._drawn = LongWork(part(drawn(log.of, self._context, log.shaders), 0.0, DRAWING))
        try:
            self._found += self._drawn.take()
            exact = self._reference(log.of) if self._drawn.done else ()
        except Exception as error:  # a mesh that is gone, a shader that does not compile
            self.stop()
            return replace(log, of=None, error=str(error), automatic=False)
        if not exact:
            return replace(log, progress=self._progress(self._drawn))
        dot = self._dot(log, exact[0])
        self.stop()
        return log.with_dot(dot)

    def _progress(self, drawn: LongWork[Times | Image]) -> Progress:
        """Of both works, one after the other: a thread beside the timed draws would slow them."""
        exact = self._exact.progress.share if self._exact is not None else None
        return Progress(max(drawn.progress.share or 0.0, exact or 0.0), drawn.progress.elapsed)

    def _reference(self, setup: Setup) -> tuple[Pixels, ...]:
        """The reference, when it is there; begun when it is asked for."""
        if self._exact is None:
            right = setup.with_(shading="per-fragment", bugs=(), samples=1)
            pieces = part(reference_pieces.pieces(right, COMPARED_SIZE), DRAWING, 1.0)
            self._exact = LongWork(pieces, aside=True)
        return self._exact.take()

    def _dot(self, log: SpeedLog, exact: Pixels) -> Dot:
        assert log.of is not None
        *times, image = self._found
        assert isinstance(image, Image)
        gpu, wall = (median(column) for column in zip(*times, strict=True))
        error = rmse(image.pixels, exact), largest(image.pixels, exact)
        clock = None if software(self._context) else gpu
        return Dot(*key_of(log.of, log.shaders), clock, wall, *error)


def drawn(setup: Setup, context: Any, shaders: Texts = ()) -> Pieces[Times | Image]:
    """Milliseconds of GPU and clock of each draw that counts, then the picture itself.

    ``shaders`` are texts in place of shader files.

    Raises
    ------
    ShaderError
        What stands in the way of drawing with them.
    """
    query, count = context.query(time=True), WARM + TIMED
    target = TextureTarget(context, DRAWN_SIZE, 1)
    setup = setup.with_(samples=1)
    try:
        with GLRenderer(DRAWN_SIZE, context) as renderer:
            renderer.overrides = dict(shaders)
            for i in range(count):
                began = perf_counter()
                with query:
                    renderer.draw(setup, target)
                    target.resolve()
                context.finish()
                wall = 1e3 * (perf_counter() - began)
                _believed(renderer)
                times = query.elapsed * 1e-6, wall
                yield Piece((i + 1) / (count + 1), times if i >= WARM else None)
            renderer.size = COMPARED_SIZE
            image = renderer.render(setup)
            _believed(renderer)
            assert isinstance(image, Image)
            yield Piece(1.0, image)
    finally:
        target.release()


def _believed(renderer: GLRenderer) -> None:
    """Measure nothing but what was asked for: other shaders have taken the place of wrong ones."""
    if renderer.shader_error:
        raise ShaderError(renderer.shader_error)
