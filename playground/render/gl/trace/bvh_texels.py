"""Trees of boxes as two textures, for shaders/trace/bvh.glsl.

Two levels of a `Bvh` become one: a node of the GPU's tree has four children, grandchildren
where they are. Half as many steps, each with four boxes at once, are a fifth to a quarter
faster on llvmpipe. A side of a box takes 16 bits, counted in cells of the mesh's own box and
rounded outwards, so that a child is one texel: a quarter of the memory traffic of floats.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from playground.render.trace.bvh import Bvh

Ints = NDArray[np.int64]
Words = NDArray[np.uint32]
Singles = NDArray[np.float32]
Number = TypeVar("Number", np.uint32, np.float32)

ROW_BITS = 12  # a row of the textures has 2^12 texels: GL 3.3 has no longer ones to rely on
CELLS = 65535  # along each side of the mesh's box
LEAF = 1 << 31  # a word with this bit is a leaf: first slot · 16 + number of triangles
PUSHED = 3  # children that wait while the walk goes on with the fourth


@dataclass(frozen=True, eq=False)
class Tree:
    """One mesh's part of the textures.

    ``root`` is the word to start from; ``low`` and ``cell`` (3,) turn object space into
    cells; ``first_slot`` plus a slot of the `Bvh` is the slot that the shader gives.
    """

    root: int
    low: Singles
    cell: Singles
    first_slot: int


@dataclass(frozen=True, eq=False)
class BvhTexels:
    """What the shader reads, and what it must be compiled with.

    Parameters
    ----------
    nodes : (H, 4096, 4) uint32
        A texel per child, four to a node: low and high side in 16 bits each for x, y, z, and a
        word: number of the child's node, or `LEAF`.
    corners : (H, 4096, 4) float32
        Three texels per slot: its corners; the fourth number is 0.
    trees : one `Tree` per `Bvh`
    stack : int
        Words that a walk holds back at most.
    """

    nodes: Words
    corners: Singles
    trees: tuple[Tree, ...]
    stack: int

    @property
    def defines(self) -> Mapping[str, int]:
        """What to inject into a shader that includes ``trace/bvh.glsl``."""
        return {"BVH_STACK": self.stack, "BVH_ROW_BITS": ROW_BITS}


def bvh_texels(bvhs: Sequence[Bvh]) -> BvhTexels:
    """All trees in one pair of textures; each has at least one triangle."""
    nodes, corners, trees, levels = [], [], [], 1
    node, slot = 0, 0
    for bvh in bvhs:
        low, cell = _grid(bvh)
        wide, depth = _wide(bvh.child)
        nodes.append(_texels(bvh, wide, low, cell, node, slot))
        corners.append(bvh.corners.reshape(-1, 3).astype(np.float32))
        root = node if len(wide) else _leaf_words(bvh, slot)[0]
        trees.append(Tree(int(root), low, cell, slot))
        node, slot, levels = node + len(wide), slot + len(bvh.order), max(levels, depth)
    flat = np.concatenate([*corners, np.zeros((0, 3), np.float32)])
    points = np.concatenate([flat, np.zeros((len(flat), 1), np.float32)], axis=1)
    words = np.concatenate([*nodes, np.zeros((0, 4), np.uint32)])
    return BvhTexels(_rows(words), _rows(points), tuple(trees), PUSHED * levels)


def _grid(bvh: Bvh) -> tuple[Singles, Singles]:
    """The lowest corner of the mesh and the size of a cell, so that `CELLS` of them hold it."""
    low, high = bvh.low[0].astype(np.float64), bvh.high[0].astype(np.float64)
    cell = ((high - low) / CELLS).astype(np.float32)
    cell = np.where(
        cell * np.float64(CELLS) < high - low, np.nextafter(cell, np.float32(1e38)), cell
    )
    return bvh.low[0], np.where(high > low, cell, np.float32(1.0)).astype(np.float32)


def _wide(child: NDArray[np.int32]) -> tuple[Ints, int]:
    """The four children of each wide node, (W, 4), −1 for none; and how many levels they make.

    Wide nodes are numbered from the root on, level by level, in the order of their children.
    """
    rows = []
    level = np.flatnonzero(child[:1] >= 0)
    while len(level):
        pair = child[level][:, None] + np.arange(2)
        inner = child[pair] >= 0
        four = np.stack(
            [np.where(inner, child[pair], pair), np.where(inner, child[pair] + 1, -1)], -1
        )
        rows.append(four.reshape(-1, 4).astype(np.int64))
        below = rows[-1].ravel()
        level = below[(below >= 0) & (child[below] >= 0)]
    return np.concatenate([*rows, np.zeros((0, 4), np.int64)]), len(rows)


def _texels(
    bvh: Bvh, wide: Ints, low: Singles, cell: Singles, first_node: int, first_slot: int
) -> Words:
    """The texels (4 W, 4) of a tree's wide nodes."""
    start = (bvh.low.astype(np.float64) - low) / cell
    end = (bvh.high.astype(np.float64) - low) / cell
    lowest = np.clip(np.floor(start), 0, CELLS).astype(np.uint32)
    highest = np.clip(np.ceil(end), 0, CELLS).astype(np.uint32)

    # Every inner node among the children is the next wide node; the root is the first.
    children = wide.ravel()
    inner = (children >= 0) & (bvh.child[children] >= 0)
    word = np.where(inner, first_node + np.cumsum(inner), _leaf_words(bvh, first_slot)[children])
    box = (lowest | (highest << np.uint32(16)))[children]

    # Where there is no child: a box inside out, and a leaf without triangles.
    none = children < 0
    box[none], word[none] = CELLS, LEAF
    return np.concatenate([box, word[:, None].astype(np.uint32)], axis=1)


def _leaf_words(bvh: Bvh, first_slot: int) -> Ints:
    return LEAF | ((first_slot + bvh.first.astype(np.int64)) << 4) | np.minimum(bvh.count, 15)


def _rows(texels: NDArray[Number]) -> NDArray[Number]:
    """The texels (n, 4) in rows of a texture, (H, 4096, 4), at least one row."""
    width = 1 << ROW_BITS
    rows = np.zeros((max(-(-len(texels) // width), 1) * width, 4), dtype=texels.dtype)
    rows[: len(texels)] = texels
    return rows.reshape(-1, width, 4)
