"""One edge of a polygon as a point sees it: an arc of a great circle, and integrals along it.

Twin: shaders/lib/arc.glsl. An arc runs from the direction of ``a`` to that of ``b``, both
relative to the point and of any length, (..., 3). `playground.shading.area_light` sums arcs
and names the sources: Lambert's sum is over arcs, and Arvo reduces a lobe to integrals along them.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from playground.shading.vector import Array, cross, dot

NEGLIGIBLE = 40.0  # e^-40 = 4e-18: no more of the lobe counts in float64
AWAY = 0.5  # 1 − h² below which a great circle stays away from the axis: 45°
NODES, WEIGHTS = np.polynomial.legendre.leggauss(36)


def lambert_arc(a: ArrayLike, b: ArrayLike, normal: ArrayLike) -> Array:
    """N·(a × b)/|a × b| · angle(a, b): the share of an edge in Lambert's formula, times 2π.

    a × b is formed as a × (b − a), in which nothing cancels for neighbouring corners, and the
    angle by atan2: acos(a·b) would lose half of the digits. An edge without length adds 0.
    """
    m = cross(a, np.subtract(b, a))
    norm = np.sqrt(dot(m, m))
    tilt = dot(m, normal) / np.where(norm > 0.0, norm, 1.0)
    return np.asarray(tilt * np.arctan2(norm, dot(a, b)))


def turn_arc(a: ArrayLike, b: ArrayLike, axis: ArrayLike) -> Array:
    """The angle from a to b around the axis, −π to π, shape (...).

    An arc without length turns nothing, on the axis too, where a·b − (a·n)(b·n) is all rounding.
    """
    m = cross(a, np.subtract(b, a))
    along = dot(a, b) - dot(a, axis) * dot(b, axis)
    return np.asarray(np.where(dot(m, m) > 0.0, np.arctan2(dot(m, axis), along), 0.0))


def lobe_arc(a: ArrayLike, b: ArrayLike, axis: ArrayLike, power: float) -> Array:
    """∫ (1 − c^power) dφ along the arc from a to b, c > 0 the cosine to the axis, φ around it.

    The arc's great circle has the normal m and passes the axis at an angle of sine h = axis·m.
    With τ the tangent of the way along the circle from there, c² = (1 − h²)/(1 + τ²) and
    dφ = h/(h² + τ²) dτ. In x, τ = 2wx/(1 − x²) with w the width of the peak, the integrand is
    smooth. Gauss's points take the part where c^power counts; beyond, 1 − c^power is 1, and the
    integral an angle. A circle far from the axis may run along its equator, where τ has few
    digits: there the result is the whole angle, known from the ends, less the small integral of
    c^power; w = h makes x = tan(φ/2).
    """
    a, b, axis = (np.asarray(x, np.float64) for x in (a, b, axis))
    m = cross(a, b - a)
    length = np.sqrt(dot(m, m))
    m = m / np.where(length > 0.0, length, 1.0)[..., None]
    h, ahead = dot(m, axis), cross(m, axis)
    squared = dot(ahead, ahead)  # 1 − h²
    with np.errstate(over="ignore"):
        reach = squared * np.exp(np.minimum(2.0 * NEGLIGIBLE / power, 600.0)) - 1.0  # τ²
    peaked = (reach > 0.0) & (squared > 0.0) & (length > 0.0)
    away = squared < AWAY
    w = np.sqrt((h * h + 8.0 / power) / (1.0 + 8.0 / power))
    w = np.where(away, np.maximum(np.abs(h), 0.7), w)
    far = np.sqrt(np.where(peaked, reach, 0.0))
    limit = np.where(peaked, far / (w + np.sqrt(w * w + far * far)), 0.0)

    # The ends as x, cut to where the lobe counts, and the angles beyond.
    (xa, ya, za), (xb, yb, zb) = (_place(p, ahead, axis, w) for p in (a, b))
    ca, cb = np.clip(xa, -limit, limit), np.clip(xb, -limit, limit)
    ends = [(2.0 * w * c, (1.0 - c) * (1.0 + c)) for c in (ca, cb)]
    beyond = np.where(ca != xa, _angle(h, (ya, za), ends[0]), 0.0)
    beyond = beyond + np.where(cb != xb, _angle(h, ends[1], (yb, zb)), 0.0)
    inside = np.zeros(beyond.shape)
    count = peaked & (cb > ca)
    if count.any():
        x = (ca[count], cb[count])
        inside[count] = _gauss(h[count], squared[count], w[count], x, power)
    return np.where(away | ~peaked, turn_arc(a, b, axis) - inside, inside + beyond)


def _place(p: Array, ahead: Array, axis: Array, w: Array) -> tuple[Array, Array, Array]:
    """Where a point lies on its arc: x, and its coordinates (y, z) with τ = y/z."""
    y, z = dot(p, ahead), np.maximum(dot(p, axis), 0.0)
    below = w * z + np.sqrt((w * z) ** 2 + y * y)
    return y / np.where(below > 0.0, below, 1.0), y, z


def _angle(h: Array, a: tuple[Array, Array], b: tuple[Array, Array]) -> Array:
    """The angle φ from a to b around the axis, both given as (y, z)."""
    (ya, za), (yb, zb) = a, b
    return np.asarray(np.arctan2(h * (yb * za - ya * zb), h * h * za * zb + ya * yb))


def _gauss(h: Array, squared: Array, w: Array, x: tuple[Array, Array], power: float) -> Array:
    """∫ (1 − c^power) dφ between two x, or ∫ c^power dφ of a circle away from the axis; (M,)."""
    h, squared, w = h[:, None], squared[:, None], w[:, None]
    y = NODES
    stretch = WEIGHTS
    if power < 6.0:  # c^power has a branch point at c = 0, x = ±1: crowd the points there
        y = (15.0 * NODES - 10.0 * NODES**3 + 3.0 * NODES**5) / 8.0
        stretch = WEIGHTS * 15.0 / 8.0 * (1.0 - NODES**2) ** 2
    xa, xb = x
    half = 0.5 * (xb - xa)[:, None]
    at = 0.5 * (xa + xb)[:, None] + half * y
    deep = ((1.0 - at) * (1.0 + at)) ** 2
    far = 4.0 * w * w * at * at  # τ² = far/deep
    near = h * h * deep + far
    gap = np.minimum(near / (deep + far), 1.0 - 1e-16)  # 1 − c²
    with np.errstate(under="ignore"):
        missing = -np.expm1(0.5 * power * np.log1p(-gap))
        present = (squared * deep / (deep + far)) ** (0.5 * power)
    value = np.where(squared < AWAY, present, missing)
    slope = 2.0 * h / w * (w * w * deep + far) / (np.where(near > 0.0, near, 1.0) * (1.0 + at * at))
    return np.asarray(np.sum(stretch * value * slope, axis=-1) * half[:, 0])
