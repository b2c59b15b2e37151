"""The logarithm of the distance, integrated along a straight edge and along a parallel one.

Twin: shaders/lib/edge_log.glsl. What `playground.shading.edge_pair` sums; ``offset`` is from the
start of the edge ``v`` to a point, or to the start of the edge ``u``, (..., 3). Everywhere ln r
stands for ln r + 1: a constant cancels around a polygon, and this one makes the results small.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from playground.shading.vector import Array, cross, dot


def mean_log(offset: ArrayLike, v: ArrayLike) -> Array:
    """∫ ln |offset − t v| dt, t from 0 to 1: the mean over an edge seen from its side; (...).

    With f the place of the foot of the perpendicular, d its length, and r₀, r₁ the distances to the
    start and the end: ½ ((1 − f) ln r₁² + f ln r₀²) + d/|v| · (angle under which the edge appears).
    """
    offset, v = np.asarray(offset, np.float64), np.asarray(v, np.float64)
    whole = dot(v, v)
    away = cross(offset, v)
    d = np.sqrt(dot(away, away)) / whole  # in lengths of the edge, as all that follows
    f = dot(offset, v) / whole
    beyond = offset - v
    angle = np.arctan2(d, d * d - f * (1.0 - f))
    logs = (1.0 - f) * _log(dot(beyond, beyond)) + f * _log(dot(offset, offset))
    return np.asarray(0.5 * logs + d * angle)


def _log(squared: Array) -> Array:
    """The logarithm of r²; finite at r = 0, where it is multiplied by 0."""
    return np.asarray(np.log(np.maximum(squared, 1e-300)))


def parallel_logs(offset: ArrayLike, u: ArrayLike, v: ArrayLike) -> Array:
    """`edge_logs` of parallel edges, in closed form, (..., 3) -> (...).

    With x along the edges and d between their lines, it has the second antiderivative
    G(x) = ¼ (x² − d²) ln(x² + d²) + x d atan(x/d) − ¼ x², taken at the four pairs of ends.
    """
    offset, u, v = (np.asarray(x, np.float64) for x in (offset, u, v))
    length = np.sqrt(dot(v, v))
    along = v / length[..., None]
    away = cross(offset, along)
    d = np.sqrt(dot(away, away))
    start, step = dot(offset, along), dot(u, along)
    total = np.zeros(d.shape)
    for x, sign in (
        (start + step, 1.0),
        (start, -1.0),
        (start + step - length, -1.0),
        (start - length, 1.0),
    ):
        log = 0.25 * (x * x - d * d) * _log(x * x + d * d)
        total += sign * (log + x * d * np.arctan2(x, d) - 0.25 * x * x)
    return total
