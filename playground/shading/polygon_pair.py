"""The form factor of two flat polygons, exact however they lie: apart, close, sharing an edge.

Twin: shaders/lib/polygon_pair.glsl. Corners (..., K, 3) are counter-clockwise seen from the
side that shines; a polygon with fewer corners repeats its last. Nothing stands in between.

One rule for every pair. Each polygon is cut to what is in front of the other. Where the gap between
them is at least `APART` radii of the smaller one, that one is covered with Gauss's points, and
Lambert's formula gives what each point sees of the other: all terms are positive, and nothing
cancels for far or tiny ones. Closer pairs, down to touching and crossing ones, take the sum over
their edges of `playground.shading.edge_pair`, in which an edge may lie on another.

Error of the form factor: 1e-10 relative, and for close pairs 1e-16 P_a P_b/(2π A) absolute, with
the perimeters P and the area A of the first: 1e-15 for compact polygons. Ribbons askew to the axes,
whose corners are rounded, lose more: about 1e-11 at 1000 : 1.

float32: 5e-6 relative and 5e-8 absolute. There the sum over the edges of close pairs would lose
ten times as much. So GLSL subtracts from it, edge by edge, the sum for the shadow of one polygon
on the other's plane, which is 0 where they lie side by side; and a ribbon that touches nothing
gets points all along. What fits neither is off by 6e-8 P_a P_b/(2π A), absolute.

Sources: Goral et al., SIGGRAPH 1984; Schröder & Hanrahan, On the Form Factor Between Two
Polygons, SIGGRAPH 1993, on the integral; Baum, Rushmeier & Winget, SIGGRAPH 1989, on the mixture.
"""

from __future__ import annotations

from math import prod

import numpy as np
from numpy.typing import ArrayLike

from playground.shading.arc import lambert_arc
from playground.shading.edge_pair import edge_logs
from playground.shading.flat_polygon import (
    area_vector,
    ball_around,
    clip_front,
    heights,
    polygon_area,
    quad_points,
)
from playground.shading.vector import Array, dot

APART = 1.0  # radii of the polygon that gets the points
# From and up to such gaps, in radii, so many points per side.
POINTS = ((APART, 2.0, 12), (2.0, 4.0, 9), (4.0, 16.0, 6), (16.0, np.inf, 4))
BLOCK = 1 << 19  # corners of B seen from points of A at once: some 100 MB


def pair_form_factor(a: ArrayLike, b: ArrayLike) -> Array:
    """F of polygons a and b, the share of the light leaving a that arrives at b; (...)."""
    return np.asarray(exchange_area(a, b) / polygon_area(a))


