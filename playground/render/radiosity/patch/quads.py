"""Finds the quads that were cut into triangles, so that patches can be cut evenly again."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from playground.scene.normals import direction
from playground.shading.floats import Array
from playground.shading.vector import cross, dot

Integers = NDArray[np.int64]

# A corner of a quad is at least this far, as a sine, from being straight or folded.
SHARPEST = 0.02
# Two triangles that no polygon of a file holds together become a quad only if it is a decent
# one: the cosine of its corners is at most that of 30 degrees.
MOST_SKEWED = 0.87
# A fourth corner off the plane of three by this share of the quad's longest edge bends it.
BENT = 1e-3


def quads(places: Array, faces: Integers, rounding: float) -> Integers:
    """Triangles and flat convex quads, (M, 4), of triangles (F, 3); a triangle repeats its last.

    Two triangles that share an edge and lie in one plane may become one quad. Those that follow
    each other as the halves of a polygon do are joined first, then those that form the best
    rectangle; so the same mesh always gives the same quads, in the order of their first triangles.

    Parameters
    ----------
    places : float64 array of shape (V, 3)
    faces : int64 array of shape (F, 3), without degenerate triangles
    rounding : float
        How far a corner may lie off the plane of the others because coordinates are rounded.
    """
    first, second, edge = _neighbours(faces, len(places))
    corners = _joined(faces, first, second, edge)
    sound, skew = _shape(places[corners], rounding)
    halves = (second == first + 1) & _halves(faces, first, second)
    sound &= halves | (skew <= MOST_SKEWED)
    pairs = np.flatnonzero(sound)
    rank = np.where(halves, -1.0, np.round(skew, 6))
    pairs = pairs[np.lexsort((second[pairs], first[pairs], rank[pairs]))]

    # Take the best pair of which neither triangle is taken
    free = [True] * len(faces)
    taken = []
    for pair, i, j in zip(
        pairs.tolist(), first[pairs].tolist(), second[pairs].tolist(), strict=True
    ):
        if free[i] and free[j]:
            free[i] = free[j] = False
            taken.append(pair)
    chosen = np.array(taken, dtype=np.int64)
    alone = np.flatnonzero(free)
    pieces = np.concatenate([corners[chosen], faces[alone][:, [0, 1, 2, 2]]])
    order = np.argsort(np.concatenate([first[chosen], alone]), kind="stable")
    return np.asarray(pieces[order])


def _neighbours(faces: Integers, count: int) -> tuple[Integers, Integers, Integers]:
    """Pairs of triangles i < j that run along an edge in opposite directions, and i's edge."""
    after = np.roll(faces, -1, axis=1)
    forward = (faces * count + after).ravel()
    backward = (after * count + faces).ravel()
    order = np.argsort(forward, kind="stable")
    slot = np.minimum(np.searchsorted(forward[order], backward), len(order) - 1)
    other = order[slot]
    met = np.flatnonzero(forward[other] == backward)
    first, second = met // 3, other[met] // 3
    once = first < second
    return first[once], second[once], met[once] % 3


def _joined(faces: Integers, first: Integers, second: Integers, edge: Integers) -> Integers:
    """The quads (K, 4): the first triangle, with the far corner of the second after ``edge``."""
    rows = np.arange(len(first))
    start = faces[first, edge]
    after = faces[second]
    # The second triangle runs from the end of the edge to its start, then to the far corner
    far = after[rows, (np.argmax(after == start[:, None], axis=1) + 1) % 3]
    slots = np.arange(4)[None, :]
    kept = faces[first[:, None], np.where(slots > edge[:, None], slots - 1, slots) % 3]
    return np.asarray(np.where(slots == edge[:, None] + 1, far[:, None], kept))


def _halves(faces: Integers, first: Integers, second: Integers) -> NDArray[np.bool_]:
    """Which pairs are (a, b, c) and (a, c, d), as readers of files cut a polygon."""
    i, j = faces[first], faces[second]
    return np.asarray((i[:, 0] == j[:, 0]) & (i[:, 2] == j[:, 1]))


def _shape(polygon: Array, rounding: float) -> tuple[NDArray[np.bool_], Array]:
    """Which quads (K, 4, 3) are flat and convex, and the largest |cosine| of their corners."""
    edges = np.roll(polygon, -1, axis=1) - polygon
    along = direction(edges)
    diagonals = polygon[:, 2] - polygon[:, 0], polygon[:, 3] - polygon[:, 1]
    normal = direction(cross(direction(diagonals[0]), direction(diagonals[1])))
    turns = dot(cross(np.roll(along, 1, axis=1), along), normal[:, None])
    height = np.abs(dot(edges[:, 0], normal))  # of the quad's middle plane, twice the way to it
    longest = np.sqrt(dot(edges, edges).max(axis=1, initial=0.0))
    flat = (height <= 2.0 * rounding) & (height <= BENT * longest)
    skew = np.abs(dot(np.roll(along, 1, axis=1), along)).max(axis=1, initial=0.0)
    return flat & (turns.min(axis=1, initial=1.0) >= SHARPEST), skew
