"""What reaches a point from a flat polygon that shines: form factor and Phong lobe.

Twin: shaders/lib/area_light.glsl. The polygon sends the same radiance from each of its
points in every direction. Its corners are in order, counter-clockwise as seen from the side
that shines; it need not be convex, and corners may coincide or lie on a line. Nothing stands in
between: shadows belong to ray tracing.

Both integrals run over the directions towards the polygon, and both become a sum over its edges
(Stokes). Where the polygon dips below a plane through the point, its edges are cut there, and the
cuts, which all lie on one line, are joined along it (Sutherland & Hodgman, Reentrant Polygon
Clipping, 1974). Where a polygon looks so small that its edges cancel, a quadrature over its area
takes over.

Arguments, always in this order: ``position`` (..., 3); unit vectors ``normal``, ``axis``
(..., 3); ``corners`` (K, 3) or (..., K, 3); ``exponent``; ``two_sided``. Results: (...).

Sources: Lambert, Photometria, 1760; Baum, Rushmeier & Winget, Improving Radiosity Solutions
Through the Use of Analytically Determined Form-Factors, SIGGRAPH 1989; Arvo, Applications of
Irradiance Tensors, SIGGRAPH 1995; Heitz, Geometric Derivation of the Irradiance of Polygonal
Lights, 2017.
"""

from __future__ import annotations

from math import sqrt

import numpy as np
from numpy.typing import ArrayLike

from playground.shading.arc import lambert_arc, lobe_arc, turn_arc
from playground.shading.polygon import (
    Edges,
    area_samples,
    chosen_vectors,
    cut_edges,
    extent,
    seen_edges,
    shown,
)
from playground.shading.vector import Array, dot

# A polygon gets the quadrature where its extent over its distance is below TINY; for the lobe below
# all three limits.
TINY = 0.003  # below it the sum over the edges loses 1e-13
TINY_LOBE = 0.01  # in widths of the lobe, 1/√(exponent + 1)
STEEP = 0.02  # in cosines to the axis: near its equator small powers are steep


def form_factor(
    position: ArrayLike, normal: ArrayLike, corners: ArrayLike, two_sided: bool
) -> Array:
    """F = 1/π ∫ cos θ dω over the part of the polygon above the surface: 0 to 1.

    Lambert's formula, F = 1/(2π) Σ N·(a × b)/|a × b| · angle(a, b), over the edges a to b seen
    from the point and cut at its horizon. a × b is formed as a × (b − a), the angle by atan2:
    acos(a·b) would lose half of the digits. Error at most 2e-15 + 1e-13 F.
    """
    edges = seen_edges(position, corners)
    up = np.asarray(normal, np.float64)[..., None, :]
    height = dot(edges[0], up)
    ahead, joins = cut_edges(edges, up)  # N·(a × b) of a join on the horizon is its length, exactly
    around = lambert_arc(*ahead, up) + turn_arc(*joins, up)
    total = -np.sum(around, axis=-1) / (2.0 * np.pi)

    small = (extent(edges[0]) < TINY) & (height > 0.0).all(axis=-1)
    if small.any():
        x, outward = area_samples(edges[0], small)
        squared = dot(x, x)
        cosines = dot(x, chosen_vectors(up, small)[..., None, :]) * outward / squared**2
        total = _placed(total, small, np.sum(cosines, axis=(-2, -1)) / np.pi)
    return shown(total, two_sided)


def lobe_integral(
    position: ArrayLike, axis: ArrayLike, corners: ArrayLike, exponent: float, two_sided: bool
) -> Array:
    """∫ max(axis·ω, 0)^exponent dω over the directions to the polygon: 0 to 2π/(exponent + 1).

    As in the Phong model, neither the cosine at the surface nor its horizon plays a part; for
    the latter see `lobe_integral_above`. Any exponent from 0. Error at most 2e-15 plus 1e-11
    of the result.
    """
    edges = seen_edges(position, corners)
    whole = np.ones(edges[0].shape[:-2], dtype=bool)
    return _lobe(edges, edges[0], whole, axis, exponent, two_sided)


def lobe_integral_above(
    position: ArrayLike,
    normal: ArrayLike,
    axis: ArrayLike,
    corners: ArrayLike,
    exponent: float,
    two_sided: bool,
) -> Array:
    """`lobe_integral` over the part of the polygon above the surface, normal·ω > 0."""
    edges = seen_edges(position, corners)
    up = np.asarray(normal, np.float64)[..., None, :]
    whole = np.asarray((dot(edges[0], up) > 0.0).all(axis=-1))
    parts = cut_edges(edges, up)
    chain = tuple(np.concatenate(ends, axis=-2) for ends in zip(*parts, strict=True))
    return _lobe((chain[0], chain[1]), edges[0], whole, axis, exponent, two_sided)


def _lobe(
    edges: Edges, corners: Array, whole: Array, axis: ArrayLike, exponent: float, two_sided: bool
) -> Array:
    """The lobe over the polygon with these ``edges``; where it is ``whole``, with ``corners``."""
    axis = np.asarray(axis, np.float64)[..., None, :]
    power = float(exponent) + 1.0
    ahead, joins = cut_edges(edges, axis)
    angle = turn_arc(*joins, axis) + lobe_arc(*ahead, axis, power)
    total = -np.sum(angle, axis=-1) / power

    large = extent(corners)
    small = whole & (large < TINY) & (large * sqrt(power) < TINY_LOBE)
    small = small & (large < STEEP * _lowest(corners, axis))
    if small.any():
        x, outward = area_samples(corners, small)
        distance = np.sqrt(dot(x, x))
        unit_x = x / distance[..., None]
        apart = unit_x - chosen_vectors(axis, small)[..., None, :]
        with np.errstate(under="ignore"):
            lobe = np.exp(exponent * np.log1p(-np.minimum(0.5 * dot(apart, apart), 1.0 - 1e-15)))
        total = _placed(total, small, np.sum(lobe * outward / distance**3, axis=(-2, -1)))
    return shown(total, two_sided)


def _lowest(corners: Array, axis: Array) -> Array:
    """The smallest cosine to the axis among the corners; 0 for one at the point itself."""
    squared = dot(corners, corners)
    cosine = dot(corners, axis) / np.sqrt(np.where(squared > 0.0, squared, np.inf))
    return np.asarray(np.min(cosine, axis=-1))


def _placed(total: Array, chosen: Array, values: Array) -> Array:
    """``total`` (...) with ``values`` (M,) at the chosen points."""
    total = np.array(total)
    total[chosen] = values
    return total