def exchange_area(a: ArrayLike, b: ArrayLike) -> Array:
    """A_a F_ab = A_b F_ba of polygons (..., K, 3) and (..., L, 3), the same both ways; (...).

    For any number of pairs: memory stays at some 100 MB. Polygons of no area exchange nothing.
    """
    a, b = np.asarray(a, np.float64), np.asarray(b, np.float64)
    shape = np.broadcast_shapes(a.shape[:-2], b.shape[:-2])
    lead = shape or (1,)
    a, b = (np.broadcast_to(c, (*lead, *c.shape[-2:])) for c in (a, b))  # no copy
    total = np.zeros(prod(lead))
    step = max(BLOCK // (4 * a.shape[-2] * b.shape[-2]), 1)
    for start in range(0, len(total), step):
        chosen = np.arange(start, min(start + step, len(total)))
        place = np.unravel_index(chosen, lead)
        total[chosen] = _exchange(a[place], b[place])
    return total.reshape(shape)


def _exchange(a: Array, b: Array) -> Array:
    """`exchange_area` of one block, (M, K, 3) and (M, L, 3): the smaller one at the origin."""
    smaller = (np.ptp(a, axis=1).max(axis=1) <= np.ptp(b, axis=1).max(axis=1))[:, None, None]
    corners = max(a.shape[1], b.shape[1])
    a, b = (np.pad(c, ((0, 0), (0, corners - c.shape[1]), (0, 0)), mode="edge") for c in (a, b))
    a, b = np.where(smaller, a, b), np.where(smaller, b, a)
    origin = a[:, :1]
    size = np.maximum(np.abs(a - origin).max(axis=(1, 2)), np.abs(b - origin).max(axis=(1, 2)))
    size = np.where(size > 0.0, size, 1.0)
    a, b = (a - origin) / size[:, None, None], (b - origin) / size[:, None, None]
    over_b, over_a = heights(a, b), heights(b, a)
    meet = (over_b > 0.0).any(axis=1) & (over_a > 0.0).any(axis=1)
    cut = ((over_b < 0.0).any(axis=1) | (over_a < 0.0).any(axis=1)) & meet
    total = np.zeros(len(a))
    whole = meet & ~cut
    if whole.any():
        total[whole] = _in_front(a[whole], b[whole], a[whole], b[whole])
    if cut.any():
        pieces = clip_front(a[cut], over_b[cut]), clip_front(b[cut], over_a[cut])
        total[cut] = _in_front(*pieces, a[cut], b[cut])
    return total * size * size


def _in_front(a: Array, b: Array, whole_a: Array, whole_b: Array) -> Array:
    """What polygons exchange that lie in front of one another; those they were cut from."""
    (centre_a, radius_a), (centre_b, radius_b) = ball_around(a), ball_around(b)
    middle = centre_a - centre_b
    gap = np.sqrt(dot(middle, middle)) - radius_a - radius_b
    gap = np.maximum(gap, np.min(heights(a, whole_b), axis=1))
    gap = np.maximum(gap, np.min(heights(b, whole_a), axis=1))
    radius = np.maximum(radius_a, 1e-300)
    total = np.zeros(len(a))
    for least, most, points in POINTS:
        chosen = (gap >= least * radius) & (gap < most * radius)
        if chosen.any():
            total[chosen] = _apart(a[chosen], b[chosen], area_vector(whole_a[chosen]), points)
    close = gap < APART * radius
    if close.any():
        total[close] = _along_edges(a[close], b[close])
    return np.maximum(total, 0.0)


def _apart(a: Array, b: Array, normal: Array, points: int) -> Array:
    """∫ over a of what its points see of b, (M, K, 3) and (M, L, 3), Gauss's points on a."""
    unit_normal = normal / np.sqrt(dot(normal, normal))[:, None]
    total = np.zeros(len(a))
    step = max(BLOCK // (points * points * b.shape[1]), 1)
    for start in range(0, len(a), step):
        part = slice(start, start + step)
        up = unit_normal[part, None, None]
        for k in range(1, a.shape[1] - 1, 2):
            corners = a[part][:, [0, k, k + 1, min(k + 2, a.shape[1] - 1)]]
            position, weight = quad_points(corners, unit_normal[part], points)
            seen = b[part][:, None] - position[:, :, None]
            around = lambert_arc(seen, np.roll(seen, -1, axis=2), up).sum(axis=-1)
            total[part] -= np.sum(weight * around, axis=1)
    return total / (2.0 * np.pi)


def _along_edges(a: Array, b: Array) -> Array:
    """1/(2π) Σ u·v ∫∫ ln r over all pairs of edges, (M, K, 3) and (M, L, 3) -> (M,)."""
    total = np.zeros(len(a))
    step = 512  # some 1000 points each at which a polygon's edge sees another edge
    for start in range(0, len(a), step):
        few_a, few_b = a[start : start + step], b[start : start + step]
        u = (np.roll(few_a, -1, axis=1) - few_a)[:, :, None]
        v = (np.roll(few_b, -1, axis=1) - few_b)[:, None]
        offset = few_a[:, :, None] - few_b[:, None]
        pair = np.nonzero(dot(u, v) != 0.0)
        u, v = np.broadcast_to(u, offset.shape), np.broadcast_to(v, offset.shape)
        logs = edge_logs(offset[pair], u[pair], v[pair])
        total[start : start + step] = np.bincount(pair[0], weights=logs, minlength=len(few_a))
    return total / (2.0 * np.pi)
