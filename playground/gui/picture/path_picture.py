"""The path-traced picture of one place in the view: rough at once, better with every sample.

NumPy follows the paths on a thread. Any change drops them; the mean of the samples so far is
what is shown, and `told` says how many there are and how far off their mean may be.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import sqrt

import moderngl
import numpy as np
from numpy.typing import NDArray

from playground.gui.picture.reference import Codes, ReferencePicture
from playground.gui.work.long_work import Piece, Pieces
from playground.render.shown import shown_colour
from playground.render.trace.path import PathTracing
from playground.scene.setup import Setup
from playground.shading.display import code8

Size = tuple[int, int]
MOST = 2**16  # pixels that are sampled; a larger picture repeats them, or nobody would wait
ROUGH, FIRST = 2.5, 8  # the first picture has fewer pixels a side, and so many samples
SAMPLES = 1024  # of every pixel, at most
LEAST = 2  # samples before they take the place of the first picture: one has no error bar


@dataclass(frozen=True)
class PathsTold:
    """What is known of the picture that is there."""

    samples: int
    size: Size
    error: float  # the mean standard error of a pixel and channel, in the unit of colours

    @property
    def brief(self) -> str:
        """For a caption."""
        return f"{self.samples} samples, ±{self.error:.2g}"

    def __str__(self) -> str:
        width, height = self.size
        return (
            f"path-traced: {self.samples} samples of {width}×{height} pixels, "
            f"mean standard error {self.error:.2g}"
        )


class PathPicture(ReferencePicture):
    """As the reference picture, but that it keeps changing; ``told`` is None before the first."""

    def __init__(self, context: moderngl.Context) -> None:
        super().__init__(context, self._pieces)
        self._latest: tuple[Codes, PathsTold] | None = None
        self.told: PathsTold | None = None

    @property
    def working(self) -> bool:
        """Whether more samples are on their way."""
        return self._work is not None and self._wanted is not None

    @property
    def settled(self) -> bool:
        """Whether the picture that is there is of what is wanted: with more samples to come."""
        return not self.computing

    def rest(self) -> None:
        """Nobody looks at it: give up what is under way, and begin anew if somebody does again."""
        super().rest()
        self._shown = self._wanted = None
        self.told = None

    def _show(self, of: tuple[Setup, Size], codes: Codes) -> None:
        super()._show(of, codes)
        latest = self._latest
        if latest is not None and latest[0] is codes:
            self.told = latest[1]

    def _pieces(self, setup: Setup, size: Size) -> Pieces[Codes]:
        """The picture as it gets better; runs on the thread."""
        for share, tracing in _better(setup, size):
            if tracing is None:
                yield Piece(share)
                continue
            codes = _codes(tracing, setup, size)
            error = float(tracing.standard_error().mean())
            self._latest = codes, PathsTold(tracing.samples, tracing.scene.size, error)
            yield Piece(share, codes)


def sampled(size: Size, times: float = 1.0) -> Size:
    """How many pixels of a picture are sampled, ``times`` fewer along each side."""
    less = max(sqrt(size[0] * size[1] / MOST), 1.0) * times
    return max(int(size[0] / less), 1), max(int(size[1] / less), 1)


def _better(setup: Setup, size: Size) -> Iterator[tuple[float, PathTracing | None]]:
    """How much is done, and the tracing after each sample that is worth showing."""
    for times, samples, done in ((ROUGH, FIRST, 0.0), (1.0, SAMPLES, 1.0)):
        tracing = PathTracing(setup, sampled(size, times))
        for number in range(1, samples + 1):
            for _ in tracing.steps(1):
                yield done * number / samples, None
            if number >= LEAST:
                yield done * number / samples, tracing


def _codes(tracing: PathTracing, setup: Setup, size: Size) -> Codes:
    """The mean so far as codes (H, W, 4): what was sampled, each pixel repeated."""
    light = tracing.image(setup.settings.light_shown).pixels
    small: NDArray[np.uint8] = code8(shown_colour(light, setup.settings))
    rows = np.arange(size[1]) * small.shape[0] // size[1]
    columns = np.arange(size[0]) * small.shape[1] // size[0]
    codes = np.full((size[1], size[0], 4), 255, dtype=np.uint8)
    codes[..., :3] = small[rows[:, None], columns]
    return codes
