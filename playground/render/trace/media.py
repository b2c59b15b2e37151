"""Which medium a ray travels in, where solids of glass lie in one another.

A ray remembers every solid that it has entered. Where these overlap, the one of the highest
priority is there, and the boundary of another makes no difference: a glass of water is
modelled with the water reaching into the glass, so that no layer of air is left between.
Source: Schmidt, Budge, Simple Nested Dielectrics in Ray Traced Images, JGT 7(2), 2002.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from playground.render.trace.solids import Solid
from playground.shading.floats import Array
from playground.shading.optics import transmitted_share

Inside = NDArray[np.bool_]  # (N, M): which of M media each ray has entered, the highest first
Ints = NDArray[np.intp]
AIR = 1.0  # refractive index where there is no medium


class Media:
    """The M transmissive solids of a scene by falling priority, and air as medium M.

    At equal priority the earlier object counts as the higher.
    """

    def __init__(self, solids: Sequence[Solid]) -> None:
        found = [n for n, solid in enumerate(solids) if solid.transmissive]
        found.sort(key=lambda n: -solids[n].material.priority)
        self.solids = found
        self.index = np.array([*(solids[n].material.index for n in found), AIR])
        self.absorption = np.array([*(solids[n].absorption for n in found), np.zeros(3)])
        self.of_solid = np.full(len(solids) + 1, -1)  # the medium of a solid, −1 for none
        self.of_solid[found] = np.arange(len(found))

    def current(self, inside: Inside) -> Ints:
        """The medium in which each ray travels, (N,)."""
        if not self.solids:
            return np.zeros(len(inside), np.intp)
        return np.where(inside.any(axis=1), inside.argmax(axis=1), len(self.solids))

    def across(
        self, inside: Inside, medium: Ints, entering: NDArray[np.bool_]
    ) -> tuple[Inside, Inside]:
        """What rays were in before and are in after they cross a boundary of ``medium`` (N,).

        The side from which they come decides, not their memory: a ray that leaves a solid
        was in it, even if it came in through a hole of its mesh.
        """
        rays = np.arange(len(inside))
        before, after = inside.copy(), inside.copy()
        before[rays, medium] = ~entering
        after[rays, medium] = entering
        return before, after

    def fading(self, inside: Inside, distance: Array) -> Array:
        """What is left of light after ``distance`` (N,), ∞ included, in its medium; (N, 3)."""
        absorption = self.absorption[self.current(inside)]
        finite = np.where(np.isfinite(distance), distance, 0.0)
        left = transmitted_share(absorption, finite)
        return np.where((absorption > 0.0) & ~np.isfinite(distance)[:, None], 0.0, left)
