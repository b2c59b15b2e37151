"""Which triangle of a tree each of many rays meets first, without a loop over rays.

A step takes pairs (ray, node) from the top of a stack, tests the boxes of both children of
each node, and puts back the farther ones, then the nearer ones: every ray goes from front to
back, thousands side by side. Rays are done in blocks, so that what a step touches stays in
the processor's cache. Twin in spirit: shaders/trace/bvh.glsl.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from playground.render.trace.bvh import Bvh
from playground.shading.ray import NO_HIT
from playground.shading.triangle import ray_shear, sheared_triangle

Ints = NDArray[np.int64]
Floats = NDArray[np.float64]

BLOCK = 32768  # rays that go together

# How far a hit can be from its triangle: a corner, carried to the ray's frame, is off by six
# roundings of its distance, a face of a box by three. Boxes are widened by more than both, so that
# none loses a triangle that the watertight test would find.
# Source: Woop, Benthin, Wald, Watertight Ray/Triangle Intersection, JCGT 2(1), 2013, section 4.
UNIT = float(np.finfo(np.float64).eps) / 2.0
WIDER = 16.0 * UNIT

# A component of a direction that is smaller than this share of the largest one moves a ray by
# less than a rounding; it is raised to that share, so that one may divide by it.
STILL = 1e-30


def closest(
    bvh: Bvh, origin: ArrayLike, direction: ArrayLike, limit: ArrayLike
) -> tuple[Floats, Ints, Floats]:
    """The first triangle along each ray; of several at the very same t, any of them.

    Parameters
    ----------
    origin, direction : (N, 3) arrays
        The direction may have any length but 0; t is in units of it.
    limit : (N,) array or a number
        Only hits with 0 < t < limit count; inf for all.

    Returns
    -------
    t : (N,) float64, `NO_HIT` = −1 for a miss
    triangle : (N,) int64, the number of the triangle in the mesh, −1 for a miss
    weights : (N, 3) float64, of the triangle's corners, 0 for a miss
    """
    found = _walk(bvh, origin, direction, limit, any_hit=False)
    number = np.append(bvh.order, -1)[found.slot].astype(np.int64)
    return np.where(found.slot >= 0, found.t, NO_HIT), number, found.weights.T


def blocked(
    bvh: Bvh, origin: ArrayLike, direction: ArrayLike, limit: ArrayLike
) -> NDArray[np.bool_]:
    """Whether each ray meets any triangle with 0 < t < limit, (N,); arguments as `closest`."""
    return np.asarray(_walk(bvh, origin, direction, limit, any_hit=True).slot >= 0)


def count_tests(
    bvh: Bvh, origin: ArrayLike, direction: ArrayLike, limit: ArrayLike, *, any_hit: bool = False
) -> tuple[Ints, Ints]:
    """How many boxes and how many triangles are tested for each ray, (N,) each.

    Arguments as `closest`; ``any_hit`` counts what `blocked` does. What a heat map shows.
    """
    boxes, triangles = _walk(bvh, origin, direction, limit, any_hit, counted=True).tests
    return boxes, triangles


def _walk(
    bvh: Bvh,
    origin: ArrayLike,
    direction: ArrayLike,
    limit: ArrayLike,
    any_hit: bool,
    counted: bool = False,
) -> _Found:
    """Send all rays through the tree, block by block."""
    start = np.asarray(origin, dtype=np.float64).reshape(-1, 3)
    along = np.asarray(direction, dtype=np.float64).reshape(-1, 3)
    reach = np.broadcast_to(np.asarray(limit, dtype=np.float64), len(start))
    size = len(start)
    found = _Found(
        reach.copy(), np.full(size, -1), np.zeros((3, size)), np.zeros((2, size), dtype=np.int64)
    )
    for first in range(0, size if bvh.nodes else 0, BLOCK):
        part = slice(first, first + BLOCK)
        rays = _Rays(bvh, start[part], along[part], found.part(part), any_hit, counted)
        while rays.step():
            pass
    return found


class _Found(NamedTuple):
    """What N rays have met so far: t (N,), slot (N,), weights (3, N), tests (2, N)."""

    t: Floats
    slot: Ints
    weights: Floats
    tests: Ints

    def part(self, rays: slice) -> _Found:
        """The same arrays, seen for some of the rays."""
        weights, tests = self.weights[:, rays], self.tests[:, rays]
        return _Found(self.t[rays], self.slot[rays], weights, tests)


class _Rays:
    """A block of rays on their way through a tree; they write into their part of `_Found`."""

    def __init__(
        self,
        bvh: Bvh,
        origin: Floats,
        direction: Floats,
        found: _Found,
        any_hit: bool,
        counted: bool,
    ) -> None:
        size = len(origin)
        self.bvh, self.any_hit, self.counted = bvh, any_hit, counted
        self.t, self.slot, self.weights, self.tests = found

        # For boxes: the ray component by component. For triangles: the three axes of its shear.
        self.origin = np.ascontiguousarray(origin.T)
        size_of = np.abs(direction)
        least = STILL * np.max(size_of, axis=1, keepdims=True)
        self.inverse = 1.0 / np.copysign(np.maximum(size_of, least), direction).T
        low, high = bvh.sides[:3, :1], bvh.sides[3:, :1]
        self.wider = WIDER * np.max(np.maximum(high - self.origin, self.origin - low), axis=0)
        shear = ray_shear(direction)
        number, root = np.arange(size), np.zeros(size, dtype=np.int64)
        z = np.argmax(size_of, axis=1)
        self.axes = np.stack([(z + 1) % 3, (z + 2) % 3, z])
        self.turned = self.origin[self.axes, number]
        self.shear = shear[number, :, z].T

        self.stack = np.zeros((2, 4 * size), dtype=np.int64)  # ray, node
        self.entry = np.zeros(4 * size)
        self.top = 0
        self._push(number, root, self._entry(number, root))

    def step(self) -> bool:
        """Look into the nodes of the topmost pairs; False when no pair is left."""
        if self.top == 0:
            return False
        bottom = max(self.top - BLOCK, 0)
        ray, node = self.stack[:, bottom : self.top]
        near = np.flatnonzero(self.entry[bottom : self.top] <= self.t[ray])
        ray, node = ray[near], node[near]
        self.top = bottom
        child = self.bvh.child[node]
        leaf = child < 0
        if leaf.any():
            self._look_into(ray[leaf], node[leaf])
            ray, child = ray[~leaf], child[~leaf]

        # The farther children go below the nearer ones, which are looked into next.
        left = child.astype(np.int64)
        entry, other = self._entry(ray, left), self._entry(ray, left + 1)
        swap = other < entry
        self._push(ray, left + ~swap, np.maximum(entry, other))
        self._push(ray, left + swap, np.minimum(entry, other))
        return True

    def _entry(self, ray: Ints, node: Ints) -> Floats:
        """Where (t) each ray enters the box of its node; inf if it misses it or comes too late."""
        entry, leave, wider = np.zeros(len(ray)), self.t[ray], self.wider[ray]
        if self.counted:
            self.tests[0] += np.bincount(ray, minlength=len(self.t))
        for k in range(3):
            origin, inverse = self.origin[k][ray], self.inverse[k][ray]
            a = (self.bvh.sides[k][node] - origin - wider) * inverse
            b = (self.bvh.sides[k + 3][node] - origin + wider) * inverse
            np.maximum(entry, np.minimum(a, b), out=entry)
            np.minimum(leave, np.maximum(a, b, out=b), out=leave)
        return np.where(entry <= leave, entry, np.inf)

    def _push(self, ray: Ints, node: Ints, entry: Floats) -> None:
        """Put the pairs whose ray enters the box on the stack."""
        met = np.flatnonzero(entry < np.inf)
        end = self.top + len(met)
        if end > len(self.entry):
            self.stack = np.concatenate([self.stack, np.zeros_like(self.stack)], axis=1)
            self.entry = np.concatenate([self.entry, np.zeros_like(self.entry)])
        self.stack[0, self.top : end] = ray[met]
        self.stack[1, self.top : end] = node[met]
        self.entry[self.top : end] = entry[met]
        self.top = end

    def _look_into(self, ray: Ints, leaf: Ints) -> None:
        """Test all triangles of the leaves, and keep for each ray the first hit."""
        count = self.bvh.count[leaf]
        last = np.cumsum(count)
        slot = np.arange(len(leaf) and last[-1]) + np.repeat(
            self.bvh.first[leaf] - last + count, count
        )
        ray = np.repeat(ray, count)
        if self.counted:
            self.tests[1] += np.bincount(ray, minlength=len(self.t))
        t, weights = self._triangles(ray, slot)
        hit = np.flatnonzero((t > 0.0) & (t < self.t[ray]))
        ray, t = ray[hit], t[hit]
        np.minimum.at(self.t, ray, t)
        first = np.flatnonzero(t == self.t[ray])
        self.slot[ray[first]] = slot[hit[first]]
        self.weights[:, ray[first]] = weights[hit[first]].T
        if self.any_hit:
            self.t[ray] = -np.inf

    def _triangles(self, ray: Ints, slot: Ints) -> tuple[Floats, Floats]:
        """The t and weights (M, 3) with which each ray meets the triangle in its slot."""
        axes, origin, shear = self.axes[:, ray], self.turned[:, ray], self.shear[:, ray]
        flat = self.bvh.corners.ravel()
        corners = []
        for corner in range(3):
            x, y, z = (flat[9 * slot + 3 * corner + axes[k]] - origin[k] for k in range(3))
            corners.append(np.stack([x + shear[0] * z, y + shear[1] * z, shear[2] * z]).T)
        return sheared_triangle(*corners)
