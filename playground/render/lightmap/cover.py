"""Which texels a chart needs: all that a bilinear lookup anywhere on it reads.

A lookup reads the four texels whose centres are less than one texel away, along u and along v.
Each of them stands for the nearest point of the chart, so that texels whose centre lies beyond the
edge know the light at the edge.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from playground.shading.floats import Array

Ints = NDArray[np.int64]
BATCH = 2_000_000  # pairs of a texel and a triangle looked at together
INSET = 1.0 / 64.0  # texels: a point keeps this far from the edges of its triangle


class Covered(NamedTuple):
    """T texels: column, row, the triangle each belongs to (T,), and where on it (T, 3)."""

    column: Ints
    row: Ints
    triangle: Ints
    weights: Array


def cover(triangles: Array, size: int) -> Covered:
    """The texels that triangles (F, 3, 2), in units of texels, need of an image of ``size``².

    Where several triangles need a texel it belongs to the one nearest to its centre. Sorted by
    row and column.
    """
    low = np.floor(triangles.min(axis=1) - 0.5).astype(np.int64)
    high = np.ceil(triangles.max(axis=1) - 0.5).astype(np.int64)
    low, high = np.clip(low, 0, size - 1), np.clip(high, 0, size - 1)
    width, height = (high - low + 1).T
    best = _Best(size)
    count = width * height
    for part in _batches(count):
        triangle = np.repeat(part, count[part])
        place = np.arange(len(triangle)) - np.repeat(np.cumsum(count[part]), count[part])
        place += np.repeat(count[part], count[part])
        column = low[triangle, 0] + place % width[triangle]
        row = low[triangle, 1] + place // width[triangle]
        centre = np.stack([column, row], axis=1) + 0.5
        needed = _near(triangles[triangle], centre)
        best.offer(triangles, triangle[needed], column[needed], row[needed], centre[needed])
    return best.found(triangles)


class _Best:
    """For every texel the nearest triangle so far."""

    def __init__(self, size: int) -> None:
        self._size = size
        self._distance = np.full(size * size, np.inf)
        self._triangle = np.full(size * size, -1, dtype=np.int64)
        self._weights = np.zeros((size * size, 3))

    def offer(
        self, triangles: Array, triangle: Ints, column: Ints, row: Ints, centre: Array
    ) -> None:
        """Take triangles (N,) of texels whose centres are (N, 2), where they are nearer."""
        weights = nearest_weights(triangles[triangle], centre)
        apart = np.einsum("nc,ncx->nx", weights, triangles[triangle]) - centre
        distance = np.einsum("nx,nx->n", apart, apart)
        texel = row * self._size + column
        order = np.lexsort((triangle, distance, texel))
        first = order[np.r_[True, np.diff(texel[order]) > 0]] if len(order) else order
        nearer = first[distance[first] < self._distance[texel[first]]]
        self._distance[texel[nearer]] = distance[nearer]
        self._triangle[texel[nearer]] = triangle[nearer]
        self._weights[texel[nearer]] = weights[nearer]

    def found(self, triangles: Array) -> Covered:
        """The texels that have a triangle, each with the point of it that it stands for."""
        texel = np.flatnonzero(self._triangle >= 0)
        triangle = self._triangle[texel]
        weights = _inset(triangles[triangle], self._weights[texel])
        return Covered(texel % self._size, texel // self._size, triangle, weights)


def nearest_weights(triangle: Array, point: Array) -> Array:
    """Barycentric weights (N, 3) of the points of triangles (N, 3, 2) nearest to points (N, 2)."""
    edge = np.roll(triangle, -1, axis=1) - triangle  # from corner k to k + 1
    seen = point[:, None] - triangle
    across = edge[..., 0] * seen[..., 1] - edge[..., 1] * seen[..., 0]
    whole = across.sum(axis=1)  # twice the area, signed
    inside = (across * np.sign(whole)[:, None] >= 0.0).all(axis=1) & (whole != 0.0)
    weights = np.roll(across, -1, axis=1) / np.where(whole == 0.0, 1.0, whole)[:, None]

    # Elsewhere the nearest point lies on an edge: the best of the three.
    length = np.einsum("nkx,nkx->nk", edge, edge)
    along = np.einsum("nkx,nkx->nk", edge, seen) / np.where(length == 0.0, 1.0, length)
    along = np.clip(along, 0.0, 1.0)
    apart = seen - along[..., None] * edge
    chosen = np.argmin(np.einsum("nkx,nkx->nk", apart, apart), axis=1)
    rows = np.arange(len(point))
    share = along[rows, chosen]
    on_edge = np.zeros((len(point), 3))
    on_edge[rows, chosen] = 1.0 - share
    on_edge[rows, (chosen + 1) % 3] = share
    return np.where(inside[:, None], weights, on_edge)


def _near(triangle: Array, centre: Array) -> NDArray[np.bool_]:
    """Whether the open square of two texels around each centre (N, 2) meets its triangle."""
    seen = triangle - centre[:, None]
    meets = ((seen.min(axis=1) < 1.0) & (seen.max(axis=1) > -1.0)).all(axis=1)
    edge = np.roll(seen, -1, axis=1) - seen
    for k in range(3):
        normal = np.stack([-edge[:, k, 1], edge[:, k, 0]], axis=1)
        reach = np.abs(normal).sum(axis=1)
        height = np.einsum("ncx,nx->nc", seen, normal)
        apart = (height.min(axis=1) >= reach) | (height.max(axis=1) <= -reach)
        meets &= ~apart | (reach == 0.0)
    return np.asarray(meets)


def _inset(triangle: Array, weights: Array) -> Array:
    """The same points, moved off the edges: there they would lie within an adjacent wall."""
    edge = np.roll(triangle, -1, axis=1) - triangle
    area = np.abs(edge[:, 0, 0] * edge[:, 1, 1] - edge[:, 0, 1] * edge[:, 1, 0])
    opposite = np.linalg.norm(np.roll(edge, -1, axis=1), axis=2)
    share = INSET * opposite / np.where(area == 0.0, np.inf, area)[:, None]
    weights = np.maximum(weights, np.minimum(share, 0.25))
    return np.asarray(weights / weights.sum(axis=1, keepdims=True))


def _batches(count: Ints) -> list[Ints]:
    """The triangles in groups that have at most `BATCH` pairs together, or are alone."""
    group = (np.cumsum(count) - count) // BATCH
    return np.split(np.arange(len(count)), np.flatnonzero(np.diff(group)) + 1)
