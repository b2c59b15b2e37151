"""How much of an area light a point sees, from a few samples of it.

Twin: shaders/lib/shadow.glsl. The closed form of `area_light` knows of nothing in between; the
share of it that arrives is estimated from points on the light, each weighed by what it adds to
the closed form: exactly 1 where all points are seen, exactly 0 where none is.
Source: Heitz, Hill, McGuire, Combining Analytic Direct Illumination and Stochastic Shadows, I3D
2018 (the ratio estimator).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from playground.shading.floats import Array, floats
from playground.shading.vector import dot


def lamp_weight(
    to_lamp: ArrayLike, distance: ArrayLike, facing: ArrayLike, two_sided: bool
) -> Array:
    """The solid angle of a piece of a flat lamp per area of it, cos θ / d², shape (...).

    ``to_lamp`` (..., 3) is the unit vector from the point to the piece, ``distance`` (...) the way
    there, ``facing`` (3,) the lamp's unit normal; 0 behind a lamp that is not ``two_sided``.
    """
    to_lamp, distance, facing = floats(to_lamp, distance, facing)
    cosine = -dot(facing, to_lamp)
    cosine = np.abs(cosine) if two_sided else np.maximum(cosine, 0.0)
    return np.asarray(cosine / (distance * distance))


def visible_share(seen: ArrayLike, whole: ArrayLike) -> Array:
    """The weight of the samples seen over that of all, (...); 1 where no sample has a weight.

    Then only a sliver of the light between samples may shine there: its closed form stays whole.
    """
    seen, whole = floats(seen, whole)
    some = whole > 0.0
    return np.asarray(np.where(some, seen / np.where(some, whole, 1.0), 1.0))
