"""Two straight edges: the double integral of ln r that form factors of polygons are made of.

Twin: shaders/lib/edge_pair.glsl. By Stokes's theorem, applied twice, A_i F_ij of two polygons is
1/(2π) Σ over pairs of edges of u·v ∫∫ ln r ds dt, r the distance of the points a + s u and
b + t v, s and t from 0 to 1. Everything depends on ``offset`` = a − b, (M, 3), ``u`` and ``v``.

Sources: Goral, Torrance, Greenberg & Battaile, Modeling the Interaction of Light Between
Diffuse Surfaces, SIGGRAPH 1984; Johnston & Elliott, A sinh Transformation for Evaluating Nearly
Singular Boundary Element Integrals, 2005, for the quadrature.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from playground.shading.edge_log import mean_log, parallel_logs
from playground.shading.vector import Array, cross, dot

NODES, WEIGHTS = np.polynomial.legendre.leggauss(16)
SHARES, WEIGHTS = 0.5 + 0.5 * NODES, 0.5 * WEIGHTS
NEAREST = 1e-7  # of a piece: what is nearer to an end counts for less than 1e-13
LONGEST = 3.0  # of one piece in the stretched variable, where 16 points give 1e-13
PARALLEL = 1e-13  # sine below which edges are parallel: as exact as their corners


def edge_logs(offset: ArrayLike, u: ArrayLike, v: ArrayLike) -> Array:
    """u·v ∫∫ ln r ds dt for pairs of edges of lengths near 1, (M, 3) -> (M,).

    In closed form where they are parallel, else `mean_log` along the second and Gauss's points
    along the first, crowded where the other comes near; 0 at a right angle. Error about
    1e-11 |u| |v|, down to 1e-15 where each end keeps a tenth of a length from the other edge.
    """
    offset, u, v = (np.asarray(x, np.float64) for x in (offset, u, v))
    along = dot(u, v)
    across = cross(u, v)
    sine_squared = dot(across, across)
    size = dot(u, u) * dot(v, v)
    parallel = sine_squared <= PARALLEL**2 * size
    result = np.zeros(along.shape)
    if parallel.any():
        result[parallel] = parallel_logs(offset[parallel], u[parallel], v[parallel])
    skew = ~parallel & (along != 0.0)
    if skew.any():
        o, a, b = offset[skew], u[skew], v[skew]
        result[skew] = along[skew] * _skew_logs(o, a, b, across[skew], sine_squared[skew])
    return result


def _skew_logs(offset: Array, u: Array, v: Array, across: Array, sine_squared: Array) -> Array:
    """∫∫ ln r ds dt of edges that are not parallel, (M, 3) -> (M,)."""
    places, distances = _near_places(offset, u, v, across, sine_squared)
    cuts = np.clip(np.concatenate([places, np.zeros_like(places[:, :2])], axis=1), 0.0, 1.0)
    cuts[:, -1] = 1.0
    cuts.sort(axis=1)

    # Each stretch between two cuts in halves, from its cuts to its middle.
    half = 0.5 * np.diff(cuts, axis=1)
    ends = np.stack([cuts[:, :-1], cuts[:, 1:]], axis=-1)
    lengths = np.stack([half, -half], axis=-1)
    row, *rest = np.nonzero(np.abs(lengths) > 1e-15)
    end, length = ends[row, *rest], lengths[row, *rest]
    gap = np.min(np.hypot(end[:, None] - places[row], distances[row]), axis=1)
    gap = np.maximum(gap, NEAREST * np.abs(length))

    # s = end ± gap sinh(x): the nearer, the denser. A long way in x is cut into equal pieces.
    reach = np.arcsinh(np.abs(length) / gap)
    count = np.ceil(reach / LONGEST).astype(np.intp)
    piece = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count)
    row, end, gap, length, reach = (
        np.repeat(values, count) for values in (row, end, gap, length, reach / count)
    )
    x = reach[:, None] * (piece[:, None] + SHARES)
    s = end[:, None] + np.copysign(gap, length)[:, None] * np.sinh(x)
    weight = WEIGHTS * (reach * gap)[:, None] * np.cosh(x)
    value = mean_log(offset[row][:, None] + s[..., None] * u[row][:, None], v[row][:, None])
    total = np.sum(weight * value, axis=1)
    return np.bincount(row, weights=total, minlength=len(offset))


def _near_places(
    offset: Array, u: Array, v: Array, across: Array, sine_squared: Array
) -> tuple[Array, Array]:
    """Where along the first edge `mean_log` bends, (M, 3), and how far off its line, (M, 3).

    At the feet of both ends of the second edge and where the lines come closest; both in
    lengths of u. The nearer, the sharper the bend.
    """
    whole = dot(u, u)
    places, distances = [], []
    for w in (offset, offset - v):
        away = cross(w, u)
        places.append(-dot(w, u) / whole)
        distances.append(np.sqrt(dot(away, away)) / whole)
    between = dot(cross(offset, v), across) / sine_squared
    height = np.abs(dot(offset, across)) * np.sqrt(dot(v, v)) / sine_squared
    return np.stack([*places, -between], axis=1), np.stack([*distances, height], axis=1)
