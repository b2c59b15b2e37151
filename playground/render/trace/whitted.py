"""Whitted's recursion, without recursion: all rays of a depth at once.

Where a ray meets a surface, the local colour is added, times the ray's weight, and up to
two rays go on: the reflected one with the weight reflectance + transmittance · F, the refracted
one with transmittance · (1 − F), where F is the share that Fresnel's equations reflect. Nothing
is clamped. Rays that are not shot, because of their depth or because they weigh too little, are
not forgotten: what they would have weighed is handed on.
Source: Whitted, An Improved Illumination Model for Shaded Display, CACM 23(6), 1980.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from playground.render.trace.direct import direct
from playground.render.trace.hits import Hits, closest
from playground.render.trace.media import Inside
from playground.render.trace.meetings import Meetings, meetings
from playground.render.trace.traced_scene import TracedScene
from playground.shading.floats import Array
from playground.shading.optics import fresnel, refraction, schlick_either, sine_between
from playground.shading.ray import offset_ray
from playground.shading.vector import dot, reflection

BATCH = 2**14  # rays at a time: their arrays stay in the cache, and bound the memory
PASSES = 64  # boundaries within another medium that one ray may pass straight through
PRIMARY, REFLECTION, REFRACTION = 0, 1, 2

Ints = NDArray[np.intp]


class Rays(NamedTuple):
    """N rays of one depth: (N, 3) arrays, the pixel of each, and the media it has entered.

    ``weight`` is by what its colour is multiplied in the pixel. ``parent`` is the number of the
    ray that sent it out, −1 for a primary one; ``kind`` is PRIMARY, REFLECTION or REFRACTION.
    """

    origin: Array
    direction: Array
    weight: Array
    pixel: Array
    inside: Array
    parent: Array
    kind: Array

    def at(self, chosen: NDArray[np.generic] | slice) -> Rays:
        """Some of the rays."""
        return Rays(*(column[chosen] for column in self))


class Wave(NamedTuple):
    """What became of a batch of rays; ray i of it has the number ``first`` + i.

    ``rays`` are as they arrived: weakened by the media on their way, which is ``t`` (N,) long and
    may lead straight through boundaries that do not count. ``hit`` (K,) are the rays that met
    something, ``met`` where, ``local`` (K, 3) is the colour there. Of the boundary there:
    ``normal`` (K, 3), which mirrors and bends rays; ``fresnel``, ``index_i`` and ``index_t``
    (K,), 0 and equal indices where nothing goes in.
    ``added`` (N, 3) is what the rays bring to their pixels, ``lost`` (N, 3) the weight of rays that
    they would have sent out.
    """

    depth: int
    first: int
    rays: Rays
    t: Array
    hit: Ints
    met: Meetings
    local: Array
    normal: Array
    fresnel: Array
    index_i: Array
    index_t: Array
    added: Array
    lost: Array


def primary(scene: TracedScene, origin: Array, direction: Array, pixel: Ints) -> Rays:
    """N rays from the eye, ``origin`` and ``direction`` (N, 3), all of weight 1."""
    count = len(origin)
    return Rays(
        origin,
        direction,
        np.ones((count, 3)),
        pixel,
        np.tile(scene.around_eye, (count, 1)),
        np.full(count, -1, np.intp),
        np.full(count, PRIMARY, np.int8),
    )


def waves(scene: TracedScene, rays: Rays, limit: Array) -> Iterator[Wave]:
    """Follow primary rays, before ``limit`` (N,), and all that they send out; batch by batch.

    Batches that are still to be followed lie on a stack, so that there are never more than a few
    for each depth.
    """
    number = 0
    waiting = [(0, number, rays, limit)]
    while waiting:
        depth, _, batch, until = waiting.pop()
        wave, children = _step(scene, depth, number, batch, until)
        number += len(batch.pixel)
        yield wave
        for start in range(0, len(children.pixel), BATCH):
            part = children.at(slice(start, start + BATCH))
            waiting.append((depth + 1, number, part, np.full(len(part.pixel), np.inf)))


def _step(
    scene: TracedScene, depth: int, first: int, rays: Rays, limit: Array
) -> tuple[Wave, Rays]:
    """What a batch of rays meets, what it adds, and the rays that go on from there."""
    hits = closest(scene.solids, rays.origin, rays.direction, limit)
    start = rays.origin
    rays, hits, way = _arrived(scene, rays, hits)
    missed = hits.solid < 0
    added = np.where(missed[:, None], rays.weight * scene.setup.scene.background, 0.0)
    hit = np.flatnonzero(~missed)
    coming = rays.at(hit)
    some = Hits(*(column[hit] for column in hits))
    met = meetings(scene.solids, coming.origin, coming.direction, some)
    local = direct(scene, met)
    added[hit] = coming.weight * local

    boundary = _boundary(scene, coming, met)
    children = _children(scene, coming, met, boundary, first + hit)
    left_out = children.weight.max(axis=1, initial=0.0) < scene.settings.threshold
    if depth >= scene.settings.depth:
        left_out[:] = True
    lost = np.zeros_like(added)
    for channel in range(3):
        sources, weights = children.parent[left_out] - first, children.weight[left_out, channel]
        lost[:, channel] = np.bincount(sources, weights, len(added))
    optics = boundary.normal, boundary.share, boundary.index_i, boundary.index_t
    rays = rays._replace(origin=start)
    wave = Wave(depth, first, rays, way, hit, met, local, *optics, added, lost)
    return wave, children.at(~left_out)


def _arrived(scene: TracedScene, rays: Rays, hits: Hits) -> tuple[Rays, Hits, Array]:
    """The rays where something changes for them, their hits there, and how long their way was.

    They are weakened by the media on the way. A boundary within a medium of higher priority is
    passed straight through, and becomes their origin.
    """
    media = scene.media
    if not media.solids:
        return rays, hits, hits.t
    rays, way = Rays(*(column.copy() for column in rays)), hits.t.copy()
    going = np.arange(len(rays.pixel))
    for _ in range(PASSES):
        rays.weight[going] *= media.fading(rays.inside[going], hits.t[going])
        going = going[media.of_solid[hits.solid[going]] >= 0]
        if len(going) == 0 or len(media.solids) == 1:
            break
        some, found = rays.at(going), Hits(*(column[going] for column in hits))
        met = meetings(scene.solids, some.origin, some.direction, found)
        before, after = media.across(some.inside, media.of_solid[met.solid], met.front)
        passing = media.current(before) == media.current(after)
        going, met = going[passing], Meetings(*(column[passing] for column in met))
        rays.inside[going] = after[passing]
        rays.origin[going] = offset_ray(met.position, -met.side, met.error)
        some = rays.at(going)
        far = np.full(len(going), np.inf)
        hits.replaced(going, closest(scene.solids, some.origin, some.direction, far))
        way[going] += hits.t[going]
    return rays, hits, way


class _Boundary(NamedTuple):
    """What N surface points do with rays: normal (N, 3), F (N,), indices (N,), media (N, M)."""

    normal: Array
    share: Array
    index_i: Array
    index_t: Array
    before: Inside
    after: Inside


def _boundary(scene: TracedScene, rays: Rays, met: Meetings) -> _Boundary:
    media = scene.media
    medium = media.of_solid[met.solid]
    glass = np.flatnonzero(medium >= 0)
    before, after = rays.inside.copy(), rays.inside.copy()
    share, index_i = np.zeros(len(medium)), np.ones(len(medium))
    normal = np.where((dot(met.normal, met.to_eye) > 0.0)[:, None], met.normal, met.side)
    bounced = dot(reflection(normal, met.to_eye), met.side) > 0.0
    normal = np.where(bounced[:, None], normal, met.side)
    index_t = index_i
    if len(glass):
        sides = media.across(rays.inside[glass], medium[glass], met.front[glass])
        before[glass], after[glass] = sides
        index_i, index_t = media.index[media.current(before)], media.index[media.current(after)]
        bent = refraction(normal, met.to_eye, index_i, index_t)
        through = dot(bent, met.side) <= 0.0
        normal = np.where(through[:, None], normal, met.side)
        cosine, sine = dot(normal, met.to_eye), sine_between(normal, met.to_eye)
        formula = fresnel if scene.settings.fresnel == "exact" else schlick_either
        found = formula(cosine, sine, index_i, index_t)
        share[glass] = found[glass]
    return _Boundary(normal, share, index_i, index_t, before, after)


def _children(
    scene: TracedScene, rays: Rays, met: Meetings, boundary: _Boundary, number: Ints
) -> Rays:
    """The reflected and the refracted rays that weigh anything."""
    mirrored = np.array([solid.material.reflectance for solid in scene.solids]).reshape(-1, 3)
    through = np.array([solid.material.transmittance for solid in scene.solids]).reshape(-1, 3)
    share = boundary.share[:, None]
    reflected = rays.weight * (mirrored[met.solid] + through[met.solid] * share)
    refracted = rays.weight * through[met.solid] * (1.0 - share)

    parts = []
    for kind, weight in ((REFLECTION, reflected), (REFRACTION, refracted)):
        at = np.flatnonzero((weight > 0.0).any(axis=1))
        normal, to_eye, side = boundary.normal[at], met.to_eye[at], met.side[at]
        if kind == REFLECTION:
            direction, inside = reflection(normal, to_eye), boundary.before[at]
        else:
            indices = boundary.index_i[at], boundary.index_t[at]
            direction, inside = refraction(normal, to_eye, *indices), boundary.after[at]
            side = -side
        origin = offset_ray(met.position[at], side, met.error[at])
        kinds = np.full(len(at), kind, np.int8)
        ids = number[at], kinds
        parts.append(Rays(origin, direction, weight[at], rays.pixel[at], inside, *ids))
    return Rays(*(np.concatenate(columns) for columns in zip(*parts, strict=True)))
