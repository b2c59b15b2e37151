"""What a fragment knows of its triangle, and which fragment is seen.

On the screen the *depth* z/w of a triangle is a plane (that is why cards store z/w and not the
distance), but an attribute such as a colour is not: its foreshortening needs the weights divided
by w. Coverage used positions rounded to 1/256 pixel; interpolation uses the unrounded ones, so a
centre may lie outside by a hair and its weights reach slightly below 0: that extrapolates the
attribute's own plane, as GPUs do.

References
----------
Olano & Greer, Triangle scan conversion using 2D homogeneous coordinates, HWWS 1997.
Heckbert & Moreton, Interpolation for polygon texture mapping and shading, 1991.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from playground.render.raster.clip import Bools, Floats, Ints
from playground.render.raster.coverage import SUBPIXELS

# A triangle lower than this many pixels is a needle: rounding moved its edges by a good part of
# its height, and extrapolation from the unrounded corners could reach far outside. Such a one is
# interpolated on its rounded corners, inside which every covered sample lies.
NEEDLE_HEIGHT = 4.0 / SUBPIXELS

# Extrapolation ends where 1/w falls below this share of the farthest corner's: at twice its w.
HORIZON = 0.5


class DepthPlane(NamedTuple):
    """depth(x, y) = value + slope · ((x, y) - at), for K triangles: (K, 2), (K,), (K, 2)."""

    at: Floats
    value: Floats
    slope: Floats


def perspective_weights(clip: Floats, ndc: Floats) -> tuple[Floats, Floats]:
    """Barycentric weights of the point of a triangle that is seen at `ndc`; divides by no w.

    Solves ``sum_k b_k (x_k, y_k, w_k) = w (x, y, 1)`` with ``sum_k b_k = 1``. Subtracting x w_k and
    y w_k first moves the point of view to the pixel: b_k is then the area that the opposite edge
    spans with it. Corners at or behind the eye are welcome.

    Parameters
    ----------
    clip : (..., 3, 4) float64
        Corners in clip space; any signs of w.
    ndc : (..., 2) float64
        x and y of the sample in normalised device coordinates.

    Returns
    -------
    weights : (..., 3) float64
    one_over_w : (...) float64
        1/w of that point. Both are NaN where the triangle is seen edge-on (no such point).

    References
    ----------
    Olano & Greer 1997.
    """
    w = clip[..., 3]
    u = clip[..., 0] - ndc[..., 0, None] * w
    v = clip[..., 1] - ndc[..., 1, None] * w
    share = _opposite_areas(u, v)
    total = share.sum(axis=-1, keepdims=True)
    weights = share / np.where(total == 0, np.nan, total)
    depth = (weights * w).sum(axis=-1)
    return weights, 1.0 / np.where(depth == 0, np.nan, depth)


def interpolation_corners(xy: Floats, fixed: Ints) -> Floats:
    """Window corners (K, 3, 2) to interpolate on: unrounded, but rounded ones for needles.

    Either way the doubled area is not 0 and has the sign of the rounded triangle's, provided that
    `fixed`, the rounded corners in 1/256 pixel, is not collinear.
    """
    rounded = fixed / SUBPIXELS
    area, area_rounded = _doubled_area(xy), _doubled_area(rounded)
    edge = np.roll(xy, -1, axis=1) - xy
    longest = np.sqrt((edge**2).sum(axis=-1).max(axis=1))
    needle: Bools = area * np.sign(area_rounded) < NEEDLE_HEIGHT * longest
    needle |= longest == 0
    return np.where(needle[:, None, None], rounded, xy)


def depth_plane(xy: Floats, depth: Floats) -> DepthPlane:
    """The plane through corners (K, 3, 2) with depths (K, 3); the area must not be 0."""
    ab, ac = xy[:, 1] - xy[:, 0], xy[:, 2] - xy[:, 0]
    db, dc = depth[:, 1] - depth[:, 0], depth[:, 2] - depth[:, 0]
    area = ab[:, 0] * ac[:, 1] - ac[:, 0] * ab[:, 1]
    slope_x = (db * ac[:, 1] - dc * ab[:, 1]) / area
    slope_y = (dc * ab[:, 0] - db * ac[:, 0]) / area
    return DepthPlane(xy[:, 0], depth[:, 0], np.stack([slope_x, slope_y], axis=-1))


def depth_at(plane: DepthPlane, piece: Ints, x: Floats, y: Floats) -> Floats:
    """Depth (F,) of fragments of triangles `piece` at window positions x, y; within [0, 1]."""
    at, slope = plane.at[piece], plane.slope[piece]
    depth = plane.value[piece] + slope[:, 0] * (x - at[:, 0]) + slope[:, 1] * (y - at[:, 1])
    return np.clip(depth, 0.0, 1.0)


def window_weights(corner: Floats, one_over_w: Floats, x: Floats, y: Floats) -> Floats:
    """Perspective-correct weights (F, 3) at window positions x, y (F,).

    Parameters
    ----------
    corner : (F, 3, 2) float64
        Window corners of the triangle of each fragment.
    one_over_w : (F, 3) float64
        Positive.
    """
    areas = _opposite_areas(corner[..., 0] - x[:, None], corner[..., 1] - y[:, None])
    areas /= areas.sum(axis=-1, keepdims=True)
    share = areas * one_over_w

    # A sample just outside a far edge can lie near or beyond the horizon of the triangle's plane,
    # where 1/w, the sum, falls to 0 and below. Step back to the triangle, where it does not.
    beyond = share.sum(axis=-1) < HORIZON * one_over_w.min(axis=-1)
    share[beyond] = np.maximum(areas[beyond], 0.0) * one_over_w[beyond]
    share /= share.sum(axis=-1, keepdims=True)
    return share


def keep_nearest(buffer: Floats, pixel: Ints, depth: Floats) -> Ints:
    """Depth test: the fragment nearer than the buffer wins; the earliest one among equals.

    Parameters
    ----------
    buffer : (P,) float64
        Depth per pixel; updated in place.
    pixel, depth : (F,)
        Fragments in draw order; a pixel may occur many times.

    Returns
    -------
    (V,) int64
        Indices of the winning fragments, at most one per pixel.
    """
    contender = np.flatnonzero(depth < buffer[pixel])
    np.minimum.at(buffer, pixel[contender], depth[contender])
    contender = contender[depth[contender] == buffer[pixel[contender]]]

    # Write in reverse: of several assignments to one pixel the last one stays, the earliest drawn.
    place = pixel[contender]
    first = np.empty(len(buffer), dtype=np.int64)
    first[place[::-1]] = contender[::-1]
    winner: Ints = contender[first[place] == contender]
    return winner


def _opposite_areas(u: Floats, v: Floats) -> Floats:
    """Doubled areas of (origin, p_{k+1}, p_{k+2}) for points p = (u, v), (..., 3)."""
    n, m = [1, 2, 0], [2, 0, 1]
    area: Floats = u[..., n] * v[..., m] - u[..., m] * v[..., n]
    return area


def _doubled_area(xy: Floats) -> Floats:
    """Twice the signed area of triangles (K, 3, 2)."""
    ab, ac = xy[:, 1] - xy[:, 0], xy[:, 2] - xy[:, 0]
    area: Floats = ab[:, 0] * ac[:, 1] - ac[:, 0] * ab[:, 1]
    return area
