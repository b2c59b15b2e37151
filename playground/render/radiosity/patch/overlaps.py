"""Which surfaces lie in one plane and cover each other."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from playground.render.radiosity.patch.edges import places
from playground.scene.normals import direction
from playground.shading.floats import Array
from playground.shading.vector import cross, dot

Integers = NDArray[np.int64]
PARALLEL = 1e-5  # normals that differ by less in each component are of parallel planes
PAIRS = 200_000  # that are looked at side by side


def overlaps(polygon: Array, owner: NDArray[np.integer], tolerance: float) -> Integers:
    """Pairs (K, 2) of convex polygons (M, 4, 3) of different owners that share an area.

    They lie in one plane, whichever way they look, and no line parts them: two convex polygons
    have a point in common unless one of their edges is such a line (separating axes).
    ``tolerance`` is the distance up to which they may stick into each other.
    """
    area = cross(polygon[:, 2] - polygon[:, 0], polygon[:, 3] - polygon[:, 1])
    normal = direction(area)
    largest = np.take_along_axis(normal, np.abs(normal).argmax(axis=1)[:, None], axis=1)
    normal = normal * np.sign(largest)
    height = dot(normal, polygon[:, 0])
    plane = places(normal, PARALLEL) * len(polygon)
    level = places(np.column_stack([height, 0 * height, 0 * height]), tolerance)
    _, group = np.unique(plane + level, return_inverse=True)
    found = [np.zeros((0, 2), dtype=np.int64)]
    for first, second in _pairs(group, owner):
        touch = _share(polygon[first], polygon[second], normal[first], tolerance)
        found.append(np.stack([first[touch], second[touch]], axis=1))
    return np.concatenate(found)


def _pairs(group: Integers, owner: NDArray[np.integer]) -> Iterator[tuple[Integers, Integers]]:
    """Pairs of one group and different owners, some at a time."""
    order = np.argsort(group, kind="stable")
    many = np.bincount(group)
    start = np.cumsum(many) - many
    # Each with all after it in its group
    left = start[group[order]] + many[group[order]] - np.arange(len(order)) - 1
    ends = np.cumsum(left)
    at = 0
    while at < len(order):
        until = max(int(np.searchsorted(ends, (ends[at - 1] if at else 0) + PAIRS)), at + 1)
        count = left[at:until]
        slot = np.repeat(np.arange(at, at + len(count)), count)
        step = np.arange(len(slot)) - np.repeat(np.cumsum(count) - count, count)
        first, second = order[slot], order[slot + 1 + step]
        other = owner[first] != owner[second]
        yield first[other], second[other]
        at = until


def _share(first: Array, second: Array, normal: Array, tolerance: float) -> NDArray[np.bool_]:
    """Which pairs of polygons (K, 4, 3) in a plane overlap by more than ``tolerance``."""
    both = np.concatenate([first, second], axis=1)
    edges = np.concatenate([np.roll(p, -1, axis=1) - p for p in (first, second)], axis=1)
    axis = direction(cross(edges, np.broadcast_to(normal[:, None], edges.shape)))
    along = np.einsum("kai,kci->kac", axis, both - both[:, :1])
    one, other = along[..., :4], along[..., 4:]
    depth = np.minimum(one.max(-1), other.max(-1)) - np.maximum(one.min(-1), other.min(-1))
    depth = np.where(np.any(edges != 0.0, axis=-1), depth, np.inf)
    return np.asarray((depth > tolerance).all(axis=1))
