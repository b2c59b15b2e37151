"""A flat polygon by itself: its area, a ball around it, what of it lies in front of a plane.

Twin: shaders/lib/flat_polygon.glsl. Corners are (..., K, 3), counter-clockwise from the front; a
polygon with fewer corners repeats its last.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from playground.shading.vector import Array, cross, dot

ON_PLANE = 4.0 * 2.0**-53  # a height of this share of the distance is rounding: on the plane


def polygon_area(corners: ArrayLike) -> Array:
    """The area of flat polygons, (..., K, 3) -> (...)."""
    vector = area_vector(corners)
    return np.asarray(np.sqrt(dot(vector, vector)))


def area_vector(corners: ArrayLike) -> Array:
    """The normal, as long as the area, (..., 3). Source: Newell, in Sutherland et al. 1974."""
    corners = np.asarray(corners, np.float64)
    spokes = corners[..., 1:, :] - corners[..., :1, :]
    return np.asarray(0.5 * np.sum(cross(spokes[..., :-1, :], spokes[..., 1:, :]), axis=-2))


def heights(corners: Array, plane: Array) -> Array:
    """Heights (M, K) of corners (M, K, 3) over planes of polygons (M, L, 3); rounding gives 0."""
    normal = area_vector(plane)[:, None]
    length = np.sqrt(dot(normal, normal))
    away = corners - plane[:, :1]
    height = dot(away, normal) / np.where(length > 0.0, length, 1.0)
    return np.where(np.abs(height) > ON_PLANE * np.abs(away).sum(axis=-1), height, 0.0)


def clip_front(corners: ArrayLike, height: ArrayLike) -> Array:
    """What of polygons (M, K, 3) has a height >= 0, as (M, 2K, 3): corners may repeat.

    Source: Sutherland & Hodgman, Reentrant Polygon Clipping, CACM 17(1), 1974.
    """
    a, here = np.asarray(corners, np.float64), np.asarray(height, np.float64)
    b, there = np.roll(a, -1, axis=1), np.roll(here, -1, axis=1)
    crosses = here * there < 0.0
    share = here / np.where(crosses, here - there, 1.0)
    at = a + share[..., None] * (b - a)
    first = np.where((here >= 0.0)[..., None], a, at)
    points = np.stack([first, at], axis=2).reshape(len(a), -1, 3)
    kept = np.stack([(here >= 0.0) | crosses, crosses & (here > 0.0)], axis=2)
    kept = kept.reshape(len(a), -1)

    # What is not kept repeats the point before it, around the end to the last.
    slots = np.arange(kept.shape[1])
    before = np.maximum.accumulate(np.where(kept, slots, -1), axis=1)
    last = np.max(np.where(kept, slots, 0), axis=1, keepdims=True)
    before = np.where(before < 0, last, before)
    return np.take_along_axis(points, before[..., None], axis=1)


def ball_around(corners: Array) -> tuple[Array, Array]:
    """A ball around polygons: centres (M, 3) and radii (M,)."""
    centre = 0.5 * (corners.min(axis=1) + corners.max(axis=1))
    away = corners - centre[:, None]
    return centre, np.sqrt(dot(away, away).max(axis=1))


def quad_points(corners: Array, normal: Array, points: int) -> tuple[Array, Array]:
    """Gauss's points on quads (M, 4, 3), (M, points², 3), and the areas they stand for.

    Bilinear in the corners; a triangle repeats its last.
    """
    nodes, weights = np.polynomial.legendre.leggauss(points)
    s, t = (x.ravel()[:, None] for x in np.meshgrid(0.5 + 0.5 * nodes, 0.5 + 0.5 * nodes))
    a, b, c, d = (corners[:, k, None] for k in range(4))
    position = a + s * (b - a) + t * (d - a) + s * t * (c - b + a - d)
    along_s, along_t = b - a + t * (c - b + a - d), d - a + s * (c - b + a - d)
    area = dot(cross(along_s, along_t), normal[:, None])
    return position, area * 0.25 * np.outer(weights, weights).ravel()
