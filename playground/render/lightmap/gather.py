"""The light that arrives at points of surfaces once radiosity is solved.

Light straight from emitters is a closed form times the share of the emitter that is seen; all other
light is gathered over the hemisphere by rays, each of which brings the colour of the patch it
meets (a "final gather").
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from playground.render.lightmap.surroundings import Surroundings, frames, hemisphere
from playground.render.radiosity.factor.visibility import Between
from playground.render.radiosity.patch.patches import Patches
from playground.render.trace.lamp import facing_of, points_on, square_points
from playground.shading.area_light import form_factor
from playground.shading.floats import Array
from playground.shading.light import toward
from playground.shading.shadow import lamp_weight, visible_share
from playground.shading.vector import dot

RAYS = 1 << 18  # sent together
PATTERNS = 16  # of rays, which together cover the hemisphere as densely as one of 16 times as many
MOST_EMITTERS = 64  # of which each has its closed form; more are met by the gathering rays


@dataclass(frozen=True, eq=False)
class Points:
    """Points on surfaces, relative to the origin of the patches; (T, 3) each."""

    position: Array
    normal: Array
    side: Array

    def __getitem__(self, chosen: NDArray[np.intp] | slice) -> Points:
        return Points(self.position[chosen], self.normal[chosen], self.side[chosen])


@dataclass(frozen=True, eq=False)
class Emitter:
    """A polygon (K, 3) that shines with ``radiance`` (3,) to its front."""

    corners: Array
    radiance: Array


def emitters(patches: Patches) -> list[Emitter]:
    """The undivided triangles and quads whose patches send out light of their own."""
    shining = np.flatnonzero(patches.emission.any(axis=1))
    parent, first = np.unique(patches.parent[shining], return_index=True)
    triangle = patches.parents.triangle[parent]
    return [
        Emitter(patches.parents.corners[p][: 3 if three else 4], patches.emission[patch])
        for p, three, patch in zip(parent, triangle, shining[first], strict=True)
    ]


def from_emitters(
    shining: list[Emitter], between: Between | None, at: Points, samples: int
) -> Array:
    """The light straight from emitters, (T, 3); ``samples`` shadow rays to each that is seen.

    Without ``between`` nothing stands in the way.
    """
    total = np.zeros_like(at.position)
    for emitter in shining:
        factor = form_factor(at.position, at.normal, emitter.corners, False)
        seen = np.flatnonzero(factor > 0.0)
        share = 1.0 if between is None else _share(emitter, between, at[seen], samples)
        total[seen] += (share * factor[seen])[:, None] * emitter.radiance
    return total


def _share(emitter: Emitter, between: Between, at: Points, samples: int) -> Array:
    """Which share of an emitter's light is not hidden, (T,)."""
    facing = facing_of(emitter.corners)
    seen, whole = np.zeros(len(at.position)), np.zeros(len(at.position))
    for point in points_on(emitter.corners, samples):
        direction, distance = toward(at.position, point)
        angle = lamp_weight(direction, distance, facing, False)
        weight = angle * np.maximum(dot(at.normal, direction), 0.0)
        whole += weight
        open_ = np.flatnonzero((weight > 0.0) & (dot(at.side, direction) > 0.0))
        ends = np.broadcast_to(point, (len(open_), 3))
        down = np.broadcast_to(facing, ends.shape)
        hidden = between.hidden(at.position[open_], at.side[open_], ends, down)
        seen[open_] += np.where(hidden, 0.0, weight[open_])
    return visible_share(seen, whole)


def gathered(
    around: Surroundings, at: Points, colours: Array, count: int, pattern: NDArray[np.intp]
) -> Array:
    """What ``count`` rays per point bring: the mean of the ``colours`` (N, C) they meet, (T, C).

    A back brings nothing, nor does a ray that meets nothing. Rays below the surface, to which a
    bent normal would send some, do not count. ``pattern`` (T,), below `PATTERNS`, chooses the
    rays of each point.
    """
    brought = np.vstack([colours, np.zeros(colours.shape[1])])
    result = np.empty((len(at.position), colours.shape[1]))
    rays = np.stack([hemisphere(count, shift) for shift in square_points(PATTERNS)])
    for rows in _parts(len(result), count):
        here = at[rows]
        direction = np.einsum("tsk,tkx->tsx", rays[pattern[rows]], frames(here.normal))
        above = np.einsum("tsx,tx->ts", direction, here.side) > 0.0
        origin = np.repeat(here.position + around.lift * here.side, above.sum(axis=1), axis=0)
        met = around.meet(origin, direction[above])
        value = np.zeros((*above.shape, colours.shape[1]))
        value[above] = brought[np.where(met.front, met.patch, -1)]
        result[rows] = value.sum(axis=1) / above.sum(axis=1)[:, None]
    return result


def _parts(points: int, rays: int) -> list[slice]:
    """All points in runs that send at most about `RAYS` rays."""
    step = max(RAYS // rays, 1)
    return [slice(first, first + step) for first in range(0, points, step)]
