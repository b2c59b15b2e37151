"""What reaches a point from a light: direction, attenuation, spot cone.

Twin: shaders/lib/light.glsl.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from playground.shading.floats import Array, floats
from playground.shading.vector import dot, length_any, unit

BRIGHTEST = 1e18  # share of a light that may arrive: colours beyond could not be interpolated
SMALLEST = float(np.finfo(np.float32).tiny)  # keeps 1/x finite in float32 as in float64


def attenuation(
    distance: ArrayLike, constant: ArrayLike, linear: ArrayLike, quadratic: ArrayLike
) -> Array:
    """1 / (k_c + k_l d + k_q d²), shape (...); finite also where all of it is zero.

    Horner's form meets no d², which would overflow long before the quotient vanishes.
    Error: 7 roundings, relative. Source: OpenGL 1.1 specification, section 2.13.1.
    """
    d, constant, linear, quadratic = floats(distance, constant, linear, quadratic)
    with np.errstate(over="ignore"):
        denominator = constant + d * (linear + d * quadratic)
    smallest = max(SMALLEST, float(np.finfo(d.dtype).tiny))
    return np.asarray(1.0 / np.maximum(denominator, smallest))


def toward(position: ArrayLike, light: ArrayLike) -> tuple[Array, Array]:
    """Unit vector from ``position`` to ``light`` and their distance, (..., 3) and (...).

    Where both are the same point the vector is zero, so that the light adds nothing.
    Error: 9 roundings of each component and of the distance. Source: Blue 1978, as in
    `vector.length_any`.
    """
    light, position = floats(light, position)
    difference = light - position
    return unit(difference), length_any(difference)


def cone(inner: ArrayLike, outer: ArrayLike) -> tuple[Array, Array]:
    """The two constants of a spot cone: sin²(outer/2) and sin²(outer/2) − sin²(inner/2).

    ``inner`` and ``outer`` are half-angles in radians. The difference is formed as
    sin((outer + inner)/2) · sin((outer − inner)/2), exact for the thinnest penumbra,
    by sin² a − sin² b = sin(a + b) sin(a − b).
    Has no twin: computed once per light.
    """
    inner, outer = np.asarray(inner, np.float64), np.asarray(outer, np.float64)
    edge = np.sin(outer / 2.0) ** 2
    return edge, np.sin((outer + inner) / 2.0) * np.sin((outer - inner) / 2.0)


def spot_cone(axis: ArrayLike, to_point: ArrayLike, edge: ArrayLike, width: ArrayLike) -> Array:
    """1 inside the inner cone, 0 outside the outer one, a smooth step between; shape (...).

    smoothstep(cos outer, cos inner, cos θ) for the angle θ between the unit vectors
    ``axis`` and ``to_point`` (light to surface point). Cosines near 1 lose all digits, so
    each is written as 1 − 2 sin²(half the angle), with sin²(θ/2) = |axis − to_point|²/4;
    ``edge`` and ``width`` come from `cone`. A width of 0 is a hard step, its edge lit.
    Source: the smooth step, GLSL 4.60 specification, section 8.3; 1 − cos θ = 2 sin²(θ/2).
    """
    axis, to_point, edge, width = floats(axis, to_point, edge, width)
    difference = axis - to_point
    inside = edge - 0.25 * dot(difference, difference)
    x = np.clip(inside / np.where(width > 0.0, width, 1.0), 0.0, 1.0)
    step = (inside >= 0.0).astype(x.dtype)
    return np.asarray(np.where(width > 0.0, x * x * (3.0 - 2.0 * x), step))
