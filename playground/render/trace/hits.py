"""What rays meet first, and how much light gets through to a point.

All rays at once, one solid after the other; a mesh walks through its tree. Rays are (N, 3)
with directions of unit length, in the space relative to the eye.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from playground.render.trace.solids import Solid
from playground.shading.floats import Array
from playground.shading.optics import transmitted_share
from playground.shading.ray import offset_ray
from playground.shading.vector import dot

CROSSINGS = 256  # of one solid by one shadow ray; whatever is more folded than that blocks


class Hits(NamedTuple):
    """The first hits of N rays.

    ``t`` (N,), the number of the ``solid`` (N,), −1 for none; on a mesh also the ``triangle``
    (N,) and the ``weights`` (N, 3) of its corners.
    """

    t: Array
    solid: Array
    triangle: Array
    weights: Array

    def replaced(self, at: NDArray[np.intp], others: Hits) -> None:
        """Put other hits, as many as ``at`` has places (K,), there."""
        for mine, other in zip(self, others, strict=True):
            mine[at] = other


def closest(solids: Sequence[Solid], origin: Array, direction: Array, limit: Array) -> Hits:
    """The first hit of each ray before ``limit`` (N,); t is ∞ where there is none."""
    count = len(origin)
    hits = Hits(
        np.array(limit, dtype=np.float64),
        np.full(count, -1, dtype=np.intp),
        np.zeros(count, dtype=np.intp),
        np.zeros((count, 3)),
    )
    for number, solid in enumerate(solids):
        at = solid.near(origin, direction, hits.t)
        if not isinstance(at, slice) and len(at) == 0:
            continue
        t, *where = solid.meet(origin[at], direction[at], hits.t[at])
        nearer = (t > 0.0) & (t < hits.t[at])
        won = np.flatnonzero(nearer) if isinstance(at, slice) else at[nearer]
        hits.t[won], hits.solid[won] = t[nearer], number
        if where:
            hits.triangle[won], hits.weights[won] = (x[nearer] for x in where)
    hits.t[hits.solid < 0] = np.inf
    return hits


def arriving(
    solids: Sequence[Solid],
    origin: Array,
    direction: Array,
    limit: Array,
    lamp: int | None = None,
    clear: bool = True,
) -> Array:
    """The share of light that comes through from ``limit`` (N,) along each shadow ray, (N, 3).

    Opaque solids stop it. What is transmissive weakens it by its transmittance at each of its
    surfaces and by absorption within, but does not bend it, unless ``clear`` is false: then it
    stops it too. The face of light number ``lamp`` does not stand in its own way.
    """
    open_ = np.ones(len(origin), dtype=bool)
    others = [s for s in solids if lamp is None or s.surface.emitter != lamp]
    for solid in others:
        if not (clear and solid.transmissive):
            left = np.flatnonzero(open_)
            near = solid.near(origin[left], direction[left], limit[left])
            left = left[near]
            if len(left) == 0:
                continue
            open_[left] = ~solid.blocks(origin[left], direction[left], limit[left])
    share = np.repeat(open_[:, None].astype(np.float64), 3, axis=1)
    for solid in others:
        if clear and solid.transmissive:
            left = np.flatnonzero(open_)
            left = left[solid.near(origin[left], direction[left], limit[left])]
            share[left] *= _through(solid, origin[left], direction[left], limit[left])
    return share


def _through(solid: Solid, origin: Array, direction: Array, limit: Array) -> Array:
    """What one transmissive solid lets through, (N, 3): crossing after crossing.

    It absorbs along the way inside: the sum of all t at which the ray leaves less that of all at
    which it enters.
    """
    share, inside = np.ones((len(origin), 3)), np.zeros(len(origin))
    rays, gone = np.arange(len(origin)), np.zeros(len(origin))
    start, left = origin, limit
    for _ in range(CROSSINGS):
        hit = closest((solid,), start, direction[rays], left)
        met = hit.solid >= 0
        rays, start, left, hit = rays[met], start[met], left[met], Hits(*(x[met] for x in hit))
        if len(rays) == 0:
            break
        ahead = direction[rays]
        at = solid.points(start, ahead, hit.t, hit.triangle, hit.weights)
        leaving = dot(at.outward, ahead) > 0.0
        share[rays] *= solid.material.transmittance
        gone[rays] += hit.t
        inside[rays] += np.where(leaving, gone[rays], -gone[rays])
        side = np.where(leaving[:, None], at.outward, -at.outward)
        start, left = offset_ray(at.position, side, at.error), left - hit.t
    share[rays] = 0.0
    return share * transmitted_share(solid.absorption, np.maximum(inside, 0.0))
