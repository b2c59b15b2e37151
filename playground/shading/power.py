"""The power of the specular term, accurate for any shininess.

Twin: shaders/lib/power.glsl. Near the centre of a highlight the base is close to 1
and its distance from 1 decides everything: (1 − t)^sh = exp(sh · log(1 − t)), with t
computed without ever subtracting from 1.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from playground.shading.floats import Array, floats
from playground.shading.vector import dot


def power(base: ArrayLike, exponent: ArrayLike) -> Array:
    """max(base, 0)^exponent for exponent >= 0; anything to the power 0 is 1.

    base and exponent broadcast. The convention max(x, 0)^0 = 1, 0 included, keeps a
    shininess of 0 the limit of small shininess; GLSL leaves pow(0, 0) undefined.
    Error: 8 + 5 |log2 of the result| roundings, relative. Source: IEEE 754-2019, section 9.2.1,
    for the power 0.
    """
    base, exponent = floats(base, exponent)
    with np.errstate(under="ignore"):
        return np.asarray(np.power(np.maximum(base, 0.0), exponent))


def power_below_one(cosine: ArrayLike, gap: ArrayLike, exponent: ArrayLike) -> Array:
    """max(cosine, 0)^exponent with cosine = 1 − gap, both given.

    Near 1 the gap counts, near 0 the cosine, and no digit is lost at either end.
    Source: log1p, as in Higham, Accuracy and Stability of Numerical Algorithms, 2002,
    section 1.14.
    """
    cosine, gap, exponent = floats(cosine, gap, exponent)
    near = gap < 0.5
    with np.errstate(under="ignore", over="ignore"):  # exponent · log beyond float16 is −∞: 0
        value = np.exp(exponent * np.log1p(-np.where(near, gap, 0.0)))
    return np.asarray(np.where(near, value, power(np.where(near, 1.0, cosine), exponent)))


def lobe(direction: ArrayLike, axis: ArrayLike, shininess: ArrayLike) -> Array:
    """max(direction · axis, 0)^shininess of unit vectors, shapes (..., 3) and (...).

    With d = direction − axis the cosine is 1 − d·d/2. Near the axis d·d/2 is small, and so is its
    rounding; that of the dot product is relative to 1. At shininess 10^6 the one is off
    by 6e-5 in float32, the other by 0.22. Far from the axis it is the dot product in which nothing
    cancels. Error: that of an angle off by 16 roundings, for vectors that `vector.unit` made.
    Source: Sterbenz, Floating-Point Computation, 1974: the difference of numbers within a
    factor of 2 is exact.
    """
    direction, axis, shininess = floats(direction, axis, shininess)
    difference = direction - axis
    gap = 0.5 * dot(difference, difference)
    return power_below_one(dot(direction, axis), gap, shininess)
