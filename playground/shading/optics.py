"""Light at a smooth boundary: Snell's law, Fresnel's equations, Beer–Lambert absorption.

Twin: shaders/lib/optics.glsl. The boundary is met from the side of ``normal``, where ``to_eye``
points too: the ray came along −to_eye. ``index_i`` is the refractive index of that side,
``index_t`` that of the far side. Angles enter as sine and cosine, each computed where it
has no cancellation. The mirrored direction is `vector.reflection` of ``to_eye``.
"""

from __future__ import annotations

from math import log, log1p

import numpy as np
from numpy.typing import ArrayLike

from playground.shading.floats import Array, floats
from playground.shading.vector import cross, dot


def sine_between(a: ArrayLike, b: ArrayLike) -> Array:
    """The sine of the angle between unit vectors, shapes (..., 3) -> (...).

    From the cross product: 1 − cos² has no digit left near the normal.
    """
    across = cross(a, b)
    return np.asarray(np.sqrt(dot(across, across)))


def cosine_transmitted(sine_i: ArrayLike, index_i: ArrayLike, index_t: ArrayLike) -> Array:
    """The cosine of θ_t by Snell's law n_i sin θ_i = n_t sin θ_t; −1 for total reflection.

    cos² θ_t = (n_t − n_i sin θ_i)(n_t + n_i sin θ_i) / n_t²: near the critical angle the
    difference is formed once, before anything is squared. Arrays broadcast to (...).
    Source: Born and Wolf, Principles of Optics, section 1.5.1, for the law.
    """
    sine_i, index_i, index_t = floats(sine_i, index_i, index_t)
    along = index_i * sine_i
    squared = (index_t - along) * (index_t + along)
    cosine = np.sqrt(np.maximum(squared, 0.0)) / index_t
    return np.asarray(np.where(squared < 0.0, np.full_like(cosine, -1.0), cosine))


def refraction(
    normal: ArrayLike, to_eye: ArrayLike, index_i: ArrayLike, index_t: ArrayLike
) -> Array:
    """The direction of the refracted ray, shape (..., 3); zero for total internal reflection.

    t = −(n_i/n_t) (v − (n·v) n) − cos θ_t n of unit vectors: the part of v along the
    surface keeps its length times n_i/n_t (Snell), and the ray crosses the surface.
    Source: Whitted, An Improved Illumination Model for Shaded Display, CACM 23(6), 1980.
    """
    normal, to_eye, index_i, index_t = floats(normal, to_eye, index_i, index_t)
    cosine_t = cosine_transmitted(sine_between(normal, to_eye), index_i, index_t)[..., None]
    along = to_eye - dot(normal, to_eye)[..., None] * normal
    direction = -(index_i / index_t)[..., None] * along - cosine_t * normal
    return np.asarray(np.where(cosine_t < 0.0, np.zeros_like(direction), direction))


def fresnel_polarised(
    cosine_i: ArrayLike, sine_i: ArrayLike, index_i: ArrayLike, index_t: ArrayLike
) -> tuple[Array, Array]:
    """The shares R_s and R_p of light that a boundary reflects, by polarisation; (...) each.

    The textbook r_s = (n_i cos θ_i − n_t cos θ_t) / (n_i cos θ_i + n_t cos θ_t) subtracts
    equals when the indices are close. Multiplied through by its denominator and with Snell's
    law, r_s = (n_i − n_t)(n_i + n_t) / (n_i cos θ_i + n_t cos θ_t)² and
    r_p = (n_t − n_i)(n_t + n_i)(1 − sin² θ_i (1 + n_i²/n_t²)) / (n_t cos θ_i + n_i cos θ_t)².
    Equal indices reflect nothing, total internal reflection everything.
    Source: Fresnel 1823; Born and Wolf, Principles of Optics, section 1.5.2.
    """
    cosine_i, sine_i, index_i, index_t = floats(cosine_i, sine_i, index_i, index_t)
    cosine_t = cosine_transmitted(sine_i, index_i, index_t)
    total = cosine_t < 0.0
    cosine_t = np.maximum(cosine_t, 0.0)
    contrast = (index_t - index_i) * (index_t + index_i)
    ratio = index_i / index_t
    across = index_i * cosine_i + index_t * cosine_t
    within = index_t * cosine_i + index_i * cosine_t
    brewster = 1.0 - sine_i * sine_i * (1.0 + ratio * ratio)

    # Along the surface both denominators vanish between equal indices: nothing is reflected.
    grazing = (across == 0.0) | (within == 0.0)
    missing = np.where(contrast == 0.0, 0.0, 1.0)
    r_s = contrast / np.where(grazing, 1.0, across * across)
    r_p = contrast * brewster / np.where(grazing, 1.0, within * within)
    whole = np.ones_like(r_s)
    share_s = np.where(total, whole, np.where(grazing, missing, r_s * r_s))
    share_p = np.where(total, whole, np.where(grazing, missing, r_p * r_p))
    return share_s, share_p


