"""Directions: unit vectors, the reflection vector, the halfway vector, normals under a transform.

Twin: shaders/lib/vector.glsl. All directions point away from the surface.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from playground.shading.floats import Array as Array
from playground.shading.floats import floats


def dot(a: ArrayLike, b: ArrayLike) -> Array:
    """The scalar product along the last axis: shape (..., 3) · (..., 3) -> (...)."""
    a, b = floats(a, b)
    product = a * b
    return np.asarray(product[..., 0] + product[..., 1] + product[..., 2])


def cross(a: ArrayLike, b: ArrayLike) -> Array:
    """The vector product along the last axis: shape (..., 3) × (..., 3) -> (..., 3)."""
    a, b = floats(a, b)
    ax, ay, az = a[..., 0], a[..., 1], a[..., 2]
    bx, by, bz = b[..., 0], b[..., 1], b[..., 2]
    return np.stack([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx], axis=-1)


def length_any(v: ArrayLike) -> Array:
    """The length of vectors of any size, shape (..., 3) -> (...).

    Dividing by the largest component first keeps the squares from overflowing and
    vanishing. Error: 8 roundings, relative. Source: Blue, A Portable Fortran Program to Find
    the Euclidean Norm of a Vector, 1978.
    """
    (v,) = floats(v)
    largest = np.max(np.abs(v), axis=-1)
    safe = np.where(largest > 0.0, largest, 1.0)
    scaled = v / safe[..., None]
    return np.asarray(largest * np.sqrt(dot(scaled, scaled)))


def unit(v: ArrayLike) -> Array:
    """The unit vector v / |v| for any length, shape (..., 3); the zero vector stays zero.

    Error: 8 roundings of each component. Source: Blue 1978, as in `length_any`.
    """
    (v,) = floats(v)
    largest = np.max(np.abs(v), axis=-1, keepdims=True)
    scaled = v / np.where(largest > 0.0, largest, 1.0)
    norm = np.sqrt(dot(scaled, scaled))[..., None]
    return np.asarray(scaled / np.where(norm > 0.0, norm, 1.0))


def reflection(normal: ArrayLike, to_light: ArrayLike) -> Array:
    """The reflection vector r = 2 n (n·l) − l, of unit vectors of shape (..., 3).

    Error: 34 roundings for vectors that `unit` made.
    Source: Phong, Illumination for Computer Generated Pictures, CACM 18(6), 1975.
    """
    normal, to_light = floats(normal, to_light)
    return np.asarray(2.0 * dot(normal, to_light)[..., None] * normal - to_light)


def halfway(to_light: ArrayLike, to_eye: ArrayLike) -> Array:
    """The halfway vector h = (l + v) / |l + v|, of unit vectors of shape (..., 3).

    Source: Blinn, Models of Light Reflection for Computer Synthesized Pictures, 1977.
    """
    to_light, to_eye = floats(to_light, to_eye)
    return unit(to_light + to_eye)


def turned_to_eye(normal: ArrayLike, to_eye: ArrayLike) -> Array:
    """The normal of a surface seen from behind: turned to the eye where it looks away; (..., 3).

    An interpolated normal that faces the eye stays as it is, even where its triangle does
    not: a scanned mesh would show dark specks otherwise. Source: two-sided lighting,
    OpenGL 1.1 specification, section 2.13.1, which asks the triangle instead.
    """
    away = dot(normal, to_eye)[..., None] < 0.0
    return np.where(away, np.negative(normal), normal)


def orientation(linear: ArrayLike) -> float:
    """The sign of the determinant of ``linear``, shape (3, 3): −1 mirrors, 0 flattens.

    Exact for every matrix of finite numbers: each is a whole multiple of 2^-1074, and
    Python's whole numbers have no end. Rounding would give a flattened object a side
    by chance. Has no twin: once per object.

    Source: Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
    Predicates, 1997, on why the sign must be exact.
    """
    whole = [_whole(x) for x in np.asarray(linear, dtype=np.float64).reshape(9).tolist()]
    a, b, c, d, e, f, g, h, i = whole
    determinant = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
    return float((determinant > 0) - (determinant < 0))


def _whole(x: float) -> int:
    """The whole number x · 2^1074, exactly."""
    numerator, denominator = x.as_integer_ratio()
    return numerator * (2**1074 // denominator)


def normal_matrix(linear: ArrayLike) -> Array:
    """The matrix that carries normals along when ``linear`` carries points, shape (3, 3).

    The cofactor matrix turns a plane's normal with the plane, whatever the stretch, and needs
    no inverse; times the sign of the determinant, it keeps the normals of a mirrored object
    outwards. It is no rotation: normals must be made unit length again. Columns are
    scaled by powers of two first, so that scales from 1e-150 to 1e150 neither overflow nor
    vanish; the largest entry of the result is about 1. For float32 numbers every entry is right
    to 4 roundings of float64, even where the matrix is singular. Has no twin: once per object.

    Source: Akenine-Möller et al., Real-Time Rendering 4, section 4.1.7; Lengyel,
    Transforming Normals, 2024.
    """
    scale, columns = _scaled_columns(linear)
    c0, c1, c2 = columns
    cofactors = np.stack([np.cross(c1, c2), np.cross(c2, c0), np.cross(c0, c1)])

    # Undo the scaling up to one common factor: column k of the cofactors lost s_i s_j.
    cofactors *= np.min(scale) / scale
    sign = -1.0 if orientation(linear) < 0.0 else 1.0
    top = np.max(np.abs(cofactors))
    return np.asarray(sign * cofactors.T / (top if top > 0.0 else 1.0))


def _scaled_columns(linear: ArrayLike) -> tuple[Array, Array]:
    """A power of two for each column, (3, 1), and the columns divided by it, as rows (3, 3)."""
    columns = np.asarray(linear, dtype=np.float64).T
    _, exponent = np.frexp(np.max(np.abs(columns), axis=1, keepdims=True))
    scale = np.ldexp(1.0, exponent - 1)
    return scale, columns / scale
