"""Cuts triangles and quads evenly, along edges that they share into the same points."""

from __future__ import annotations

from dataclasses import dataclass
from math import prod

import numpy as np
from numpy.typing import NDArray

from playground.render.radiosity.patch.outline import Outline
from playground.render.radiosity.patch.patches import Parents
from playground.scene.normals import direction
from playground.shading.floats import Array

Integers = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Pieces:
    """N pieces over V points, in the order of the parents that they were cut from."""

    points: Array  # (V, 3)
    normals: Array  # (V, 3), unit
    texcoords: Array | None  # (V, 2)
    corners: Integers  # (N, 4)
    parent: Integers  # (N,)
    parents: Parents


def cut(shape: Outline, parts: Integers) -> Pieces:
    """The pieces of an outline whose edges are cut into ``parts``, (M, 4), as `Parts` makes them.

    Quads become a bilinear grid, triangles a triangular one; texture coordinates and shading
    normals follow.
    """
    triangle = shape.corners[:, 2] == shape.corners[:, 3]
    grid = parts[:, [0, 3]]
    count = grid.prod(axis=1)
    first = np.cumsum(count) - count
    joint = _Edges(shape, parts)
    corners = np.empty((int(count.sum()), 4), dtype=np.int64)
    inner: list[Array] = []
    used = len(shape.points) + joint.count
    for kind in np.unique(np.column_stack([grid, triangle]), axis=0):
        rows = np.flatnonzero((grid == kind[:2]).all(axis=1) & (triangle == kind[2]))
        m, n = int(kind[0]), int(kind[1])
        lay = _triangles if kind[2] else _quads
        net, weights = lay(joint, rows, m, n, used)
        inner.append((weights @ joint.values[shape.corners[rows]]).reshape(-1, joint.width))
        used += len(inner[-1])
        corners[first[rows, None] + np.arange(count[rows[0]])] = net
    values = np.concatenate([joint.values, joint.inside, *inner])
    polygon = shape.points[shape.corners]
    whole = np.ones(len(grid), dtype=bool)
    return Pieces(
        values[:, :3],
        direction(values[:, 3:6]),
        None if shape.texcoords is None else values[:, 6:],
        corners,
        np.repeat(np.arange(len(grid)), count),
        Parents(polygon, grid.astype(np.int32), first.astype(np.int32), whole),
    )


class _Edges:
    """The points inside the edges, which neighbours share where they share both ends."""

    def __init__(self, shape: Outline, parts: Integers) -> None:
        self.corners, self.parts = shape.corners, parts
        flat = [shape.points, shape.normals]
        flat += [] if shape.texcoords is None else [shape.texcoords]
        self.values = np.concatenate(flat, axis=1)
        self.width = self.values.shape[1]
        total = len(self.values)
        start, end = shape.corners, np.roll(shape.corners, -1, axis=1)

        # From the same end at a crease too, so that its points coincide to the bit
        self.forward = shape.place[start] <= shape.place[end]
        low, high = np.where(self.forward, start, end), np.where(self.forward, end, start)
        key, index, edge = np.unique(low * total + high, return_index=True, return_inverse=True)
        inside = np.where(key // total == key % total, 0, parts.ravel()[index] - 1)
        self.count = int(inside.sum())
        before = np.cumsum(inside) - inside
        self.start = (total + before)[edge].reshape(-1, 4)
        of = np.repeat(np.arange(len(key)), inside)
        step = np.arange(self.count) - before[of] + 1
        share = (step / (inside[of] + 1))[:, None]
        a, b = self.values[key // total][of], self.values[key % total][of]
        self.inside = a * (1.0 - share) + b * share

    def along(self, rows: Integers, slot: int) -> Integers:
        """The points from corner ``slot`` to the next, ends included, (R, parts + 1)."""
        k = int(self.parts[rows[0], slot])
        step = np.arange(1, k)[None, :]
        turned = np.where(self.forward[rows, slot, None], step, k - step)
        inside = self.start[rows, slot, None] + turned - 1
        ends = self.corners[rows][:, [slot, (slot + 1) % 4]]
        return np.concatenate([ends[:, :1], inside, ends[:, 1:]], axis=1)


def _quads(edges: _Edges, rows: Integers, m: int, n: int, used: int) -> tuple[Integers, Array]:
    """Corners (R, m n, 4) of the pieces of quads, and the weights (I, 4) of inner points."""
    net = np.empty((len(rows), m + 1, n + 1), dtype=np.int64)
    net[:, 1:m, 1:n] = _numbers(used, len(rows), m - 1, n - 1)
    net[:, :, 0], net[:, m, :] = edges.along(rows, 0), edges.along(rows, 1)
    net[:, ::-1, n], net[:, 0, ::-1] = edges.along(rows, 2), edges.along(rows, 3)
    across, up = np.meshgrid(np.arange(1, m) / m, np.arange(1, n) / n, indexing="ij")
    s, t = across.ravel(), up.ravel()
    weights = np.stack([(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t], axis=1)
    pieces = np.stack([net[:, :-1, :-1], net[:, 1:, :-1], net[:, 1:, 1:], net[:, :-1, 1:]], axis=-1)
    return pieces.reshape(len(rows), m * n, 4), weights


def _triangles(edges: _Edges, rows: Integers, m: int, _: int, used: int) -> tuple[Integers, Array]:
    """Corners (R, m², 4) of the pieces of triangles, and the weights (I, 4) of inner points."""
    net = np.zeros((len(rows), m + 1, m + 1), dtype=np.int64)
    across, up = np.meshgrid(np.arange(m + 1), np.arange(m + 1), indexing="ij")
    inside = (across > 0) & (up > 0) & (across + up < m)
    i, j = across[inside], up[inside]
    net[:, i, j] = _numbers(used, len(rows), len(i))
    far = np.arange(m + 1)
    net[:, :, 0], net[:, 0, ::-1] = edges.along(rows, 0), edges.along(rows, 3)
    net[:, m - far, far] = edges.along(rows, 1)
    weights = np.stack([m - i - j, i, j, 0 * i], axis=1) / m

    # Of each cell the half at the first corner, then the other
    a, b = np.meshgrid(np.arange(m), np.arange(m), indexing="ij")
    near = np.stack([net[:, a, b], net[:, a + 1, b], net[:, a, b + 1]], axis=-1)
    beyond = np.stack([net[:, a + 1, b], net[:, a + 1, b + 1], net[:, a, b + 1]], axis=-1)
    both = np.stack([near, beyond], axis=-2)
    there = np.stack([a + b < m, a + b < m - 1], axis=-1)
    return both[:, there][:, :, [0, 1, 2, 2]], weights


def _numbers(used: int, *shape: int) -> Integers:
    """The numbers of the inner points of each parent, in an array of this shape."""
    return np.asarray(used + np.arange(prod(shape)).reshape(shape))