def fresnel(
    cosine_i: ArrayLike, sine_i: ArrayLike, index_i: ArrayLike, index_t: ArrayLike
) -> Array:
    """The share of unpolarised light that a boundary reflects: (R_s + R_p) / 2, shape (...).

    Source: Born and Wolf, Principles of Optics, section 1.5.3.
    """
    share_s, share_p = fresnel_polarised(cosine_i, sine_i, index_i, index_t)
    return np.asarray(0.5 * (share_s + share_p))


def schlick(
    cosine_i: ArrayLike, sine_i: ArrayLike, index_i: ArrayLike, index_t: ArrayLike
) -> Array:
    """Schlick's approximation R_0 + (1 − R_0)(1 − cos θ_i)⁵ of `fresnel`, shape (...).

    1 for total internal reflection. Meant for θ_i on the side of the smaller index, where it is
    off by at most 0.036 at n = 1.5; from the denser side give it the angles and indices of the
    transmitted ray, or it is off by up to 0.93. At equal indices it still reflects
    (1 − cos θ_i)⁵ where the exact answer is 0.
    Source: Schlick, An Inexpensive BRDF Model, Computer Graphics Forum 13(3), 1994, eq. 15.
    """
    cosine_i, sine_i, index_i, index_t = floats(cosine_i, sine_i, index_i, index_t)
    root = (index_i - index_t) / (index_i + index_t)
    at_normal = root * root
    slant = np.clip(1.0 - cosine_i, 0.0, 1.0)
    squared = slant * slant
    share = at_normal + (1.0 - at_normal) * squared * squared * slant
    total = cosine_transmitted(sine_i, index_i, index_t) < 0.0
    return np.asarray(np.where(total, np.ones_like(share), share))


def schlick_either(
    cosine_i: ArrayLike, sine_i: ArrayLike, index_i: ArrayLike, index_t: ArrayLike
) -> Array:
    """`schlick` from either side, shape (...): takes the angle on the side of the smaller index."""
    cosine_i, sine_i, index_i, index_t = floats(cosine_i, sine_i, index_i, index_t)
    cosine_t = cosine_transmitted(sine_i, index_i, index_t)
    thin = np.where((index_i > index_t) & (cosine_t >= 0.0), cosine_t, cosine_i)
    return schlick(thin, sine_i, index_i, index_t)


def transmitted_share(absorption: ArrayLike, distance: ArrayLike) -> Array:
    """What a coloured medium lets through on a way, e^(−a d); shapes (..., 3), (...) -> (..., 3).

    Source: Beer 1852; Lambert, Photometria, 1760. ``absorption`` is per unit of length.
    """
    absorption, distance = floats(absorption, distance)
    with np.errstate(under="ignore", over="ignore"):
        return np.asarray(np.exp(-absorption * distance[..., None]))


def plate_shift(
    thickness: ArrayLike,
    cosine_i: ArrayLike,
    sine_i: ArrayLike,
    index_i: ArrayLike,
    index_t: ArrayLike,
) -> Array:
    """How far a plane-parallel plate moves a ray aside: a length, like ``thickness``; (...).

    d sin θ_i (n_t cos θ_t − n_i cos θ_i) / (n_t cos θ_t): within the plate the way is d / cos θ_t
    long and turned by θ_i − θ_t, which makes d sin(θ_i − θ_t) / cos θ_t; then Snell's law.
    """
    thickness, cosine_i, sine_i, index_i, index_t = floats(
        thickness, cosine_i, sine_i, index_i, index_t
    )
    bent = index_t * cosine_transmitted(sine_i, index_i, index_t)
    return np.asarray(thickness * sine_i * (bent - index_i * cosine_i) / bent)


def mirror_series(rho: ArrayLike, bounces: ArrayLike) -> Array:
    """1 + ρ + ρ² + ... up to ρ^bounces: what is seen between two mirrors of reflectance ρ; (...).

    (1 − ρ^(bounces+1)) / (1 − ρ), its numerator from log1p and expm1: for ρ near 1 a running sum
    drifts, and a difference of two numbers near 1 has few digits. ρ from 0 to 1.
    Source: Higham, Accuracy and Stability of Numerical Algorithms, 2002, section 1.14.
    """
    rho, bounces = floats(rho, bounces)
    with np.errstate(divide="ignore", invalid="ignore"):
        shown = -np.expm1((bounces + 1.0) * np.log1p(rho - 1.0)) / (1.0 - rho)
    return np.asarray(np.where(rho == 1.0, bounces + 1.0, shown))


def bounces_until(rho: float, missing: float) -> int:
    """The fewest bounces after which `mirror_series` lacks less than the share ``missing``.

    The smallest d >= 0 with ρ^(d+1) < missing, for 0 <= ρ < 1 and 0 < missing < 1.

    Raises
    ------
    ValueError
        ρ or missing is outside of these: no number of bounces would do.
    """
    if not (0.0 <= rho < 1.0 and 0.0 < missing < 1.0):
        raise ValueError(f"no number of bounces suffices: rho {rho!r}, missing {missing!r}")
    if rho == 0.0:
        return 0
    bounces = max(int(log(missing) / log1p(rho - 1.0)) - 1, 0)
    while rho ** (bounces + 1) >= missing:
        bounces += 1
    while bounces > 0 and rho**bounces < missing:
        bounces -= 1
    return bounces
