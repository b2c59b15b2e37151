"""A picture: linear light, float32, row 0 on top; shown, saved and read back."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from playground.scene.settings import Settings
from playground.scene.setup import Setup
from playground.shading.display import code8, display_colour


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
    """

    pixels: NDArray[np.float32]
    coverage: NDArray[np.float32] | None = None
    setup: Setup | None = None
    renderer: str = "numpy"
    notes: dict[str, str] = field(default_factory=dict)

    @property
    def size(self) -> tuple[int, int]:
        """Width and height in pixels."""
        return self.pixels.shape[1], self.pixels.shape[0]

    def shown(self) -> NDArray[np.float64]:
        """What a screen shows, in [0, 1], shape (H, W, 3): exposed, clamped, with the curve."""
        settings = self.setup.settings if self.setup is not None else Settings()
        return display_colour(self.pixels, settings.exposure, settings.clamp, settings.curve)

    def codes(self) -> NDArray[np.uint8]:
        """The 8-bit codes of the picture, shape (H, W, 3)."""
        return code8(self.shown())

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
