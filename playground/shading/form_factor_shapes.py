"""Form factors of round shapes in closed form: discs, spheres, caps.

Twin: shaders/lib/form_factor_shapes.glsl. Conventions as in `playground.shading.form_factor`: F is
the share of the light leaving the first shape, or a small element of a surface, that arrives
at the second. All arguments are lengths in one unit, or cosines; they broadcast to (...).

Source: Howell, A Catalogue of Radiation Heat Transfer Configuration Factors (numbers as
there), rearranged so that no near equals are subtracted.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from playground.shading.floats import Array


def coaxial_discs(radius: ArrayLike, other: ArrayLike, gap: ArrayLike) -> Array:
    """F from a disc to another of radius ``other`` on the same axis (Howell C-41).

    The textbook's ½ (X − √(X² − 4 (r₂/r₁)²)), multiplied by its conjugate:
    F = 2 r₂² / (S + √((r₁ − r₂)² + h²) √((r₁ + r₂)² + h²)), S = r₁² + r₂² + h².
    Error 10 roundings, relative.
    """
    r1, r2, h = (np.asarray(x, np.float64) for x in (radius, other, gap))
    size = np.maximum(np.maximum(r1, r2), h)
    a, b, c = r1 / size, r2 / size, h / size
    less, more = (r1 - r2) / size, a + b
    whole = a * a + b * b + c * c
    root = np.sqrt(less * less + c * c) * np.sqrt(more * more + c * c)
    return np.asarray(2.0 * b * b / (whole + root))


def element_to_disc(height: ArrayLike, offset: ArrayLike, radius: ArrayLike) -> Array:
    """F from an element that faces a parallel disc, ``offset`` from its axis.

    F = ½ (1 − Q/P) with Q = h² + a² − r², P = √(h² + (a − r)²) √(h² + (a + r)²). As
    P² − Q² = 4 r² h², it is 2 r² h² / (P (P + Q)) where Q > 0. Error 12 roundings, relative.
    """
    h, a, r = (np.asarray(x, np.float64) for x in (height, offset, radius))
    size = np.maximum(np.maximum(h, a), r)
    less, more = (a - r) / size, (a + r) / size
    h, r = h / size, r / size
    q = h * h + less * more
    p = np.sqrt(h * h + less * less) * np.sqrt(h * h + more * more)
    safe = np.where(q > 0.0, p + q, 1.0)
    whole = np.where(p > 0.0, p, 1.0)  # an element on the rim itself sees half of the disc
    outside = 2.0 * (r * h / whole) * (r * h / safe)
    return np.asarray(np.where(q > 0.0, outside, 0.5 * (1.0 - np.where(p > 0.0, q / whole, 0.0))))


def element_to_sphere(distance: ArrayLike, radius: ArrayLike, cosine: ArrayLike) -> Array:
    """F from an element to a sphere, ``distance`` > radius to its centre (Howell B-43, B-44).

    ``cosine`` is that of the angle between the element's normal and the direction to the centre.
    With H = distance/radius and c = H cosine: above the element's horizon (c >= 1)
    F = cosine/H², below it (c <= −1) 0. Where the horizon cuts, q² = H² − 1, w² = 1 − c²:
    π F = atan(w/q) + (c β/H − q w)/H², β = atan2(w H, −q c); see `cut_sphere`.
    Source: Juul, Diffuse Radiation View Factors from Differential Plane Sources to Spheres,
    ASME Journal of Heat Transfer 101(3), 1979.
    """
    d, r, cosine = (np.asarray(x, np.float64) for x in (distance, radius, cosine))
    h, c = d / r, cosine * (d / r)
    inside = np.clip(c, -1.0, 1.0)
    q = np.sqrt((d - r) * (d + r)) / r
    w = np.sqrt((1.0 - inside) * (1.0 + inside))
    above = np.maximum(cosine, 0.0) / (h * h)
    return np.asarray(np.where(np.abs(c) < 1.0, cut_sphere(h, inside, q, w), above))


def cut_sphere(h: ArrayLike, c: ArrayLike, q: ArrayLike, w: ArrayLike) -> Array:
    """F of a sphere that the horizon cuts, with the letters of `element_to_sphere`.

    For a far sphere all three terms are w/q to first order and cancel; F is of third or fifth.
    With atan x = x − x³ s(x) the first order drops out: where c < 0,
    π F = x³ (s(y)/c² − s(x)), x = w/q, y = w H/(q |c|), and where c >= 0,
    π F = x/H² − x³ s(x) + c β/H³. A near sphere, x > ½, needs none of this.
    """
    h, c, q, w = (np.asarray(x, np.float64) for x in (h, c, q, w))
    x = w / np.maximum(q, 1e-100)
    beta = np.arctan2(w * h, -q * c)
    near = np.arctan2(w, q) + (c * beta / h - q * w) / (h * h)

    # s(y)/c² from the series where y is small, else as (1 − atan(y)/y)/(y c)².
    few, below = np.clip(x, 1e-100, 0.5), np.minimum(c, -1e-100)
    rise = few * h  # −y c
    series = atan_rest(rise / -below) / (below * below)
    whole = (1.0 + below * np.arctan2(rise, -below) / rise) / (rise * rise)
    deep = np.where(rise < -0.5 * below, series, whole)
    setting = few**3 * (deep - atan_rest(few))
    rising = few / (h * h) - few**3 * atan_rest(few) + c * beta / h**3
    far = np.where(c < 0.0, setting, rising)
    return np.asarray(np.maximum(np.where(x > 0.5, near, far), 0.0) / np.pi)


def atan_rest(x: ArrayLike) -> Array:
    """(x − atan x)/x³ for 0 <= x <= ½, by its series 1/3 − x²/5 + x⁴/7 − …; beyond, that of ½."""
    squared = np.minimum(np.asarray(x, np.float64), 0.5) ** 2
    total = np.zeros(squared.shape)
    for k in range(25, -1, -1):  # 0.25^26 = 2e-16
        total = 1.0 / (2 * k + 3) - squared * total
    return total


def sphere_to_rectangle(distance: ArrayLike, width: ArrayLike, height: ArrayLike) -> Array:
    """F from a sphere to a rectangle of which one corner is the foot of the perpendicular.

    ``distance`` is from the centre to the rectangle's plane; the radius does not count, as
    long as the plane is outside: F = solid angle/(4π) = atan2(a b, d √(a² + b² + d²))/(4π).
    Source: Feingold & Gupta, ASME Journal of Heat Transfer 92, 1970.
    """
    d, a, b = (np.asarray(x, np.float64) for x in (distance, width, height))
    size = np.maximum(np.maximum(a, b), d)
    d, a, b = d / size, a / size, b / size
    return np.asarray(np.arctan2(a * b, d * np.sqrt(a * a + b * b + d * d)) / (4.0 * np.pi))


def sphere_to_zone(radius: ArrayLike, height: ArrayLike) -> Array:
    """F inside a sphere, from any part of it to a cap or zone of this height along the axis.

    The kernel is 1/(4πR²) between any two points of a sphere, so F is the zone's share of the
    whole: height/(2 radius). Source: Cohen & Wallace 1993, chapter 4.
    """
    return np.asarray(0.5 * np.divide(height, radius, dtype=np.float64))


def outer_to_inner_sphere(inner: ArrayLike, outer: ArrayLike) -> Array:
    """F from the inside of a sphere to one in its middle: (inner/outer)², by reciprocity.

    All that leaves the inner sphere arrives at the outer one.
    """
    share = np.divide(inner, outer, dtype=np.float64)
    return np.asarray(share * share)


def outer_to_itself(inner: ArrayLike, outer: ArrayLike) -> Array:
    """F from the inside of a sphere to itself, past a sphere in its middle: the rest of 1.

    As (outer − inner)(outer + inner)/outer², which keeps its digits where they nearly touch.
    """
    a, b = np.asarray(inner, np.float64), np.asarray(outer, np.float64)
    return np.asarray((b - a) / b * ((b + a) / b))
