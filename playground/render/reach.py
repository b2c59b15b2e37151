"""Area lights too large or too far for the numbers of a shader, made fit without being seen.

A shader has the corners of a light in single precision, and finds the plane between them.
Corners a million times as far as the scene leave that plane 0.06 scene sizes off.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from playground.errors import PlaygroundError
from playground.shading.vector import cross

Array = NDArray[np.float64]
WIDEST = 2.0**14  # distances: the sky beyond and rounding within each change a picture by 3e-5
FARTHEST_CORNER = 1e9  # scene sizes: the products of four in a shader must not overflow


def within_reach(corners: Array) -> Array:
    """The corners (K, 3) of an area light, relative to the eye in scene sizes, made fit.

    A light much larger than it is far is cut at `WIDEST` times its distance, at least that
    of the scene: what is left fills the same sky but for 3e-5 of it. After that a light with a
    corner beyond `FARTHEST_CORNER` is shrunk towards the eye: it looks the same from
    there, and nearly so from all of the scene.

    Raises
    ------
    PlaygroundError
        It must be cut and is no rectangle: what is left would have other corners.
    """
    if np.max(np.abs(corners)) > WIDEST:
        corners = _cut(corners)
    return corners / max(float(np.max(np.abs(corners))) / FARTHEST_CORNER, 1.0)


def _cut(corners: Array) -> Array:
    """A rectangle within `WIDEST` of its point nearest to the eye.

    With sides u and v at right angles, a point is first + s u + t v, and s and t of the nearest
    one are those of the eye itself, clamped to the rectangle.
    """
    if not _is_rectangle(corners):
        _refuse_wide(corners)
        return corners
    first, u, v = corners[0], corners[1] - corners[0], corners[3] - corners[0]
    sides = np.array([np.sqrt(u @ u), np.sqrt(v @ v)])
    place = np.clip(np.array([-(first @ u), -(first @ v)]) / sides**2, 0.0, 1.0)
    nearest = first + place[0] * u + place[1] * v
    reach = WIDEST * max(float(np.sqrt(nearest @ nearest)), 1.0) / sides
    low, high = np.maximum(place - reach, 0.0), np.minimum(place + reach, 1.0)
    parts = ((low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1]))
    return np.array([first + s * u + t * v for s, t in parts])


def _is_rectangle(corners: Array) -> bool:
    """Whether the corners are four at right angles, to what float64 leaves of them."""
    if len(corners) != 4:
        return False
    u, v = corners[1] - corners[0], corners[3] - corners[0]
    extent = float(np.max(np.abs(corners - corners[0])))
    closed = np.max(np.abs(corners[2] - corners[1] - v)) <= 1e-9 * extent
    return bool(closed and abs(u @ v) <= 1e-9 * np.sqrt((u @ u) * (v @ v)) > 0.0)


def _refuse_wide(corners: Array) -> None:
    """Raise unless a polygon is at most `WIDEST` times as large as it is surely far."""
    centre = np.mean(corners, axis=0)
    apart = corners - centre
    radius = float(np.sqrt(np.max(np.sum(apart**2, axis=1))))
    above = np.sum(cross(apart, np.roll(apart, -1, axis=0)), axis=0)  # the normal of its plane
    height = abs(float(above @ centre)) / float(np.sqrt(above @ above))
    limit = WIDEST * max(float(np.sqrt(centre @ centre)) - radius, height, 1.0)
    if radius > limit:
        raise PlaygroundError(
            "a polygon light is too large beside what the camera sees",
            got=f"{radius:.3g} times as large",
            allowed=f"up to {limit:.3g} times",
            fix="Bring its corners nearer, or use a rectangle: that is cut to fit.",
        )
