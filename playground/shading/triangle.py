"""Where a ray meets a triangle, so that none slips between two.

Twin: shaders/lib/triangle.glsl. A ray is origin + t · direction with t > 0, the direction of
any length; t is `NO_HIT` = −1 where it passes by. Arrays broadcast: points and directions
(..., 3), results (...).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from playground.shading.floats import Array, floats
from playground.shading.ray import NO_HIT
from playground.shading.vector import dot


def ray_shear(direction: ArrayLike) -> Array:
    """The matrix that turns ``direction`` into (0, 0, 1) by a shear, shape (..., 3, 3).

    The largest component of the direction becomes z; its rows leave the other two
    coordinates as they are, less their share of z. Every vertex is transformed by itself, so
    that triangles with a common edge see the very same edge.
    Source: Woop, Benthin, Wald, Watertight Ray/Triangle Intersection, JCGT 2(1), 2013.
    """
    (direction,) = floats(direction)
    axis = np.argmax(np.abs(direction), axis=-1)
    one = np.eye(3, dtype=direction.dtype)
    z = one[axis]
    x, y = one[(axis + 1) % 3], one[(axis + 2) % 3]
    top = dot(direction, z)[..., None]
    shear_x = x - dot(direction, x)[..., None] / top * z
    shear_y = y - dot(direction, y)[..., None] / top * z
    return np.stack([shear_x, shear_y, z / top], axis=-2)


def sheared_triangle(a: ArrayLike, b: ArrayLike, c: ArrayLike) -> tuple[Array, Array]:
    """The t and weights (..., 3) with which the ray (0, 0, t) meets a triangle, `ray_shear`ed.

    Three edge functions of x and y decide. Rounding keeps the order of two products, so the
    sign of their difference is right or 0, and a ray on an edge hits: nothing slips between two
    triangles. One without area is never hit. Source: as `ray_shear`.
    """
    a, b, c = floats(a, b, c)
    u = c[..., 0] * b[..., 1] - c[..., 1] * b[..., 0]
    v = a[..., 0] * c[..., 1] - a[..., 1] * c[..., 0]
    w = b[..., 0] * a[..., 1] - b[..., 1] * a[..., 0]
    within = ((u >= 0.0) & (v >= 0.0) & (w >= 0.0)) | ((u <= 0.0) & (v <= 0.0) & (w <= 0.0))
    whole = u + v + w
    weights = np.stack([u, v, w], axis=-1) / np.where(whole == 0.0, 1.0, whole)[..., None]
    t = dot(weights, np.stack([a[..., 2], b[..., 2], c[..., 2]], axis=-1))
    hit = within & (whole != 0.0) & (t > 0.0)
    return np.where(hit, t, NO_HIT), np.where(hit[..., None], weights, 0.0)


def ray_triangle(
    origin: ArrayLike, direction: ArrayLike, a: ArrayLike, b: ArrayLike, c: ArrayLike
) -> tuple[Array, Array]:
    """The t and barycentric weights of ``a``, ``b``, ``c`` at the hit; edges count, both sides.

    A sliver costs digits: where its height is s times its length, the weights are off by
    roundings / s, and t is that of a point of the triangle that far beside the ray.
    Source: as `ray_shear`.
    """
    origin, direction, a, b, c = floats(origin, direction, a, b, c)
    shear = ray_shear(direction)
    corners = [np.einsum("...ij,...j->...i", shear, corner - origin) for corner in (a, b, c)]
    return sheared_triangle(*corners)
