"""Light at the corners of patches, for smooth display, from one colour per patch."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from playground.render.radiosity.patch.patches import Patches
from playground.scene.normals import direction
from playground.shading.floats import Array
from playground.shading.vector import cross, dot

Integers = NDArray[np.int64]

# Where the centres around a patch lie on a line, up to this share of their spread (squared), the
# light is known to change along that line only.
ON_A_LINE = 1e-6


def corner_light(patches: Patches, light: Array) -> Array:
    """The light at each of ``patches.points``, (V, C), from that of the patches, (N, C).

    The patches around a point are those that share it, so light does not blend over creases and
    between objects. Its light is their mean, weighed by their angles there. The mean belongs to the
    mean of their centres, which at a rim lies inside the surface: from there it is carried on
    to the point along the gradient of the light. So light that is linear over a flat surface stays
    linear up to its rim and corners. What is carried on stays within twice the range of the
    patches nearby, and above 0.
    """
    light = np.asarray(light, dtype=np.float64)
    around = _Around(patches)
    gap = patches.points - around.mean(patches.centre[around.patch])
    gradient = _gradient(patches, around, light)
    slope = around.mean(gradient.reshape(len(patches), -1)[around.patch])
    carried = around.mean(light[around.patch])
    carried += np.einsum("vi,vic->vc", gap, slope.reshape(len(gap), 3, -1))
    low, high = around.range(light)
    low, high = around.range(low, high)
    return np.asarray(np.clip(carried, np.maximum(2.0 * low - high, 0.0), 2.0 * high - low))


class _Around:
    """Which patches meet at which point: K pairs, with the angle of the patch there."""

    def __init__(self, patches: Patches) -> None:
        polygon, triangle = patches.polygon, patches.triangle
        rows = np.arange(len(patches))[:, None]
        before = np.where(triangle[:, None], [2, 0, 1, 1], [3, 0, 1, 2])
        after = np.where(triangle[:, None], [1, 2, 0, 0], [1, 2, 3, 0])
        first = direction(polygon[rows, after] - polygon)
        last = direction(polygon[rows, before] - polygon)
        turn = cross(first, last)
        angle = np.arctan2(np.sqrt(dot(turn, turn)), dot(first, last))
        real = np.column_stack([np.ones((len(patches), 3), dtype=bool), ~triangle])
        point = patches.corners[real].astype(np.int64)
        order = np.argsort(point, kind="stable")
        self.point = point[order]
        self.patch: Integers = np.nonzero(real)[0][order]
        self.angle = angle[real][order]
        self.valence = np.bincount(self.point, minlength=len(patches.points))
        self.start = np.cumsum(self.valence) - self.valence
        self.patches = len(patches)

    def mean(self, values: Array) -> Array:
        """The mean of values (K, C) at each point, weighed by the angles, (V, C)."""
        weight = np.add.reduceat(self.angle, self.start)
        total = np.add.reduceat(self.angle[:, None] * values, self.start)
        return np.asarray(total / weight[:, None])

    def range(self, low: Array, high: Array | None = None) -> tuple[Array, Array]:
        """The lowest and highest of the patches' values (K, C) at each point, (V, C) both.

        With ``high``, ``low`` and it are values (V, C) at points: from there to the patches, and
        back, so that each point knows those of the points around it.
        """
        if high is None:
            at = low[self.patch]
            return np.minimum.reduceat(at, self.start), np.maximum.reduceat(at, self.start)
        least = np.full((self.patches, low.shape[1]), np.inf)
        most = -least
        np.minimum.at(least, self.patch, low[self.point])
        np.maximum.at(most, self.patch, high[self.point])
        return self.range(least)[0], self.range(most)[1]

    def neighbours(self) -> tuple[Integers, Integers]:
        """Pairs of patches (i, j) that share a point, as often as they share one."""
        many = self.valence[self.point]
        first = np.repeat(self.patch, many)
        step = np.arange(len(first)) - np.repeat(np.cumsum(many) - many, many)
        return first, self.patch[np.repeat(self.start[self.point], many) + step]


def _gradient(patches: Patches, around: _Around, light: Array) -> Array:
    """How the light changes over each patch, (N, 3, C): the best linear fit to its neighbours."""
    count = len(patches)
    first, other = around.neighbours()
    away = patches.centre[other] - patches.centre[first]
    normal = patches.normal[first]
    away -= dot(away, normal)[:, None] * normal
    spread = np.zeros((count, 3, 3))
    change = np.zeros((count, 3, light.shape[1]))
    np.add.at(spread, first, away[:, :, None] * away[:, None, :])
    np.add.at(change, first, away[:, :, None] * (light[other] - light[first])[:, None, :])
    size, axes = np.linalg.eigh(spread)
    known = size > ON_A_LINE * size[:, 2:]
    inverse = np.where(known, 1.0 / np.where(known, size, 1.0), 0.0)
    along = np.einsum("nik,nic->nkc", axes, change)
    return np.asarray(np.einsum("nik,nk,nkc->nic", axes, inverse, along))
