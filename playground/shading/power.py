"""The power of the specular term, accurate for any shininess.

Twin: shaders/lib/power.glsl. Near the centre of a highlight the base is close to 1
and its distance from 1 decides everything: (1 − t)^sh = exp(sh · log(1 − t)), with t
computed without ever subtracting from 1.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from playground.shading.vector import Array, dot


def power(base: ArrayLike, exponent: ArrayLike) -> Array:
    """max(base, 0)^exponent for exponent >= 0; anything to the power 0 is 1.

    base and exponent broadcast. The convention max(x, 0)^0 = 1, 0 included, keeps a
    shininess of 0 the limit of small shininess; GLSL leaves pow(0, 0) undefined.
    """
    base, exponent = np.asarray(base, np.float64), np.asarray(exponent, np.float64)
    with np.errstate(under="ignore"):
        return np.asarray(np.power(np.maximum(base, 0.0), exponent))


def power_below_one(gap: ArrayLike, exponent: ArrayLike) -> Array:
    """max(1 − gap, 0)^exponent for gap >= 0, exact also where gap is tiny.

    Source: log1p, as in Higham, Accuracy and Stability of Numerical Algorithms, 2002,
    section 1.14.
    """
    gap, exponent = np.asarray(gap, np.float64), np.asarray(exponent, np.float64)
    inside = gap < 1.0
    logarithm = np.log1p(-np.where(inside, gap, 0.0))
    with np.errstate(under="ignore"):
        value = np.exp(exponent * logarithm)
    return np.asarray(np.where(inside, value, np.where(exponent == 0.0, 1.0, 0.0)))


def lobe(direction: ArrayLike, axis: ArrayLike, shininess: ArrayLike) -> Array:
    """max(direction · axis, 0)^shininess of unit vectors, shapes (..., 3) and (...).

    With d = direction − axis the cosine is 1 − d·d/2. The rounding of d·d/2 is
    relative to it, that of the dot product is relative to 1: at shininess 10^6 this
    is the difference between 6e-5 and 0.22 in float32.
    """
    difference = np.subtract(direction, axis, dtype=np.float64)
    return power_below_one(0.5 * dot(difference, difference), shininess)
