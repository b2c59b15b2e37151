"""The light at every texel: lamps, emitters, and everything that they light."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from playground.render.lightmap.buried import moved_out
from playground.render.lightmap.gather import (
    MOST_EMITTERS,
    Points,
    emitters,
    from_emitters,
    gathered,
)
from playground.render.lightmap.smooth import count_split, smoothed
from playground.render.lightmap.solved import Solved
from playground.render.lightmap.surroundings import Surroundings
from playground.render.lightmap.texels import Texels
from playground.render.radiosity.direct import arriving_at
from playground.render.radiosity.factor.visibility import between
from playground.shading.floats import Array

if TYPE_CHECKING:
    from playground.render.radiosity.result import Radiosity

FEW_RAYS = 64  # for emitters, where there are so many that rays must find them, and no others


class Lighting:
    """Light by `light` part after part, then `finished`. ``buried`` (T,): texels without any."""

    def __init__(self, result: Radiosity, texels: Texels, rays: int) -> None:
        """``rays`` per texel; with 0, indirect light is that of the patches."""
        self._setup, self._texels = result.setup, texels
        self._patches = patches = result.patches
        occlusion = result.setup.settings.occlusion
        self._between = between(patches) if occlusion else None
        self._around = Surroundings(patches)
        self._at = Points(texels.position.copy(), texels.normal, texels.side)
        self.buried: NDArray[np.bool_] = np.zeros(len(texels), dtype=bool)
        self._straight = np.zeros((len(texels), 3))

        # A ray is always stopped: where patches do not hide one another, none can be sent.
        self._rays = rays if occlusion else 0
        self._sent = self._rays or FEW_RAYS
        self._emitters = emitters(patches)
        self._solved = Solved(patches, result.indirect) if self._rays == 0 else None
        found = patches.emission * (len(self._emitters) > MOST_EMITTERS)
        reflected = (result.light - patches.emission) * (self._rays > 0)
        self._colours = np.hstack([found, reflected])
        self._brought = np.zeros((len(texels), 6))

    def light(self, part: slice) -> None:
        """Compute the light of some of the texels."""
        at, buried = moved_out(self._around, self._at[part], self._texels.spacing)
        self._at.position[part], self.buried[part] = at.position, buried
        lit = np.arange(len(self._texels))[part][~buried]
        at = self._at[lit]
        straight = arriving_at(self._setup, self._patches, at.position, at.normal, at.side)
        if len(self._emitters) <= MOST_EMITTERS:
            samples = self._setup.settings.light_samples
            straight += from_emitters(self._emitters, self._between, at, samples)
        self._straight[lit] = straight
        if self._colours.any():
            column, row = self._texels.column[lit], self._texels.row[lit]
            pattern = column % 4 + 4 * (row % 4)
            self._brought[lit] = gathered(self._around, at, self._colours, self._sent, pattern)

    def split(self) -> int:
        """How many pairs of neighbouring texels have a wall between them; after `light`."""
        return count_split(self._texels, self._at, self.buried, self._around)

    def finished(self) -> Array:
        """Direct and indirect light side by side, (T, 6); 0 where it is buried."""
        brought = self._brought
        if brought.any():
            where = self._texels, self._at, self.buried, self._around
            brought = smoothed(brought, self._sent, *where)
        if self._solved is not None:
            lit = np.flatnonzero(~self.buried)
            brought[lit, 3:] = self._solved.at(self._at[lit], self._texels.item[lit])
        return np.hstack([self._straight + brought[:, :3], brought[:, 3:]])
