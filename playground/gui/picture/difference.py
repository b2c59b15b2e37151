"""The difference of two pictures, in colours that a colour-blind reader can order.

Per pixel the largest difference of red, green and blue as the screen shows them, from 0
to 1: what the eye is given to compare, with the clamp and the curve of the display.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from playground.explain.colour_map import colour_of

if TYPE_CHECKING:
    import moderngl

    from playground.scene.setup import Setup

Codes = NDArray[np.uint8]
LEVELS = np.arange(256) / 255.0


@dataclass(frozen=True, eq=False)
class Difference:
    """How two pictures differ: ``steps`` are 8-bit steps (H, W)."""

    steps: Codes = field(repr=False)

    @property
    def largest(self) -> float:
        """The maximum, in [0, 1]."""
        return float(self.steps.max(initial=0)) / 255.0

    @property
    def mean(self) -> float:
        """The mean over all pixels, in [0, 1]."""
        return float(self.steps.mean()) / 255.0 if self.steps.size else 0.0

    def painted(self, magnify: float) -> Codes:
        """Codes (H, W, 4): 0 is dark violet, 1/``magnify`` and above yellow."""
        table = np.full((256, 4), 255, dtype=np.uint8)
        table[:, :3] = np.round(255.0 * colour_of(LEVELS * magnify))
        return table[self.steps]


def differ(a: Codes, b: Codes) -> Difference:
    """|a − b| of two pictures (H, W, 3 or 4) of the same size."""
    first, second = a[..., :3], b[..., :3]
    apart = np.maximum(first, second) - np.minimum(first, second)
    return Difference(np.maximum(np.maximum(apart[..., 0], apart[..., 1]), apart[..., 2]))


@dataclass(frozen=True)
class Compared:
    """What a difference follows from: the setup of the first picture, and both pictures' stamps."""

    setup: Setup
    stamps: tuple[object, ...]


class DifferencePicture:
    """The difference as a texture, computed anew only when a picture or the scale changes."""

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self._texture: moderngl.Texture | None = None
        self.of: Compared | None = None  # what the present difference follows from
        self._magnify = 0.0
        self.computed = 0
        self.difference = Difference(np.zeros((1, 1), dtype=np.uint8))

    def texture(
        self, of: Compared | None, a: moderngl.Texture, b: moderngl.Texture, magnify: float
    ) -> moderngl.Texture:
        """The texture; ``of`` is what both pictures follow from. Row 0 is on top, as in them."""
        anew = self.of != of
        if anew:
            self.difference = differ(_read(a), _read(b)) if a.size == b.size else self.difference
            self.of = of
            self.computed += 1
        if anew or self._magnify != magnify or self._texture is None:
            codes = self.difference.painted(magnify)
            size = (codes.shape[1], codes.shape[0])
            if self._texture is None or self._texture.size != size:
                self.release()
                self._texture = self._context.texture(size, 4)
            self._texture.write(np.ascontiguousarray(codes).tobytes())
            self._magnify = magnify
        return self._texture

    def release(self) -> None:
        """Free the GPU memory."""
        if self._texture is not None:
            self._texture.release()
            self._texture = None


def _read(texture: moderngl.Texture) -> Codes:
    width, height = texture.size
    return np.frombuffer(texture.read(alignment=1), np.uint8).reshape(height, width, 4)
