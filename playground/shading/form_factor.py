"""Form factors in closed form: between points, and between plates that stand as in a box.

Twin: shaders/lib/form_factor.glsl. The form factor F_ij is the share of the light leaving i
that arrives at j, if nothing stands in between. With the areas A, A_i F_ij = A_j F_ji. That of a
point and a polygon is `area_light.form_factor`, that of two polygons `polygon_pair`, of round
shapes `form_factor_shapes`.

All arguments broadcast; results have their shape (...). Lengths are in any one unit, angles enter
as sine and cosine. Each formula is written so that nothing cancels, near or far: the
textbook forms of the rectangles lose all digits of float32 at a distance of 64 sides.

Sources: Cohen & Wallace, Radiosity and Realistic Image Synthesis, 1993; Howell, A Catalogue
of Radiation Heat Transfer Configuration Factors (numbers as there).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from playground.shading.floats import Array
from playground.shading.vector import dot


def point_to_point(x: ArrayLike, nx: ArrayLike, y: ArrayLike, ny: ArrayLike) -> Array:
    """F per area at y: cos θ_x cos θ_y / (π r²) of points x, y and normals nx, ny, (..., 3).

    In 1/length². 0 where either faces away or the points coincide. Normals may have any
    length, and r any size: no r² is formed. Error 16 roundings, plus those of x − y and n·r
    where these cancel. Source: Cohen & Wallace 1993, chapter 2.
    """
    cosines, near = _cosines(x, nx, y, ny)
    return np.asarray(near * cosines[0] * (near * cosines[1]) / np.pi)


def point_to_disc(
    x: ArrayLike, nx: ArrayLike, y: ArrayLike, ny: ArrayLike, area: ArrayLike
) -> Array:
    """F from point x to a patch around y, taken for a disc: cos θ_x cos θ_y A / (π r² + A).

    Exact for a disc on the common axis; unlike `point_to_point` it stays below 1 close by.
    Source: Wallace, Elmquist & Haines, A Ray Tracing Algorithm for Progressive Radiosity,
    SIGGRAPH 1989.
    """
    cosines, near = _cosines(x, nx, y, ny)
    size = np.sqrt(np.asarray(area, np.float64) / np.pi) * near  # of the disc, over the distance
    return np.asarray(cosines[0] * cosines[1] * (size / (1.0 + size * size)) * size)


def _cosines(
    x: ArrayLike, nx: ArrayLike, y: ArrayLike, ny: ArrayLike
) -> tuple[tuple[Array, Array], Array]:
    """The cosines at both points, not below 0, and 1/r; all 0 where the points coincide."""
    apart, size = _scaled(np.subtract(y, x, dtype=np.float64))
    (at_x, _), (at_y, _) = _scaled(np.asarray(nx, np.float64)), _scaled(np.asarray(ny, np.float64))
    length = np.sqrt(dot(apart, apart))
    safe = np.where(length > 0.0, length, 1.0)
    cosines = [
        np.maximum(along, 0.0) / (safe * np.where(squared > 0.0, np.sqrt(squared), 1.0))
        for along, squared in (
            (dot(at_x, apart), dot(at_x, at_x)),
            (-dot(at_y, apart), dot(at_y, at_y)),
        )
    ]
    near = np.where(length > 0.0, 1.0 / safe / size, 0.0)
    return (cosines[0], cosines[1]), near


def _scaled(v: Array) -> tuple[Array, Array]:
    """Vectors over a power of two near their length, exactly, and that power."""
    _, exponent = np.frexp(np.max(np.abs(v), axis=-1))
    return np.ldexp(v, -exponent[..., None]), np.ldexp(1.0, exponent)


def opposite_rectangles(width: ArrayLike, height: ArrayLike, gap: ArrayLike) -> Array:
    """F of two equal rectangles that face each other across a gap (Howell C-11).

    With x = width/gap, y = height/gap, u = √(1 + x²), w = √(1 + y²):
    F = 2/(π x y) [ ½ ln(u² w² / (u² + y²)) + x w atan(x/w) − x atan x
    + y u atan(y/u) − y atan y ]. Error 40 roundings, relative.
    """
    x = np.divide(width, gap, dtype=np.float64)
    y = np.divide(height, gap, dtype=np.float64)
    bracket = 0.5 * np.log1p(x * x / (1.0 + x * x + y * y) * y * y)
    bracket = bracket + x * stretch_of_angle(x, y) + y * stretch_of_angle(y, x)
    return np.asarray(2.0 / np.pi * bracket / (x * y))


def stretch_of_angle(x: ArrayLike, y: ArrayLike) -> Array:
    """The difference w atan(x/w) − atan x, w = √(1 + y²), without cancellation."""
    x, y = np.asarray(x, np.float64), np.asarray(y, np.float64)
    w = np.sqrt(1.0 + y * y)
    more = y * y / (1.0 + w)  # w − 1
    return np.asarray(more * np.arctan(x / w) - np.arctan(x * more / (w + x * x)))


def adjacent_rectangles(width: ArrayLike, other: ArrayLike, edge: ArrayLike) -> Array:
    """F of two rectangles at a right angle, from the one of ``width`` (Howell C-14).

    They share an edge of length ``edge``; ``other`` is the extent of the second from there.
    With w = width/edge, h = other/edge, r² = w² + h² and g(x) = x atan(1/x):
    F = 1/(π w) [ g(w) + g(h) − g(r) + ¼ ( ln((1 + w²)(1 + h²)/(1 + r²))
    + w² ln(w²(1 + r²)/((1 + w²) r²)) + h² ln(h²(1 + r²)/((1 + h²) r²)) ) ].
    Error 40 roundings, relative.
    """
    w = np.divide(width, edge, dtype=np.float64)
    h = np.divide(other, edge, dtype=np.float64)
    large, small = np.maximum(w, h), np.minimum(w, h)
    r = np.sqrt(w * w + h * h)
    more = small / (r + large) * small  # r − large
    angles = small * np.arctan2(1.0, small) - more * np.arctan2(1.0, r)
    angles = angles + large * np.arctan(more / (r * large + 1.0))
    logs = np.log1p(w / (1.0 + r * r) * h * h * w) + log_share(w, h) + log_share(h, w)
    return np.asarray((angles + 0.25 * logs) / (np.pi * w))


def log_share(w: ArrayLike, h: ArrayLike) -> Array:
    """The term w² ln(w²(1 + r²) / ((1 + w²) r²)), r² = w² + h².

    The fraction is 1 − h²/((1 + w²) r²): near 1 its gap counts.
    """
    w, h = np.asarray(w, np.float64), np.asarray(h, np.float64)
    r_squared = w * w + h * h
    missing = h / r_squared * h / (1.0 + w * w)
    whole = w / r_squared * w * ((1.0 + r_squared) / (1.0 + w * w))
    near = missing < 0.5
    log = np.where(
        near,
        np.log1p(-np.where(near, missing, 0.0)),
        np.log(np.where(near | (whole <= 0.0), 1.0, whole)),
    )
    return np.asarray(w * log * w)


def adjacent_strips(
    width: ArrayLike, other: ArrayLike, half_sine: ArrayLike, half_cosine: ArrayLike
) -> Array:
    """F of two infinitely long strips that share an edge, from the one of ``width``.

    ``half_sine`` and ``half_cosine`` are of half the angle between them. Hottel's crossed strings
    (Howell C-5 for equal widths, C-5a for any): F = (a + b − c)/(2a) with c the way between the far
    edges, c² = (a − b)² + 4ab sin²(θ/2).
    Then (a + b)² − c² = 4ab cos²(θ/2), and nothing cancels for nearly flat plates.
    Error 8 roundings, relative. Source: Hottel & Sarofim, Radiative Transfer, 1967.
    """
    a, b = np.asarray(width, np.float64), np.asarray(other, np.float64)
    sine, cosine = np.asarray(half_sine, np.float64), np.asarray(half_cosine, np.float64)
    far = np.sqrt((a - b) ** 2 + 4.0 * a * b * sine * sine)
    return np.asarray(2.0 * b / (a + b + far) * cosine * cosine)
