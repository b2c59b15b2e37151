"""A flat polygon as points see it: its edges, how large it looks, cut, sampled, stretched.

Twin: shaders/lib/polygon.glsl. ``up`` is a unit vector (..., 1, 3): one for all corners.
"""

from __future__ import annotations

from math import sqrt

import numpy as np
from numpy.typing import ArrayLike

from playground.shading.vector import Array, cross, dot

# Seven points of a triangle, exact to degree 5 (Radon 1948): coordinates (u, v), weights.
_P, _Q = (6.0 - sqrt(15.0)) / 21.0, (6.0 + sqrt(15.0)) / 21.0
TRIANGLE_UV = np.array(
    [
        (1 / 3, 1 / 3),
        *((u, v) for s in (_P, _Q) for u, v in ((s, s), (1 - 2 * s, s), (s, 1 - 2 * s))),
    ]
)
TRIANGLE_WEIGHTS = np.array(
    [0.225, *3 * [(155.0 - sqrt(15.0)) / 1200.0], *3 * [(155.0 + sqrt(15.0)) / 1200.0]]
)

FLATTEST = 0.02  # cosine below which Blinn's highlight gets no narrower
Edges = tuple[Array, Array]  # from (..., E, 3) to (..., E, 3), relative to the point


def seen_edges(position: ArrayLike, corners: ArrayLike) -> Edges:
    """All edges relative to the point, the last one back to the first corner."""
    a = np.subtract(corners, np.asarray(position, np.float64)[..., None, :], dtype=np.float64)
    return a, np.roll(a, -1, axis=-2)


def cut_edges(edges: Edges, up: Array) -> tuple[Edges, Edges]:
    """The parts of edges with up·x > 0, and joins between the cuts, one per edge.

    What is missing has no length. All cuts lie on one line, so each is joined to the first.
    Source: Sutherland & Hodgman, Reentrant Polygon Clipping, CACM 17(1), 1974.
    """
    a, b = edges
    za, zb = dot(a, up), dot(b, up)
    leaves, enters = (za > 0.0) & (zb <= 0.0), (za <= 0.0) & (zb > 0.0)
    crosses = leaves | enters
    share = za / np.where(crosses, za - zb, 1.0)
    cut = a + share[..., None] * (b - a)
    cut = np.where((zb == 0.0)[..., None], b, cut)
    gone = ((za <= 0.0) & (zb <= 0.0))[..., None]
    start = np.where(enters[..., None], cut, a)
    end = np.where(leaves[..., None], cut, np.where(gone, a, b))
    first = np.argmax(crosses, axis=-1)[..., None, None]
    anchor = np.take_along_axis(cut, first, axis=-2)
    join_start = np.where(leaves[..., None], cut, anchor)
    join_end = np.where(enters[..., None], cut, anchor)
    return (start, end), (join_start, join_end)


def extent(corners: Array) -> Array:
    """How large the polygon looks: its extent from the first corner over the distance there."""
    first = corners[..., :1, :]
    spread = np.max(np.sum((corners - first) ** 2, axis=-1), axis=-1)
    squared = dot(first[..., 0, :], first[..., 0, :])
    return np.asarray(np.sqrt(spread / np.where(squared > 0.0, squared, 1e-300)))


def area_samples(corners: Array, chosen: Array) -> Edges:
    """Seven points of every triangle of the chosen polygons, (M, T, 7, 3), and −x·dA, (M, T, 7)."""
    few = np.broadcast_to(corners, (*chosen.shape, *corners.shape[-2:]))[chosen]
    a, u, v = few[:, :1], few[:, 1:-1] - few[:, :1], few[:, 2:] - few[:, :1]
    area = 0.5 * cross(u, v)
    s, t = TRIANGLE_UV.T[..., None]
    x = a[:, :, None] + u[:, :, None] * s + v[:, :, None] * t
    return x, -dot(x, area[:, :, None]) * TRIANGLE_WEIGHTS


def chosen_vectors(vectors: Array, chosen: Array) -> Array:
    """The vectors (..., 1, 3) of the chosen points, (M, 1, 3)."""
    return np.broadcast_to(vectors, (*chosen.shape, 1, 3))[chosen]


def shown(total: Array, two_sided: bool) -> Array:
    """What arrives: the back of a polygon is dark unless it is two-sided."""
    return np.asarray(np.abs(total) if two_sided else np.maximum(total, 0.0))


def stretched(offset: ArrayLike, normal: ArrayLike, axis: ArrayLike) -> Array:
    """A corner's offset from the point, as Blinn's highlight needs it; all (..., 3).

    Around the mirror direction ``axis`` the halfway vector h turns half as fast as ω within the
    plane of incidence, and 1/(2 cos θ) as fast across it, cos θ = n·axis. So (n·h)^sh looks like
    a lobe of exponent sh/4 that is narrower by cos θ across. A light stretched across by
    1/cos θ meets a round lobe instead, times cos θ for the solid angle on the axis (the idea
    of Heitz et al., Real-Time Polygonal-Light Shading with Linearly Transformed Cosines, 2016).
    An approximation, right to second order around the axis: off by 1 % of the brightest value
    (sh = 80, up to 30°) to 9 % (sh = 20 at 75°), and by 28 % for sh = 5 at grazing angles.
    """
    offset, normal, axis = (np.asarray(x, np.float64) for x in (offset, normal, axis))
    across = cross(normal, axis)
    squared = dot(across, across)
    more = dot(offset, across) * (1.0 / stretch_factor(normal, axis) - 1.0)
    return np.asarray(offset + (more / np.where(squared > 0.0, squared, 1.0))[..., None] * across)


def stretch_factor(normal: ArrayLike, axis: ArrayLike) -> Array:
    """The cos θ of `stretched`, shape (...): a highlight gets no narrower than at 0.02."""
    return np.maximum(dot(normal, axis), FLATTEST)
