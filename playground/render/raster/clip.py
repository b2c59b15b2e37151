"""Cut triangles in homogeneous clip space, before the division by w.

Dividing first would send a point behind the eye (w < 0) to the wrong side of the picture and a
point beside the eye (w = 0) to infinity. A half-space a·p >= 0 needs no division, so the planes
are tested on (x, y, z, w) as they are; after the near and far planes every w is positive.
x and y are cut only at a *guard band* far outside the picture: pixels outside the picture are
never visited anyway, and fewer cuts mean fewer new, rounded vertices.

References
----------
Sutherland & Hodgman, Reentrant polygon clipping, CACM 17(1), 1974.
Blinn & Newell, Clipping using homogeneous coordinates, SIGGRAPH 1978.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]

NEAR: Floats = np.array([0.0, 0.0, 1.0, 1.0])  # z + w >= 0
FAR: Floats = np.array([0.0, 0.0, -1.0, 1.0])  # w - z >= 0

# Half the width of the guard band, in pixels from the picture's centre. With pictures of at most
# 2^15 pixels a side, window coordinates stay below 2^21 pixels = 2^29 units of 1/256 pixel, and
# an edge function, a sum of two products of differences, below 2^62: it fits int64.
GUARD_PIXELS = 2.0**20
MAX_NDC = 4.0 * GUARD_PIXELS  # twice the guard band of a picture one pixel wide


@dataclass(frozen=True)
class Clipped:
    """Pieces of triangles that lie inside all planes, in draw order.

    Attributes
    ----------
    position : (K, 3, 4) float64
        Clip-space corners of each piece; w > 0. Corners that were not cut are bit-identical copies.
    source : (K,) int64
        The triangle a piece comes from; ascending.
    weights : (K, 3, 3) float64
        ``weights[k, i]`` are the barycentric weights of corner i of piece k in its source
        triangle: ``weights[k, i] @ attribute[faces[source[k]]]`` is the attribute there.
    cut : (K,) bool
        False where the piece is the whole source triangle (its weights are the identity).
    """

    position: Floats
    source: Ints
    weights: Floats
    cut: Bools


class SegmentClip(NamedTuple):
    """One end point in, one out: where a segment crosses a plane; see `clip_segment`."""

    clipped: Bools
    visible: Bools
    t: Floats
    point: Floats


def frustum_planes(size: tuple[int, int]) -> Floats:
    """Near, far and the four sides of the guard band, as (6, 4) rows a with a·p >= 0 inside.

    `size` is (width, height) in pixels. A side at NDC ``g`` is ``g w - x >= 0``.
    """
    gx, gy = 2.0 * GUARD_PIXELS / size[0], 2.0 * GUARD_PIXELS / size[1]
    sides = [[1.0, 0.0, 0.0, gx], [-1.0, 0.0, 0.0, gx], [0.0, 1.0, 0.0, gy], [0.0, -1.0, 0.0, gy]]
    return np.vstack([NEAR, FAR, np.array(sides)])


def plane_distance(position: Floats, plane: Floats) -> Floats:
    """a·p for positions (..., 4): not a length, but its sign and its ratios are right.

    Added term by term, so that a vertex gets the same bits in every triangle that shares it.
    """
    x, y, z, w = np.moveaxis(position, -1, 0)
    total: Floats = plane[0] * x + plane[1] * y + plane[2] * z + plane[3] * w
    return total


def clip_segment(a: Floats, b: Floats, plane: Floats = NEAR) -> SegmentClip:
    """Clip segments from a to b, both (..., 4), against one plane.

    Returns
    -------
    SegmentClip
        ``clipped``: exactly one end lies outside (an end on the plane is inside); ``visible``:
        some end lies inside; ``t``: share of b at the crossing, d_a / (d_a - d_b), and ``point``
        (..., 4) there. Where nothing is clipped t is 0 and the point is a.
    """
    d_a, d_b = plane_distance(a, plane), plane_distance(b, plane)
    clipped = (d_a >= 0) != (d_b >= 0)

    # Both shares are ratios of numbers of one sign: nothing cancels but in d itself.
    span = np.where(clipped, d_a - d_b, 1.0)
    t = np.where(clipped, d_a, 0.0) / span
    rest = np.where(clipped, -d_b, 1.0) / span
    return SegmentClip(clipped, (d_a >= 0) | (d_b >= 0), t, rest[..., None] * a + t[..., None] * b)


def clip_triangles(clip: Floats, faces: Ints, planes: Floats) -> Clipped:
    """Cut the triangles of a mesh against planes (see `frustum_planes`).

    Parameters
    ----------
    clip : (N, 4) float64
        Vertices in clip space. A triangle with a vertex that is not finite is dropped.
    faces : (M, 3) int
    planes : (P, 4) float64

    Returns
    -------
    Clipped
        Two triangles that share an edge share every cut on it, to the last bit.
    """
    finite: Bools = np.all(np.isfinite(clip), axis=1, keepdims=True)
    position = np.where(finite, clip, 0.0)[faces]
    source = np.arange(len(faces))

    # Sort the triangles into those inside all planes, untouched, and those that need work.
    whole = (position[..., 3] > 0).all(axis=1)
    outside = ~finite[faces, 0].all(axis=1)
    for plane in planes:
        inside = plane_distance(position, plane) >= 0
        whole &= inside.all(axis=1)
        outside |= ~inside.any(axis=1)
    source_cut = source[~whole & ~outside]
    corner = np.empty((len(source_cut), 3, 7))
    corner[..., :4] = position[source_cut]
    corner[..., 4:] = np.eye(3)

    # Cut the rest plane by plane; a corner carries its weights along as three more coordinates.
    for plane in planes:
        corner, source_cut = _cut(corner, source_cut, plane)

    # A corner at w = 0, or so near it that only rounding put it inside the guard band, has no
    # place on the screen; its triangle passes through the eye and is seen edge-on, as a line.
    reach = np.abs(corner[..., :3]).max(axis=-1)
    solid = ((corner[..., 3] > 0) & (corner[..., 3] >= reach / MAX_NDC)).all(axis=1)
    return _merge(position[whole], source[whole], corner[solid], source_cut[solid])


def _cut(corner: Floats, source: Ints, plane: Floats) -> tuple[Floats, Ints]:
    """Keep the inside of one plane: of a triangle nothing, one, two or all of its corners."""
    distance = plane_distance(corner[..., :4], plane)
    inside = distance >= 0
    count = inside.sum(axis=1)

    # One corner inside: a smaller triangle. Bring that corner to the front.
    one = count == 1
    c, d = _rotate(corner[one], distance[one], inside[one].argmax(axis=1))
    tip = np.stack([c[:, 0], _meet(c, d, 0, 1), _meet(c, d, 0, 2)], axis=1)

    # Two corners inside: a quadrilateral, split in two. Bring the outside corner to the back.
    two = count == 2
    c, d = _rotate(corner[two], distance[two], inside[two].argmin(axis=1) + 1)
    far, back = _meet(c, d, 1, 2), _meet(c, d, 0, 2)
    lower = np.stack([c[:, 0], c[:, 1], far], axis=1)
    upper = np.stack([c[:, 0], far, back], axis=1)

    whole = count == 3
    corners = np.concatenate([corner[whole], tip, lower, upper])
    return corners, np.concatenate([source[whole], source[one], source[two], source[two]])


def _rotate(corner: Floats, distance: Floats, first: Ints) -> tuple[Floats, Floats]:
    """Renumber each triangle's corners cyclically so that `first` becomes number 0."""
    rows = np.arange(len(corner))[:, None]
    order = (first[:, None] + np.arange(3)) % 3
    return corner[rows, order], distance[rows, order]


def _meet(corner: Floats, distance: Floats, inner: int, outer: int) -> Floats:
    """Crossing of the edges inner-outer with the plane, always from the inside to the outside.

    The fixed direction gives both triangles at an edge the same bits.
    """
    d_in, d_out = distance[:, inner, None], distance[:, outer, None]
    point: Floats = corner[:, inner] * (-d_out / (d_in - d_out))
    point += corner[:, outer] * (d_in / (d_in - d_out))
    return point


def _merge(position: Floats, source: Ints, corner: Floats, source_cut: Ints) -> Clipped:
    """Join whole and cut triangles, back in draw order."""
    count, total = len(source), len(source) + len(source_cut)
    weights = np.broadcast_to(np.eye(3), (count, 3, 3))
    merged = Clipped(
        np.concatenate([position, corner[..., :4]]),
        np.concatenate([source, source_cut]),
        np.concatenate([weights, corner[..., 4:]]),
        np.arange(total) >= count,
    )
    if total == count:
        return merged
    order = np.argsort(merged.source, kind="stable")
    return Clipped(
        merged.position[order], merged.source[order], merged.weights[order], merged.cut[order]
    )
