"""Gathered light with the pattern of its rays taken out.

Each texel of a block of 4 × 4 gathers with other rays (see `gather.PATTERNS`). A plane is then
fitted to the light of the 5 × 5 texels around each, the outer ones weighed half, so that every
pattern has the same weight: 16 times the rays, at the price of fine detail fainter than their
noise. Light that is linear over the surface stays as it is, edges of charts included.
Source: Keller, Heidrich, Interleaved Sampling, EGWR 2001.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from playground.render.lightmap.gather import Points
from playground.render.lightmap.surroundings import Surroundings
from playground.render.lightmap.texels import Texels
from playground.shading.floats import Array
from playground.shading.vector import dot

Ints = NDArray[np.intp]
HALF = {-2: 0.5, -1: 1.0, 0: 1.0, 1: 1.0, 2: 0.5}
OFFSETS = [(x, y) for y in (0, 1, 2) for x in range(-2, 3) if y > 0 or x > 0]
ABOVE = 0.5  # texels over the surface at which neighbours must see each other
LOW = 0.125  # the same, to find walls: what is lower throws no shadow to speak of
ALIKE = 0.9  # cosine between the normals of neighbours
SAME = 1e-3  # texels: beyond the corner of a chart, several stand for one point
STRETCH = 1.5  # neighbours may be this much farther apart than texels are wide
# The mean of n rays, spread evenly over the hemisphere, is off by about 1.5 n^−¾ of the light in
# the rooms of the library; a step of more than five times that is no noise.
NOISE = 8.0
RIDGE = 1e-9  # keeps a plane over texels in one row from turning about it


def smoothed(
    values: Array,
    rays: int,
    texels: Texels,
    at: Points,
    wrong: NDArray[np.bool_],
    around: Surroundings,
) -> Array:
    """Values (T, C) of texels fitted as above; those that are ``wrong`` (T,) take no part.

    Only neighbours on the same chart that see each other, closely above the surface, count: nothing
    comes through a wall that stands on it. Nor do those whose light differs by more than the
    noise of ``rays`` rays.
    """
    step, total = NOISE * rays**-0.75, values.sum(axis=1)
    count, channels = values.shape
    moments = np.zeros((count, 6))  # of 1, x, y, xx, xy, yy
    firsts = np.zeros((count, 3, channels))  # of v, x v, y v
    low, high = values.copy(), values.copy()
    moments[:, 0], firsts[:, 0] = 1.0, values
    for (x, y), weight, one, other in _links(texels, at, wrong, around):
        apart = np.abs(values[one] - values[other]).sum(axis=1)
        alike = apart <= step * np.maximum(total[one], total[other])
        one, other = one[alike], other[alike]
        for here, there, sign in ((one, other, 1.0), (other, one, -1.0)):
            dx, dy = sign * x, sign * y
            moments[here] += weight * np.array([1.0, dx, dy, dx * dx, dx * dy, dy * dy])
            brought = weight * values[there]
            firsts[here] += np.array([1.0, dx, dy])[:, None] * brought[:, None]
            low[here] = np.minimum(low[here], values[there])
            high[here] = np.maximum(high[here], values[there])
    normal = moments[:, [[0, 1, 2], [1, 3, 4], [2, 4, 5]]]
    normal = normal + RIDGE * np.diag([0.0, 1.0, 1.0])
    fitted = np.linalg.solve(normal, firsts)[:, 0]
    return np.asarray(np.clip(fitted, low, high))


def count_split(texels: Texels, at: Points, wrong: NDArray[np.bool_], around: Surroundings) -> int:
    """How many pairs of neighbours, side by side on a chart, have a wall between them.

    Texels that are ``wrong`` (T,) have no neighbours.
    """
    near = [
        _separated(texels, at, one, other, around, LOW)
        for x, y in ((1, 0), (0, 1))
        for one, other in [_pairs(texels, at, wrong, x, y)]
    ]
    return int(sum(apart.sum() for apart in near))


def _links(
    texels: Texels, at: Points, wrong: NDArray[np.bool_], around: Surroundings
) -> Iterator[tuple[tuple[int, int], float, Ints, Ints]]:
    """Offset, weight, and the pairs of texels this far apart that belong together."""
    for x, y in OFFSETS:
        one, other = _pairs(texels, at, wrong, x, y)
        free = ~_separated(texels, at, one, other, around, ABOVE)
        yield (x, y), HALF[x] * HALF[y], one[free], other[free]


def _pairs(
    texels: Texels, at: Points, wrong: NDArray[np.bool_], x: int, y: int
) -> tuple[Ints, Ints]:
    """Texels of one chart that are (x, y) apart there, and as near in the world."""
    size = texels.size
    number = np.full((size + 4, size + 4), -1)
    number[texels.row + 2, texels.column + 2] = np.where(wrong, -1, np.arange(len(texels)))
    one = number[texels.row + 2, texels.column + 2]
    other = number[texels.row + 2 + y, texels.column + 2 + x]
    both = (one >= 0) & (other >= 0)
    one, other = one[both], other[both]
    near = texels.chart[one] == texels.chart[other]
    near &= dot(at.normal[one], at.normal[other]) > ALIKE
    apart = at.position[other] - at.position[one]
    near &= dot(apart, apart) < (STRETCH * texels.spacing) ** 2 * (x * x + y * y)
    return one[near], other[near]


def _separated(
    texels: Texels, at: Points, one: Ints, other: Ints, around: Surroundings, height: float
) -> NDArray[np.bool_]:
    """Which pairs do not see each other from ``height``, in texels, above the surface."""
    start = at.position[one] + height * texels.spacing * at.side[one]
    way = at.position[other] + height * texels.spacing * at.side[other] - start
    apart = dot(way, way) >= (SAME * texels.spacing) ** 2
    far = np.flatnonzero(apart)
    apart[far] = around.meet(start[far], way[far], 1.0).patch >= 0
    return np.asarray(apart)
