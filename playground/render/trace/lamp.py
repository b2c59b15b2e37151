"""Where on an area light its shadow rays go: always the same points, well spread."""

from __future__ import annotations

import numpy as np

from playground.scene.polygon import triangles
from playground.shading.floats import Array
from playground.shading.vector import unit

ALIKE = 1e-12  # lengths that differ by less of themselves are the same but for rounding
GOLDEN = (5.0**0.5 - 1.0) / 2.0


def square_points(count: int) -> Array:
    """``count`` points in the unit square, (count, 2): each has its own place along both sides.

    The Fibonacci lattice ((i + ½)/n, (i + ½) φ mod 1): along an edge of a shadow, whichever
    way it runs, the light fades in about n steps; a grid of √n × √n points has √n where the
    edge is parallel to it.
    Source: Hannay, Nye, Fibonacci Numerical Integration on a Sphere, J. Phys. A 37, 2004.
    """
    middle = np.arange(count) + 0.5
    return np.stack([middle / count, middle * GOLDEN % 1.0], axis=1)


def points_on(corners: Array, count: int) -> Array:
    """``count`` points on a flat polygon of corners (K, 3), each for the same area; (count, 3)."""
    square = square_points(count)
    if parallelogram(corners):
        sides = np.stack([corners[1] - corners[0], corners[3] - corners[0]])
        return np.asarray(corners[0] + square @ sides)

    # Cut the square into strips, as wide as triangles are large, and map each onto its triangle.
    pieces = corners[triangles(corners, np.array([len(corners)]))]
    a, b, c = np.moveaxis(pieces, 1, 0)
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    ends = np.cumsum(area) / area.sum()
    piece = np.minimum(np.searchsorted(ends, square[:, 0]), len(ends) - 1)
    starts = np.concatenate([[0.0], ends[:-1]])
    along = np.sqrt((square[:, 0] - starts[piece]) / (ends - starts)[piece])[:, None]
    across = square[:, 1:]
    return np.asarray(
        (1.0 - along) * a[piece] + along * ((1.0 - across) * b[piece] + across * c[piece])
    )


def parallelogram(corners: Array) -> bool:
    """Whether corners (K, 3) are four, and opposite sides equal."""
    if len(corners) != 4:
        return False
    a, b, c, d = corners - corners[0]
    return bool(np.abs(a - b + c - d).max() <= ALIKE * np.abs(c).max())


def facing_of(corners: Array) -> Array:
    """The unit normal of the side that shines, (3,), by Newell's sum over the edges."""
    middle = corners - corners.mean(axis=0)
    return unit(np.cross(middle, np.roll(middle, -1, axis=0)).sum(axis=0))
