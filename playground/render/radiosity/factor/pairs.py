"""What pairs of patches exchange, A_i F_ij, each pair by a rule that its distance decides.

The exchange of a pair is the same from either side, so it is computed once, and
A_i F_ij = A_j F_ji holds to the last rounding.

- Far pairs: Lambert's closed form from a point to a polygon (`area_light.form_factor`), at
  g × g of Gauss's points on the smaller patch.
- Near pairs, their centres less than `NEAR` times the sum of both radii apart, touching ones
  among them: what two polygons exchange (`polygon_pair`), exact also with a common edge.
- Where something may stand in between, the result is weakened by the share of segments that
  arrive, each weighed as the integral weighs it (as in `shading.shadow`). Four that start and
  end near the corners tell whether all, none or some do. If some, r² more are sent all over both
  patches, spread over the four numbers that say where a segment starts and ends.
- Places on a patch are counted from a corner that does not depend on the order of its corners.

On the GPU, shaders/radiosity/pairs.frag does the same for far pairs.

Sources: Baum, Rushmeier & Winget, Improving Radiosity Solutions Through the Use of Analytically
Determined Form-Factors, SIGGRAPH 1989 (closed form close by); Wallace, Elmquist & Haines, A Ray
Tracing Algorithm for Progressive Radiosity, SIGGRAPH 1989 (visibility by rays).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from playground.render.radiosity.factor.visibility import between, facing
from playground.render.radiosity.patch.patches import Patches
from playground.shading.area_light import form_factor
from playground.shading.floats import Array
from playground.shading.polygon_pair import exchange_area
from playground.shading.shadow import visible_share
from playground.shading.vector import cross, dot

Ints = NDArray[np.intp]
Bools = NDArray[np.bool_]
Side = tuple[Array, Array]  # corners (P, 4, 3) and unit normals (P, 3)

# Patches that touch are within 1. From here on, between equal squares, 3 × 3 points are off by at
# most 3e-4 of the factor at a right angle and 2e-3 in a fold of 17°, 2 × 2 points by 1e-2 and
# 4e-2; the error falls as distance^-6 and ^-4.
NEAR = 1.25
BATCH = 20_000  # pairs at a time: some 30 MB
MANY = 4000  # patches
LOOKS = 2  # per side, squared: the segments that tell whether more are needed
INSET = 0.1  # of a side: how far from the edge they end; less would find few more half-shadows


def exchange(
    patches: Patches, i: Ints, j: Ints, occlusion: bool = True, points: int = 3, rays: int = 5
) -> Array:
    """A_i F_ij = A_j F_ji of pairs of patches, (P,)."""
    found = np.zeros(len(i))
    meet = np.flatnonzero(facing(patches, i, j))
    for first in range(0, len(meet), BATCH):
        part = meet[first : first + BATCH]
        small, large = by_size(patches, i[part], j[part])
        share = visible(patches, small, large, rays) if occlusion else np.ones(len(small))
        close = near(patches, small, large)
        at = np.flatnonzero(close & (share > 0.0))
        found[part[at]] = share[at] * exact(patches, small[at], large[at])
        at = np.flatnonzero(~close & (share > 0.0))
        found[part[at]] = share[at] * unhidden(patches, small[at], large[at], points)
    return found


def enough_rays(patches: int) -> int:
    """Segments per side for so many patches: the smaller they are, the fewer lie in half-shadow.

    With 5 the matrix of the Cornell box is off by 0.19 % at 2,400 patches; with 3 by 0.32 % at
    5,000 and 0.28 % at 10,000, in 0.86 of the time (the sum of all errors over that of all factors,
    compared with 13).
    """
    return 5 if patches <= MANY else 3


def by_size(patches: Patches, i: Ints, j: Ints) -> tuple[Ints, Ints]:
    """The smaller patch of each pair (P,), by `Patches.rank`, and the other."""
    swap = patches.rank[j] < patches.rank[i]
    return np.where(swap, j, i), np.where(swap, i, j)


def near(patches: Patches, i: Ints, j: Ints) -> Bools:
    """Which pairs are too near for a few points; of the shape of i and j together."""
    away = patches.polygon - patches.centre[:, None]
    reach = NEAR * np.sqrt(np.max(dot(away, away), axis=1))
    x, y, z = patches.centre.T  # number by number: i and j may be rows and columns of many pairs
    squared = (x[i] - x[j]) ** 2 + (y[i] - y[j]) ** 2 + (z[i] - z[j]) ** 2
    return np.asarray(squared < (reach[i] + reach[j]) ** 2)


def exact(patches: Patches, i: Ints, j: Ints) -> Array:
    """A_i F_ij of pairs as if nothing stood in between, (P,), however near they are."""
    return exchange_area(patches.polygon[i], patches.polygon[j])


def unhidden(patches: Patches, i: Ints, j: Ints, points: int) -> Array:
    """A_i F_ij of far pairs as if nothing stood between, by points × points on patch i, (P,)."""
    nodes, weights = np.polynomial.legendre.leggauss(points)
    total = np.zeros(len(i))
    corners, normal, other = patches.turned[i], patches.normal[i], patches.polygon[j]
    for s, along in zip(nodes, weights, strict=True):
        for t, across in zip(nodes, weights, strict=True):
            place = np.array([1.0 + s, 1.0 + t]) / 2.0
            area = stretch((corners, normal), place)
            factor = form_factor(point_at(corners, place), normal, other, two_sided=False)
            total += along * across / 4.0 * area * factor
    return total


def visible(patches: Patches, i: Ints, j: Ints, rays: int, look: bool = True) -> Array:
    """The share of what pairs would exchange that gets through, (P,).

    By rays² segments for each pair; with ``look``, only where those near the corners disagree.
    None are sent where the box around both patches touches nothing that hides.
    """
    share = np.ones(len(i))
    asked = np.flatnonzero(_touched(patches, i, j))
    if look:
        share[asked] = _share(patches, i[asked], j[asked], looks())
        asked = asked[(share[asked] > 0.0) & (share[asked] < 1.0)]
    share[asked] = _share(patches, i[asked], j[asked], segments(rays))
    return share


def _touched(patches: Patches, i: Ints, j: Ints) -> NDArray[np.bool_]:
    """Whether the box around each pair touches the one around all that can hide, (P,)."""
    stands = between(patches)
    if stands.tree.nodes == 0:
        return np.zeros(len(i), dtype=bool)
    low, high = patches.box
    above = np.minimum(low[i], low[j]) - stands.lift <= stands.tree.high[0]
    below = np.maximum(high[i], high[j]) + stands.lift >= stands.tree.low[0]
    return np.asarray(np.all(above & below, axis=1))


def looks() -> Array:
    """Where the segments start and end that tell whether more are needed, (4, 4)."""
    return np.where(segments(LOOKS) < 0.5, INSET, 1.0 - INSET)


def segments(rays: int) -> Array:
    """Where segments start and end, (rays², 4): (s, t) on the one patch and on the other.

    If ``rays`` is a prime number above 2, any two of the four numbers take every pair of their
    ``rays`` values just once: an orthogonal array (Rao 1947; Owen, Orthogonal Arrays for Computer
    Experiments, Integration and Visualization, 1992). The multipliers grow with ``rays``, so that
    many segments fill all four dimensions.
    """
    a, b = np.divmod(np.arange(rays * rays), rays)
    u, v = multipliers(rays)
    return np.asarray(
        (np.stack([b, a, (a + u * b) % rays, (a + v * b) % rays], axis=1) + 0.5) / rays
    )


def multipliers(rays: int) -> tuple[int, int]:
    """What places on the one patch are multiplied by to give those on the other."""
    return max(rays // 5, 1), -(-3 * rays // 5)


def _share(patches: Patches, i: Ints, j: Ints, places: Array) -> Array:
    """The share that gets through, (P,), by segments with the same places (S, 4) for each pair."""
    stands = between(patches)
    sides = (patches.turned[i], patches.normal[i]), (patches.turned[j], patches.normal[j])
    seen, whole = np.zeros(len(i)), np.zeros(len(i))
    for place in places:
        weight, start, end = _segment(*sides, place)
        whole += weight
        open_ = np.flatnonzero(weight > 0.0)
        up, down = sides[0][1][open_], sides[1][1][open_]
        arrives = open_[~stands.hidden(start[open_], up, end[open_], down)]
        seen[arrives] += weight[arrives]
    return visible_share(seen, whole)


def _segment(one: Side, other: Side, place: Array) -> tuple[Array, Array, Array]:
    """What a segment counts for, (P,), and its two ends, (P, 3) each."""
    start, end = point_at(one[0], place[:2]), point_at(other[0], place[2:])
    way = end - start
    squared = dot(way, way)
    cosines = np.maximum(dot(way, one[1]), 0.0) * np.maximum(-dot(way, other[1]), 0.0)
    area = stretch(one, place[:2]) * stretch(other, place[2:])
    return cosines * area / np.where(squared > 0.0, squared, 1.0) ** 2, start, end


def point_at(corners: Array, place: Array) -> Array:
    """The bilinear mean of corners (P, 4, 3) at (s, t), (P, 3); it fills triangles too."""
    s, t = place
    a, b, c, d = np.moveaxis(corners, 1, 0)
    return np.asarray((1.0 - t) * ((1.0 - s) * a + s * b) + t * ((1.0 - s) * d + s * c))


def stretch(side: Side, place: Array) -> Array:
    """By how much `point_at` enlarges areas there, (P,): its mean over the square is the area."""
    s, t = place
    a, b, c, d = np.moveaxis(side[0], 1, 0)
    across, along = (1.0 - t) * (b - a) + t * (c - d), (1.0 - s) * (d - a) + s * (c - b)
    return dot(side[1], cross(across, along))
