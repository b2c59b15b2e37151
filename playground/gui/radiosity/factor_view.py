"""Which two patches the panel of form factors is about, and how it shows them."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from playground.render.radiosity.patch.patches import Patches
from playground.scene.knob import Declared, choice, integer, number, switch

COLOURINGS = ("patch", "light", "delta")
Rgb = tuple[float, float, float]
ONE: Rgb = (1.0, 0.62, 0.15)  # of patch i
OTHER: Rgb = (0.25, 0.80, 1.0)  # of patch j
UNDER: Rgb = (1.0, 1.0, 1.0)  # of the patch under the mouse


@dataclass(frozen=True)
class FactorView(Declared):
    """Nothing of this is part of the setup.

    ``one`` and ``other`` are patches i and j of the patches ``of``; ``under`` is that under the
    mouse in the picture, ``lit`` that under the mouse in the panel; None for no patch.
    """

    label = "form factors"

    one: int | None = None
    other: int | None = None
    under: int | None = None
    lit: int | None = None
    of: Patches | None = None

    picking: bool = switch(
        False,
        help="a click chooses patch i, the next one patch j (Shift+click: always j), in place of "
        "explaining a pixel; a right click forgets both",
    )
    resolution: int = integer(
        64, 8, 256, scale="log", help="pixels along an edge of the hemicube's top"
    )
    colouring: str = choice(
        "patch",
        COLOURINGS,
        help="a colour of its own for each patch, its light once radiosity is solved (before: its "
        "surface in white light), or the pixel's delta form factor",
    )
    across: float = number(0.5, 0.0, 1.0, help="where on patch i the hemisphere stands")
    along: float = number(0.5, 0.0, 1.0, help="where on patch i the hemisphere stands")

    @property
    def pointed(self) -> int | None:
        """The patch under the mouse, in the picture or in the hemicube."""
        return self.under if self.under is not None else self.lit

    def clicked(self, patch: int, second: bool = False) -> FactorView:
        """A patch was chosen: as j if it is the second, else as what is missing, else as i."""
        second = second or (self.one is not None and self.other is None)
        if second and self.one is not None and patch != self.one:
            return replace(self, other=patch)
        if patch == self.one:
            return self
        return replace(self, one=patch, other=None)

    def swapped(self) -> FactorView:
        """The two exchanged."""
        if self.other is None:
            return self
        return replace(self, one=self.other, other=self.one)

    def forgotten(self) -> FactorView:
        """No patch is chosen any more."""
        return replace(self, one=None, other=None, under=None, lit=None)

    def on(self, patches: Patches | None) -> FactorView:
        """The same with the patches that are there now; other ones have other numbers."""
        if patches is None or patches is self.of:
            return self
        same = self.of is not None and np.array_equal(self.of.polygon, patches.polygon)
        return replace(self if same else self.forgotten(), of=patches)
