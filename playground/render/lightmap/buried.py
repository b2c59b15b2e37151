"""Texels whose point lies within something else, such as the floor under a box.

A lookup beside the box reads some of them. Their points are moved out to the nearest place that is
not buried, if that is near; otherwise they take over the light of texels around.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from playground.render.lightmap.gather import Points
from playground.render.lightmap.surroundings import Surroundings, frames, hemisphere
from playground.shading.floats import Array
from playground.shading.lightmap import dilated

Bools = NDArray[np.bool_]
PROBES = 16  # rays that ask whether a point is buried
OTHERS = 3  # of them that may see no back
WAYS = 16  # directions in which a way out is looked for
REACH = 1.5  # texels: the farthest that a lookup reads is the diagonal of one, √2
CLEAR = 1.0 / 64.0  # texels by which a point is moved beyond the surface that buried it
PASSES = 2  # how far texels that stay buried are filled from around


def buried(around: Surroundings, at: Points) -> Bools:
    """Which points (T,) lie within something: almost wherever they look, they see a back.

    Not quite every way, since the inside of a spout, say, is open at its end.
    """
    others = np.zeros(len(at.position), dtype=int)
    for ray in hemisphere(PROBES):
        left = np.flatnonzero(others <= OTHERS)
        if len(left) == 0:
            break
        here = at[left]
        direction = np.einsum("k,tkx->tx", ray, frames(here.side))
        met = around.meet(here.position + around.lift * here.side, direction)
        others[left] += (met.patch < 0) | met.front
    return np.asarray(others <= OTHERS)


def moved_out(around: Surroundings, at: Points, spacing: float) -> tuple[Points, Bools]:
    """The points, those that were buried moved out where there is a way; which still are, (T,)."""
    still = buried(around, at)
    lost = np.flatnonzero(still)
    here = at[lost]
    start = here.position + around.lift * here.side
    first, second, _ = np.moveaxis(frames(here.side), 1, 0)
    nearest, moved = np.full(len(lost), REACH * spacing), here.position.copy()
    for turn in np.arange(WAYS) * (2.0 * np.pi / WAYS):
        direction = np.cos(turn) * first + np.sin(turn) * second
        met = around.meet(start, direction, REACH * spacing)
        out = np.flatnonzero((met.patch >= 0) & ~met.front & (met.t < nearest))
        nearest[out] = met.t[out]
        step = (met.t[out] + CLEAR * spacing)[:, None]
        moved[out] = here.position[out] + step * direction[out]
    position = at.position.copy()
    position[lost] = moved
    result = Points(position, at.normal, at.side)
    still[lost] = buried(around, result[lost])
    return result, still


def filled(image: Array, wrong: Bools, covered: Bools) -> Array:
    """The image (H, W, C) with texels that are ``wrong`` (H, W) made of those around that are not.

    Only texels that are covered count, and only those are filled.
    """
    rows, columns = np.nonzero(wrong)
    texel = np.stack([columns, rows], axis=-1)
    result, known = image.copy(), covered & ~wrong
    result[wrong] = 0.0
    for _ in range(PASSES):
        now = known.copy()
        before = result.copy()
        for c in range(0, image.shape[2], 3):
            four = np.concatenate([before[..., c : c + 3], known[..., None]], axis=-1)
            new = dilated(four, texel)
            result[rows, columns, c : c + 3] = new[:, :3]
        now[rows, columns] = new[:, 3] > 0.0
        known = now
    return result
