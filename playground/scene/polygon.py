"""Cuts polygons into triangles: fans where they are convex, ears where they are not.

Knows corners and their positions. Must not know files or `Mesh`.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from playground.scene.normals import cross

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

SLACK = 1e-9  # sine of an inner angle that still counts as straight


def triangles(positions: Floats, sizes: Integers) -> Integers:
    """Corner numbers of the triangles, (M, 3): polygon by polygon, each with its own winding.

    Parameters
    ----------
    positions : float64 array of shape (C, 3)
        All corners of the first polygon, then of the second, ...
    sizes : int64 array of shape (F,), each at least 3
        How many corners each polygon has.
    """
    cut = _fans(sizes)
    first = np.cumsum(sizes) - sizes
    before = np.cumsum(sizes - 2) - (sizes - 2)  # triangles of the polygons before
    for number in _concave(positions, sizes):
        start, count = first[number], sizes[number]
        ears = _ears(_flattened(positions[start : start + count]))
        cut[before[number] : before[number] + count - 2] = start + np.array(ears)
    return cut


def _fans(sizes: Integers) -> Integers:
    """Each polygon cut from its first corner."""
    starts = np.cumsum(sizes) - sizes
    counts = sizes - 2
    first = np.repeat(starts, counts)
    step = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
    return np.stack([first, first + step + 1, first + step + 2], axis=1)


def _concave(positions: Floats, sizes: Integers) -> Integers:
    """The numbers of the polygons that have an inner angle above 180 degrees."""
    wide = np.flatnonzero(sizes > 3)
    if not len(wide):
        return wide
    kept = np.repeat(sizes > 3, sizes)
    places, counts = positions[kept], sizes[wide]
    starts = np.cumsum(counts) - counts
    after, before = np.arange(len(places)) + 1, np.arange(len(places)) - 1
    after[starts + counts - 1], before[starts] = starts, starts + counts - 1
    owner = np.repeat(np.arange(len(wide)), counts)
    with np.errstate(all="ignore"):  # absurd sizes are refused later, with the file's name
        edges = places[after] - places
        turns = cross(edges[before], edges)
        spokes = places - places[starts][owner]
        normals = np.add.reduceat(cross(spokes, spokes[after]), starts)[owner]
        length = np.linalg.norm(edges, axis=1)
        scale = length * length[before] * np.linalg.norm(normals, axis=1)
        inward = np.einsum("ci,ci->c", turns, normals) < -SLACK * scale
    concave: Integers = wide[np.unique(owner[inward])]
    return concave


def _flattened(corners: Floats) -> Floats:
    """One polygon in the plane that shows most of it, counter-clockwise, about size 1."""
    corners = corners - corners[0]
    corners = corners / np.abs(corners).max()
    normal = np.cross(corners, np.roll(corners, -1, axis=0)).sum(axis=0)
    axis = int(np.argmax(np.abs(normal)))
    keep = [(axis + 1) % 3, (axis + 2) % 3]
    return corners[:, keep if normal[axis] > 0 else keep[::-1]]


def _ears(plane: Floats) -> list[tuple[int, int, int]]:
    """The n - 2 triangles of a simple polygon (n, 2), cut off one by one."""
    left, ears, at = list(range(len(plane))), [], 0
    while len(left) > 3:
        count = len(left)
        turned = [(at + k) % count for k in range(count)]
        # A polygon that crosses itself may have no ear; then the least harm is a convex corner
        convex = (i for i in turned if _turn(plane, left, i) > SLACK)
        i = next((i for i in turned if _is_ear(plane, left, i)), None)
        i = next(convex, turned[0]) if i is None else i
        ears.append((left[i - 1], left[i], left[(i + 1) % count]))
        del left[i]
        at = i % len(left)
    return [*ears, (left[0], left[1], left[2])]


def _turn(plane: Floats, left: list[int], i: int) -> float:
    """Twice the area of the triangle at the i-th corner that is left; above 0 where convex."""
    a, b, c = plane[left[i - 1]], plane[left[i]], plane[left[(i + 1) % len(left)]]
    return float((b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0]))


def _is_ear(plane: Floats, left: list[int], i: int) -> bool:
    """Whether the triangle at the i-th corner is inside and holds no other corner."""
    if _turn(plane, left, i) <= 0.0:
        return False
    triangle = plane[[left[i - 1], left[i], left[(i + 1) % len(left)]]]
    others = plane[left]
    inside = np.ones(len(left), dtype=bool)
    for a, b in zip(triangle, np.roll(triangle, -1, axis=0), strict=True):
        x, y = (others - a).T
        inside &= (b[0] - a[0]) * y - (b[1] - a[1]) * x >= 0.0
    # Corners at the same place, as where a slit leads to a hole, do not count
    apart = (others[:, None] != triangle[None]).any(axis=2).all(axis=1)
    return not bool(np.any(inside & apart))
