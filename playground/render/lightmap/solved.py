"""The light of patches between their corners: a lightmap without any gathering."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from playground.render.lightmap.gather import Points
from playground.render.radiosity.factor.visibility import halves, size_of, tree_of
from playground.render.radiosity.patch.corner_light import corner_light
from playground.render.radiosity.patch.patches import Patches
from playground.render.trace import walk
from playground.shading.floats import Array

NEAR = 1e-5  # of the size of the scene: coplanar triangles that make one quad are this flat


class Solved:
    """Light per patch (N, 3), averaged at the corners and interpolated in between."""

    def __init__(self, patches: Patches, light: Array) -> None:
        self._patches, self._reach = patches, NEAR * size_of(patches)
        self._light = corner_light(patches, light)
        self._trees = {}
        for owner in np.unique(patches.owner):
            own = np.flatnonzero(patches.owner == owner)
            triangles, patch = halves(patches.polygon[own])
            quads = patches.corners[own]
            second = np.arange(len(triangles)) >= len(own)
            corners = np.where(second[:, None], quads[patch][:, [0, 2, 3]], quads[patch][:, :3])
            self._trees[int(owner)] = tree_of(triangles), corners

    def at(self, at: Points, owner: NDArray[np.integer]) -> Array:
        """The light at points on the surfaces of their owners (T,), (T, 3)."""
        result = np.zeros_like(at.position)
        for number in np.unique(owner):
            if int(number) not in self._trees:
                continue
            tree, corners = self._trees[int(number)]
            mine = np.flatnonzero(owner == number)
            start = at.position[mine] + self._reach * at.side[mine]
            found = walk.closest(tree, start, -at.side[mine], 2.0 * self._reach)
            hit = found[1] >= 0
            at_corners = self._light[corners[found[1][hit]]]
            result[mine[hit]] = np.einsum("tc,tcx->tx", found[2][hit], at_corners)
        return result
