"""A tree of boxes around the triangles of a mesh, so that a ray tests only a few of them.

What the tree is, in flat arrays that NumPy and the GPU read alike; `growth` says how it is
cut, `walk` how rays go through it.
"""

from __future__ import annotations

import weakref
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from playground.render.trace.growth import BOX_COST, Growth, half_surface
from playground.scene.mesh import Mesh
from playground.shading.floats import Array, floats

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Indices = NDArray[np.int32]
Singles = NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class Bvh:
    """K nodes over F triangles, level by level; the two children of a node are neighbours.

    Parameters
    ----------
    low, high : (K, 3) float32
        The box of each node, rounded outwards: it holds its triangles to the last bit.
    child : (K,) int32
        The first of the two children, the other is the next node; −1 for a leaf. Node 0 is the
        root.
    first, count : (K,) int32
        The triangles of a node, leaf or not, are in the slots from ``first`` to before
        ``first + count``.
    order : (F,) int32
        Which triangle of the mesh is in a slot.
    corners : (F, 3, 3) array, in the type of the positions
        The corners of the triangles, by slot.
    levels : (D + 1,) int64
        Level d has the nodes from ``levels[d]`` to before ``levels[d + 1]``.
    """

    low: Singles
    high: Singles
    child: Indices
    first: Indices
    count: Indices
    order: Indices
    corners: Array
    levels: Ints

    @property
    def nodes(self) -> int:
        """How many nodes there are; 0 without triangles."""
        return len(self.child)

    @property
    def depth(self) -> int:
        """How many levels there are; a ray never has more nodes waiting than this."""
        return len(self.levels) - 1

    @cached_property
    def cost(self) -> float:
        """What a random ray through the root costs, in tests of one triangle."""
        if self.nodes == 0:
            return 0.0
        size = self.high.astype(np.float64) - self.low
        size /= max(float(size[0].max()), float(np.finfo(np.float32).tiny))
        area = half_surface(np.concatenate([-size.T, np.zeros_like(size.T)]))
        share = area / area[0] if area[0] > 0.0 else np.ones_like(area)
        return float(share @ np.where(self.child < 0, self.count, BOX_COST))

    @cached_property
    def sides(self) -> Floats:
        """The boxes side by side, (6, K): lowest x, y, z, then highest; float64 as rays are."""
        return np.concatenate([self.low, self.high], axis=1).T.astype(np.float64, order="C")

    def level(self, depth: int) -> tuple[Singles, Singles]:
        """The low and high corners (n, 3) of the boxes of one level, 0 for the root's."""
        nodes = slice(self.levels[depth], self.levels[depth + 1])
        return self.low[nodes], self.high[nodes]


def build(positions: ArrayLike, faces: ArrayLike) -> Bvh:
    """The tree over the triangles ``positions[faces]``; same input, same tree.

    Parameters
    ----------
    positions : (V, 3) array, finite
    faces : (F, 3) whole numbers; F may be 0, triangles may be without area or coincide
    """
    (positions,) = floats(positions)
    corners = positions[np.asarray(faces, dtype=np.int64).reshape(-1, 3)]
    low = np.minimum(np.minimum(corners[:, 0], corners[:, 1]), corners[:, 2]).T.copy()
    high = np.maximum(np.maximum(corners[:, 0], corners[:, 1]), corners[:, 2]).T.copy()
    growth = Growth(_in_unit_cube(low, high))
    while growth.grow():
        pass
    child, first, count, levels = growth.tree()
    order = np.argsort(first[growth.leaf_of], kind="stable") if len(child) else np.arange(0)
    lowest, highest = _boxes(low[:, order], high[:, order], child, first, levels)
    tree = [x.astype(np.int32) for x in (child, first, count)]
    slots = order.astype(np.int32)
    return Bvh(lowest, highest, tree[0], tree[1], tree[2], slots, corners[order], levels)


_built: weakref.WeakKeyDictionary[Mesh, Bvh] = weakref.WeakKeyDictionary()


def bvh_of(mesh: Mesh) -> Bvh:
    """The tree of ``mesh``, built once for as long as the mesh lives."""
    found = _built.get(mesh)
    if found is None:
        found = _built[mesh] = build(mesh.positions, mesh.faces)
    return found


def is_built(mesh: Mesh) -> bool:
    """Whether `bvh_of` has the tree of ``mesh`` at hand."""
    return mesh in _built


def _in_unit_cube(low: Array, high: Array) -> Singles:
    """Lowest sides and minus the highest, (6, F), moved and scaled into 0..1 and −1..0."""
    if low.shape[1] == 0:
        return np.zeros((6, 0), dtype=np.float32)
    start = low.min(axis=1, keepdims=True).astype(np.float64)
    size = float((high.max(axis=1, keepdims=True) - start).max())
    scale = size if size > 0.0 else 1.0
    return np.concatenate([(low - start) / scale, (start - high) / scale]).astype(np.float32)


def _boxes(
    low: Array, high: Array, child: Ints, first: Ints, levels: Ints
) -> tuple[Singles, Singles]:
    """The boxes of all nodes from those of the triangles by slot: of leaves, then upwards."""
    leaves = np.flatnonzero(child < 0)
    leaves = leaves[np.argsort(first[leaves])]
    lowest = np.empty((len(child), 3), dtype=low.dtype)
    highest = np.empty_like(lowest)
    for axis in range(3 if len(leaves) else 0):
        lowest[leaves, axis] = np.minimum.reduceat(low[axis], first[leaves])
        highest[leaves, axis] = np.maximum.reduceat(high[axis], first[leaves])
    for start, end in zip(levels[-2::-1], levels[:0:-1], strict=True):
        inner = start + np.flatnonzero(child[start:end] >= 0)
        left = child[inner]
        lowest[inner] = np.minimum(lowest[left], lowest[left + 1])
        highest[inner] = np.maximum(highest[left], highest[left + 1])
    return _rounded(lowest, -np.inf), _rounded(highest, np.inf)


def _rounded(values: Array, towards: float) -> Singles:
    """The values as float32, rounded towards −inf or inf."""
    with np.errstate(over="ignore", under="ignore"):
        near = values.astype(np.float32)
        short = near > values if towards < 0.0 else near < values
        return np.where(short, np.nextafter(near, np.float32(towards)), near)
