"""The outlines of patches, and the patches that shoot, as lines and triangles in the world."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from playground.gui.radiosity.radiosity_run import RadiosityRun
from playground.gui.radiosity.solving import Solving
from playground.render.radiosity.patch.patches import Patches

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class PatchLines:
    """What is marked of some patches; the same marks are the same object again."""

    patches: Patches
    outlines: bool
    shooters: tuple[int, ...] = ()

    @cached_property
    def edges(self) -> Array:
        """World points of the edges, each once, in pairs (2 E, 3)."""
        if not self.outlines:
            return np.zeros((0, 3))
        corners = self.patches.corners.astype(np.int64)
        ends = np.stack([corners, np.roll(corners, -1, axis=1)], axis=2).reshape(-1, 2)
        ends = np.unique(np.sort(ends[ends[:, 0] != ends[:, 1]], axis=1), axis=0)
        return np.asarray(self.patches.points[ends.ravel()] + self.patches.origin)

    @cached_property
    def triangles(self) -> Array:
        """World points of the triangles of the patches that shoot, in threes (3 T, 3)."""
        quads = self.patches.corners[list(self.shooters)]
        corners = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]).ravel()
        return np.asarray(self.patches.points[corners] + self.patches.origin)


class PatchMarker:
    """Makes the marks of a solution, and gives the same ones again while nothing has changed."""

    def __init__(self) -> None:
        self._made: PatchLines | None = None

    def lines(self, run: RadiosityRun, solving: Solving) -> PatchLines | None:
        """What is to be marked now; None for nothing."""
        patches, step = run.patches, run.step
        if patches is None or not (solving.outlines or solving.shooter):
            return None
        shot = tuple(step.patches.tolist()) if step is not None and solving.shooter else ()
        made = self._made
        if made is None or (made.outlines, made.shooters) != (solving.outlines, shot):
            made = None
        if made is None or made.patches is not patches:
            made = PatchLines(patches, solving.outlines, shot)
        self._made = made
        return made
