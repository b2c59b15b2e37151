"""A picture: linear light, float32, row 0 on top; shown, saved and read back."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from playground.render.precision import smallest_normal
from playground.render.shown import shown_colour
from playground.scene.settings import Settings
from playground.scene.setup import Setup
from playground.shading.display import code8
from playground.shading.marks import KINDS, kinds_of


@dataclass(frozen=True, eq=False)
class LeftOut:
    """What a ray tracer did not follow: per pixel the weights of the rays not shot, summed.

    ``weights`` (H, W, 3): had all of those rays met light of brightness 1, the picture would be
    brighter by this much.
    """

    weights: NDArray[np.float32]

    @property
    def mean(self) -> float:
        """The mean over the pixels, of the channel in which it is largest."""
        return float(self.weights.mean(axis=(0, 1), dtype=np.float64).max())

    @property
    def max(self) -> float:
        """The largest weight of any pixel and channel."""
        return float(self.weights.max())

    def __str__(self) -> str:
        return f"rays not followed weigh {self.mean:.2g} on average, {self.max:.2g} at most"


@dataclass(frozen=True, eq=False)
class Image:
    """What `playground.render` returns.

    Parameters
    ----------
    pixels : float32 array of shape (H, W, 3)
        Linear RGB, not clamped; row 0 is the top row.
    coverage : float32 array of shape (H, W), optional
        The share of each pixel that some surface covers.
    setup : Setup, optional
        What the picture shows; a saved PNG carries it.
    renderer : str
        ``"gl"``, ``"numpy"``, or ``"file"``.
    left_out : LeftOut, optional
        Of a traced picture: what its cut-offs left out.
    warnings : tuple of str
        Of a traced picture: what it shows that its author may not expect.
    """

    pixels: NDArray[np.float32]
    coverage: NDArray[np.float32] | None = None
    setup: Setup | None = None
    renderer: str = "numpy"
    notes: dict[str, str] = field(default_factory=dict)
    left_out: LeftOut | None = None
    warnings: tuple[str, ...] = ()

    @property
    def size(self) -> tuple[int, int]:
        """Width and height in pixels."""
        return self.pixels.shape[1], self.pixels.shape[0]

    def shown(self) -> NDArray[np.float64]:
        """What a screen shows, in [0, 1], shape (H, W, 3): exposed, clamped, curved, marked."""
        return shown_colour(self.pixels, self._settings)

    def marks(self) -> dict[str, int]:
        """How many pixels are NaN, infinite, negative, denormal, clamped; each kind by itself."""
        settings = self._settings
        found = kinds_of(self.pixels, settings.exposure, smallest_normal(settings))
        return {kind: int(found[..., k].sum()) for k, kind in enumerate(KINDS)}

    @property
    def _settings(self) -> Settings:
        return self.setup.settings if self.setup is not None else Settings()

    def codes(self) -> NDArray[np.uint8]:
        """The 8-bit codes of the picture, shape (H, W, 3)."""
        return code8(self.shown())

    def into(self, out: NDArray[Any]) -> NDArray[Any]:
        """Write the picture into an array (H, W, 3 or 4), see `Renderer.render`; returns it."""
        if out.dtype == np.uint8:
            out[..., :3] = self.codes()
            out[..., 3] = 255
        else:
            out[..., :3] = self.pixels
            if out.shape[2] == 4:
                out[..., 3] = 1.0 if self.coverage is None else self.coverage
        return out

    def save(self, path: str | Path) -> None:
        """Write .png (8-bit, with the setup inside), .exr or .npy (linear float32).

        Raises
        ------
        PlaygroundError
            Another suffix, or the place cannot be written; an old file stays as it was.
        """
        from playground.render.image_file import save_image

        save_image(self, Path(path))

    def _repr_png_(self) -> bytes:
        from playground.render.image_file import png_bytes

        return png_bytes(self.codes(), self.setup)
