"""The edges of patches, and which patches meet at them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from playground.render.radiosity.patch.patches import Patches
from playground.shading.floats import Array

Integers = NDArray[np.int64]

# Points closer than this share of the scene's extent are one place: float32 coordinates of one
# point, computed in two ways, differ by a tenth of it.
SAME_PLACE = 1e-6


@dataclass(frozen=True, eq=False)
class Edges:
    """The E real edges of patches, in the order of the patches: from ``start`` to ``end``."""

    patch: Integers  # (E,)
    start: Integers  # (E,): points, or places
    end: Integers  # (E,)

    @property
    def key(self) -> Integers:
        """One number for an edge from whichever side, (E,)."""
        low, high = np.minimum(self.start, self.end), np.maximum(self.start, self.end)
        return np.asarray(low * (int(high.max(initial=0)) + 1) + high)

    def alone(self) -> Integers:
        """Which edges no other edge joins: numbers of edges, in their order."""
        _, first, many = np.unique(self.key, return_index=True, return_counts=True)
        return np.sort(first[many == 1])

    def twins(self) -> tuple[Integers, Integers]:
        """Pairs of edges that join the same two points, where no third edge does."""
        _, number, many = np.unique(self.key, return_inverse=True, return_counts=True)
        order = np.argsort(number, kind="stable")
        pair = order[many[number[order]] == 2]
        return pair[::2], pair[1::2]


def edges_of(corners: NDArray[np.integer], number: Integers | None = None) -> Edges:
    """The edges of pieces (N, 4) over points, or over the places ``number`` (V,) of the points."""
    wide = corners.astype(np.int64)
    after = np.roll(wide, -1, axis=1)
    real = wide != after
    patch = np.nonzero(real)[0]
    start, end = wide[real], after[real]
    return Edges(patch, start, end) if number is None else Edges(patch, number[start], number[end])


def extent_of(patches: Patches) -> float:
    """The longest side of the box around all patches."""
    return float(np.ptp(patches.points, axis=0).max())


def places(points: Array, tolerance: float) -> Integers:
    """For each point (V, 3) the number of its place: nearer than ``tolerance``, one number."""
    columns = [_steps(points[:, k], tolerance) for k in range(3)]
    count = np.int64(len(points))
    pair = np.unique(columns[0] * count + columns[1], return_inverse=True)[1]
    return np.asarray(np.unique(pair * count + columns[2], return_inverse=True)[1])


def _steps(values: Array, tolerance: float) -> Integers:
    """Numbers that grow with the values, equal where sorted values are no further apart."""
    order = np.argsort(values, kind="stable")
    apart = np.diff(values[order], prepend=values[order[:1]]) > tolerance
    step = np.empty(len(values), dtype=np.int64)
    step[order] = np.cumsum(apart)
    return step
