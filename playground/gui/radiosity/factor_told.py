"""What the window knows of the form factors that its panel asks for."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from playground.explain.patch_pair import PatchPair
from playground.render.radiosity.patch.patches import Patches


@dataclass(frozen=True, eq=False)
class HemicubeTold:
    """What patch ``patch`` sees: its item buffer (3N, N), the number of a patch plus 1 each."""

    patch: int
    items: NDArray[np.int32]

    @property
    def resolution(self) -> int:
        """N, the pixels along an edge of the top."""
        return int(self.items.shape[1])


@dataclass(frozen=True, eq=False)
class FactorTold:
    """What is computed so far.

    ``picture`` is the number of the hemicube's texture, ``solved`` says that radiosity has lit
    these patches.
    """

    patches: Patches | None = None
    pair: PatchPair | None = None
    hemicube: HemicubeTold | None = None
    picture: int = 0
    solved: bool = False
    error: str = ""
    working: bool = False
