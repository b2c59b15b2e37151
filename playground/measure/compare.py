"""`compare`: how two pictures differ, in five numbers and a map."""

from __future__ import annotations

from dataclasses import dataclass, field, fields

import numpy as np
from numpy.typing import NDArray

from playground.errors import PlaygroundError
from playground.explain.colour_map import colour_of
from playground.measure import metrics
from playground.render.image import Image


@dataclass(frozen=True, eq=False)
class Comparison:
    """The result of `compare`.

    ``rmse`` and ``max`` are of linear light, ``psnr`` (dB), ``ssim`` and ``flip`` of
    the pictures as shown, in [0, 1]. ``difference`` (H, W) is the largest difference of any
    component of linear light at each pixel.
    """

    rmse: float
    max: float
    psnr: float
    ssim: float
    flip: float
    difference: NDArray[np.float64] = field(repr=False)

    def to_dict(self) -> dict[str, float | None]:
        """The five numbers; an infinite PSNR (equal pictures) is None, as JSON knows none."""
        numbers = {f.name: getattr(self, f.name) for f in fields(self) if f.name != "difference"}
        return {name: value if np.isfinite(value) else None for name, value in numbers.items()}

    def heatmap(self, largest: float | None = None) -> Image:
        """The difference in false colours, yellow at ``largest`` (default: the maximum)."""
        top = largest or self.max or 1.0
        return Image(colour_of(self.difference / top).astype(np.float32), renderer="comparison")

    def __str__(self) -> str:
        psnr = f"{self.psnr:.2f} dB" if np.isfinite(self.psnr) else "infinite (equal as shown)"
        return (
            f"RMSE {self.rmse:.3g}   max {self.max:.3g}   (linear light)\n"
            f"PSNR {psnr}   SSIM {self.ssim:.5f}   FLIP {self.flip:.5f}   (as shown)"
        )


def compare(a: Image, b: Image) -> Comparison:
    """How picture ``b`` differs from the reference ``a``.

    Raises
    ------
    PlaygroundError
        The pictures have different sizes, or hold numbers that are not finite.
    """
    for name, image in (("the first", a), ("the second", b)):
        if not isinstance(image, Image):
            raise PlaygroundError(f"{name} is no Image", got=type(image).__name__)
        if not np.isfinite(image.pixels).all():
            raise PlaygroundError(f"{name} picture holds NaN or infinite values")
    if a.size != b.size:
        raise PlaygroundError(
            "the pictures have different sizes",
            got=f"{a.size[0]}x{a.size[1]} and {b.size[0]}x{b.size[1]}",
            fix="Render both with the same --size.",
        )
    shown_a, shown_b = a.shown(), b.shown()
    difference = np.abs(np.subtract(a.pixels, b.pixels, dtype=np.float64)).max(axis=-1)
    return Comparison(
        rmse=metrics.rmse(a.pixels, b.pixels),
        max=metrics.largest(a.pixels, b.pixels),
        psnr=metrics.psnr(shown_a, shown_b),
        ssim=metrics.ssim(shown_a, shown_b),
        flip=float(np.mean(metrics.flip_map(shown_a, shown_b))),
        difference=difference,
    )
