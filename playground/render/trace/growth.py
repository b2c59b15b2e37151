"""How a tree of boxes grows: all nodes of a level are cut at once, where it costs least.

A random ray that meets a box meets a box inside it with a chance that is the ratio of their
surfaces. So a cut is good if its two surfaces, each times the triangles within, add up to little.
Cuts are tried between bins of equal width along the axes.
Sources: MacDonald, Booth, Heuristics for Ray Tracing Using Space Subdivision, 1990; Wald, On
fast Construction of SAH-based Bounding Volume Hierarchies, 2007.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Singles = NDArray[np.float32]

SMALLEST_LEAF = 2  # so few triangles are never divided
LARGEST_LEAF = 8  # more triangles than this are always divided
BOX_COST = 1.5  # of looking into a node, with the test of one triangle as the unit
LARGE_NODE = 64  # with more triangles than this on average ...
BINS = 16  # ... there are so many bins, along the widest axis;
FEW_BINS = 8  # with fewer triangles so many along each axis
DEEPEST = 32  # from this level on nodes are halved, so that no mesh makes a list of the tree
OUTSIDE = np.float32(2.0)  # an empty bin's lowest side: above every one, as all are in -1..1
NARROW = np.float32(1e-30)  # centres this close to each other cannot be told apart


class Growth:
    """The tree while it grows: the level at hand, and the triangles not in a leaf yet.

    Parameters
    ----------
    sides : (6, F) float32
        Of every triangle its lowest x, y, z and minus its highest x, y, z, all within -1..1:
        so all six of a group are found by taking minima.
    """

    def __init__(self, sides: Singles) -> None:
        size = sides.shape[1]
        self.triangle = np.arange(size)
        self.sides = sides
        self.middle = np.float32(0.5) * (sides[:3] - sides[3:])
        self.node = np.zeros(size, dtype=np.int64)  # of each triangle, within the level
        self.leaf_of = np.zeros(size, dtype=np.int64)  # of each triangle, within the tree
        self.first = np.zeros(min(size, 1), dtype=np.int64)
        self.count = np.full(min(size, 1), size, dtype=np.int64)
        self.done: list[tuple[Ints, Ints, Ints]] = []  # child, first, count of each level
        self.total = 0

    def tree(self) -> tuple[Ints, Ints, Ints, Ints]:
        """Child, first and count of all nodes, and where each level starts."""
        levels = np.cumsum([0] + [len(child) for child, _, _ in self.done])
        if not self.done:
            none = np.zeros(0, dtype=np.int64)
            return none, none, none, levels
        child, first, count = (np.concatenate(rows) for rows in zip(*self.done, strict=True))
        return child, first, count, levels

    def grow(self) -> bool:
        """Cut the nodes of the level at hand in two or make them leaves; False at the end."""
        nodes = len(self.count)
        if nodes == 0:
            return False
        gain, right = self._cut()
        leaf = (self.count <= SMALLEST_LEAF) | ((self.count <= LARGEST_LEAF) & (gain <= 0.0))
        self._halve(~leaf & (gain == -np.inf), right)
        after = self.total + nodes
        child = np.where(leaf, -1, after + 2 * (np.cumsum(~leaf) - 1))
        self.done.append((child, self.first, self.count))

        # Triangles of inner nodes go on to the left or right child, where few stay for good.
        going = np.flatnonzero(~leaf[self.node])
        node = child[self.node[going]] + right[going]
        self.leaf_of[self.triangle[going]] = node
        node -= after
        count = np.bincount(node, minlength=2 * int(np.sum(~leaf)))
        many = count[node] > SMALLEST_LEAF
        going, self.node = going[many], node[many]
        self.triangle = self.triangle[going]
        self.sides = np.take(self.sides, going, axis=1)
        self.middle = np.take(self.middle, going, axis=1)

        # Those of the left child keep the slots from the parent's first on.
        self.first = np.repeat(self.first[~leaf], 2)
        self.first[1::2] += count[0::2]
        self.count, self.total = count, after
        return True

    def _cut(self) -> tuple[Floats, NDArray[np.bool_]]:
        """What the best cut of each node gains over a leaf, and who goes to the right of it.

        The gain is −inf where no cut separates any two triangles, or none is looked for.
        """
        nodes = len(self.count)
        best = np.full(nodes, np.inf, dtype=np.float32)
        right = np.zeros(len(self.node), dtype=bool)
        whole = np.zeros(nodes, dtype=np.float32)
        if len(self.done) < DEEPEST:
            large = len(self.node) >= LARGE_NODE * nodes
            low, width = self._middles()
            axes = [np.argmax(width, axis=0)] if large else [0, 1, 2]
            for axis in axes:
                cell = self._cells(low, width, axis, BINS if large else FEW_BINS)
                cost, place, whole = self._costs(cell, BINS if large else FEW_BINS)
                better = cost < best
                best, place = np.where(better, cost, best), np.where(better, place, BINS)
                right = np.where(better[self.node], cell > place[self.node], right)
        gain = whole * (self.count - BOX_COST) - best
        return gain, right

    def _middles(self) -> tuple[Singles, Singles]:
        """Of each node, where the middles of its triangles start and how wide they lie, (3, n)."""
        low = np.full((3, len(self.count)), OUTSIDE)
        high = -low
        for k, middle in enumerate(self.middle):
            np.minimum.at(low[k], self.node, middle)
            np.maximum.at(high[k], self.node, middle)
        return low, high - low

    def _cells(self, low: Singles, width: Singles, axis: Ints | int, bins: int) -> Ints:
        """In which of the bins along the axis of its node the middle of each triangle lies."""
        if isinstance(axis, int):
            middle, low, width = self.middle[axis], low[axis], width[axis]
        else:
            node = np.arange(len(axis))
            middle = self.middle[axis[self.node], np.arange(len(self.node))]
            low, width = low[axis, node], width[axis, node]
        scale = np.where(width > NARROW, bins / np.maximum(width, NARROW), np.float32(0.0))
        cell = ((middle - low[self.node]) * scale[self.node]).astype(np.int64)
        return np.asarray(np.minimum(cell, bins - 1))

    def _costs(self, cell: Ints, bins: int) -> tuple[Singles, Ints, Singles]:
        """Cost and place (last bin of the left side) of the best cut, and the node's surface."""
        nodes = len(self.count)
        key = cell * nodes + self.node
        count = np.bincount(key, minlength=bins * nodes).reshape(bins, nodes)
        flat = np.full((6, bins * nodes), OUTSIDE, dtype=np.float32)
        for side, values in zip(flat, self.sides, strict=True):
            np.minimum.at(side, key, values)
        box = flat.reshape(6, bins, nodes)

        # From the right end: what lies beyond each place; then from the left end.
        beyond = np.empty((bins, nodes), dtype=np.float32)
        rest, number = box[:, -1].copy(), count[-1].copy()
        for place in range(bins - 2, -1, -1):
            beyond[place] = half_surface(rest) * number
            np.minimum(rest, box[:, place], out=rest)
            number += count[place]
        whole = half_surface(rest)
        best = np.full(nodes, np.inf, dtype=np.float32)
        where = np.zeros(nodes, dtype=np.int64)
        rest, number = box[:, 0].copy(), count[0].copy()
        for place in range(bins - 1):
            cost = half_surface(rest) * number + beyond[place]
            better = (cost < best) & (number > 0) & (number < self.count)
            best, where = np.where(better, cost, best), np.where(better, place, where)
            np.minimum(rest, box[:, place + 1], out=rest)
            number += count[place + 1]
        return best, where, whole

    def _halve(self, chosen: NDArray[np.bool_], right: NDArray[np.bool_]) -> None:
        """Send the later half of the triangles of the chosen nodes to the right."""
        mine = np.flatnonzero(chosen[self.node])
        mine = mine[np.argsort(self.node[mine], kind="stable")]
        number = np.where(chosen, self.count, 0)
        start = np.cumsum(number) - number
        rank = np.arange(len(mine)) - start[self.node[mine]]
        right[mine] = 2 * rank >= self.count[self.node[mine]]


def half_surface(sides: Singles) -> Singles:
    """Half the surface of boxes with the sides (6, ...): lowest x, y, z, minus the highest."""
    x, y, z = -sides[:3] - sides[3:]
    return np.asarray(x * y + y * z + z * x)
