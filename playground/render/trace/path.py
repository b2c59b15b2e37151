"""A picture of diffuse surfaces by chance: unbiased, slow, and with error bars. For checking.

Path tracing (Kajiya, The Rendering Equation, 1986) of what radiosity models, by rays instead of
patches: Lambertian surfaces that shine and reflect at their front and are black behind, lights of
every kind, no highlights, mirrors or ambient term. Its expected value is the exact
picture of the setup, whatever the number of samples; `standard_error` says how far off so many
samples typically are.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import count

import numpy as np
from numpy.typing import NDArray

from playground.render.image import Image
from playground.render.surface import SurfaceLight
from playground.render.trace.direct import BEFORE, light_of, shadow, unshadowed
from playground.render.trace.hits import Hits, arriving, closest
from playground.render.trace.lamp import facing_of
from playground.render.trace.meetings import Meetings, meetings
from playground.render.trace.solids import Solid
from playground.render.trace.traced_scene import prepare
from playground.scene.polygon import triangles
from playground.scene.setup import Setup
from playground.shading.floats import Array
from playground.shading.light import toward
from playground.shading.ray import offset_ray
from playground.shading.shadow import lamp_weight
from playground.shading.vector import cross, dot, unit

BATCH = 65536  # paths that go together
LONGEST = 0.95  # chance to go on at most, so that every path ends


class PathTracing:
    """One picture while it is made: can be looked at, and dropped, after every step.

    Parameters
    ----------
    setup : Setup
    size : (int, int)
        Width and height in pixels.
    seed : int
        Of the random numbers; pictures of different seeds are independent.
    """

    name = "path-traced"

    def __init__(self, setup: Setup, size: tuple[int, int], seed: int = 1) -> None:
        plain = setup.with_(specular=(0.0, 0.0, 0.0), clear_shadows=False)
        self.scene = prepare(plain, size)
        weight, solids = setup.settings.weights["diffuse"], self.scene.solids
        self._lamp = np.array([solid.object is None for solid in solids], dtype=bool)
        albedo = [np.array(s.material.diffuse) * weight * (s.object is not None) for s in solids]
        self._albedo = np.reshape(albedo, (-1, 3))
        self._glow = np.reshape([_glow(plain, solid) for solid in solids], (-1, 3))
        self._random = np.random.default_rng(seed)
        pixels = size[0] * size[1]
        self._sums = {part: np.zeros((pixels, 3)) for part in ("all", "squares", "direct")}
        self._covered, self.samples = np.zeros(pixels), 0

    def steps(self, samples: int) -> Iterator[float]:
        """Take ``samples`` more samples per pixel; yields the share of them that is done."""
        pixels = len(self._covered)
        for i in range(samples):
            for start in range(0, pixels, BATCH):
                chosen = np.arange(start, min(start + BATCH, pixels))
                self._sample(chosen)
                yield (i + chosen[-1] / pixels) / samples
            self.samples += 1
        yield 1.0

    def image(self, shown: str = "all") -> Image:
        """The mean of the samples so far; ``shown`` is all, direct or indirect light."""
        values = self._sums["all"]
        if shown == "direct":
            values = self._sums["direct"]
        elif shown == "indirect":
            values = values - self._sums["direct"]
        width, height = self.scene.size
        taken = max(self.samples, 1)
        colour = (values / taken).astype(np.float32).reshape(height, width, 3)
        covered = (self._covered / taken).astype(np.float32).reshape(height, width)
        return Image(colour, covered, self.scene.setup, self.name)

    def standard_error(self) -> Array:
        """Of the mean at each pixel, (H, W, 3); infinite before the second sample."""
        width, height = self.scene.size
        if self.samples < 2:
            return np.full((height, width, 3), np.inf)
        mean = self._sums["all"] / self.samples
        variance = np.maximum(self._sums["squares"] / self.samples - mean**2, 0.0)
        return np.sqrt(variance / (self.samples - 1)).reshape(height, width, 3)

    def _sample(self, pixel: NDArray[np.intp]) -> None:
        """One more path through each of some neighbouring pixels."""
        width = self.scene.size[0]
        direct, all_ = np.zeros((len(pixel), 3)), np.zeros((len(pixel), 3))
        x, y = self._random.random((2, len(pixel)))
        origin, direction, limit = self.scene.rays_through(pixel % width + x, pixel // width + y)
        hits = closest(self.scene.solids, origin, direction, limit)
        hit = np.flatnonzero(hits.solid >= 0)
        background = np.array(self.scene.setup.scene.background)
        all_[hits.solid < 0] = direct[hits.solid < 0] = background
        self._covered[pixel[hit]] += 1.0
        met = _met(self.scene.solids, origin, direction, hits, hit)
        glow = np.where(met.front[:, None], self._glow[met.solid], 0.0)
        all_[hit] += glow
        direct[hit] += glow
        weight = np.ones((len(hit), 3))
        for bounce in count():
            added, met, weight, on = self._scatter(met, weight)
            all_[hit] += added
            if bounce == 0:
                direct[hit] += added
            hit = hit[on]
            if len(hit) == 0:
                break
        sums = self._sums
        sums["all"][pixel] += all_
        sums["squares"][pixel] += all_**2
        sums["direct"][pixel] += direct

    def _scatter(
        self, met: Meetings, weight: Array
    ) -> tuple[Array, Meetings, Array, NDArray[np.intp]]:
        """Light that N points send on straight from lamps, and where the paths go from there.

        Returns what is added (N, 3), the next points (K, ...), their weights (K, 3), and which of
        the N they come from (K,).
        """
        albedo = self._albedo[met.solid] * met.texel
        albedo = np.where(met.front[:, None], albedo, 0.0)
        added = np.zeros_like(weight)
        on = np.flatnonzero((weight * albedo).any(axis=1))
        some = Meetings(*(column[on] for column in met))
        added[on] = weight[on] * self._from_lamps(some)
        weight = weight[on] * albedo[on]

        # Directions as likely as their cosine: the weight is the albedo alone.
        direction = _cosine_direction(some.normal, self._random.random((2, len(on))))
        above = np.flatnonzero(dot(direction, some.side) > 0.0)
        on, weight, direction = on[above], weight[above], direction[above]
        origin = offset_ray(some.position[above], some.side[above], some.error[above])
        hits = closest(self.scene.solids, origin, direction, np.full(len(on), np.inf))
        hit = np.flatnonzero(hits.solid >= 0)
        after = _met(self.scene.solids, origin, direction, hits, hit)
        on, weight = on[hit], weight[hit]
        seen = after.front & ~self._lamp[after.solid]  # what lamps send has been counted
        added[on] += np.where(seen[:, None], weight * self._glow[after.solid], 0.0)
        return (added, *self._survivors(after, weight, on))

    def _survivors(
        self, met: Meetings, weight: Array, on: NDArray[np.intp]
    ) -> tuple[Meetings, Array, NDArray[np.intp]]:
        """Paths that go on: by chance, the others' weight going to those that do."""
        chance = np.minimum(weight.max(axis=1, initial=0.0), LONGEST)
        lucky = np.flatnonzero(self._random.random(len(on)) < chance)
        met = Meetings(*(column[lucky] for column in met))
        return met, weight[lucky] / chance[lucky, None], on[lucky]

    def _from_lamps(self, met: Meetings) -> Array:
        """What arrives from every light and is sent on, (N, 3): one random point of each lamp."""
        sent = np.zeros_like(met.position)
        for number in range(len(self.scene.setup.scene.lights)):
            light = light_of(self.scene, number)
            if light.corners is not None:
                sent += self._from_area(number, light, met)
                continue
            diffuse, _, to_light = unshadowed(self.scene, number, met)
            lit = np.flatnonzero((diffuse > 0.0).any(axis=1))
            chosen = Meetings(*(column[lit] for column in met))
            share = shadow(self.scene, number, light, chosen, to_light[lit])
            sent[lit] += share * diffuse[lit]
        return sent

    def _from_area(self, number: int, light: SurfaceLight, met: Meetings) -> Array:
        assert light.corners is not None
        corners = self.scene.view.corners(light.corners)
        points, area = _random_points(corners, self._random.random((3, len(met.error))))
        start = offset_ray(met.position, met.side, met.error)
        direction, distance = toward(start, points)
        seen = lamp_weight(direction, distance, facing_of(corners), light.two_sided)
        cosine = np.maximum(dot(met.normal, direction), 0.0)
        factor = np.where(dot(met.side, direction) > 0.0, seen * cosine * area / np.pi, 0.0)
        open_ = np.flatnonzero(factor > 0.0)
        rays = start[open_], direction[open_], distance[open_] * BEFORE
        share = np.zeros_like(met.position)
        share[open_] = arriving(self.scene.solids, *rays, number, clear=False)
        sent = np.array(self.scene.setup.scene.lights[number].diffuse)
        sent = sent * self._albedo[met.solid] * met.texel
        return np.asarray(share * factor[:, None] * sent)


def _glow(setup: Setup, solid: Solid) -> Array:
    """What the front of a solid sends out by itself, (3,)."""
    if solid.object is None:  # a lamp: its side facing away is another colour, and so counted
        return np.asarray(solid.glow[0])
    weight = setup.settings.weights["emissive"]
    return np.asarray(weight * np.array(setup.scene.objects[solid.object].material.emissive))


def _met(
    solids: Sequence[Solid], origin: Array, direction: Array, hits: Hits, at: NDArray[np.intp]
) -> Meetings:
    """The points that some of the rays met."""
    found = Hits(*(column[at] for column in hits))
    return meetings(solids, origin[at], direction[at], found)


def _cosine_direction(normal: Array, random: Array) -> Array:
    """Unit vectors about normals (N, 3), as likely as their cosine; of random numbers (2, N).

    A point of the unit sphere added to the normal. Source: Pharr, Jakob, Humphreys, Physically
    Based Rendering, 4th ed., 2023, A.5 (Malley's method says the same).
    """
    up, turn = 2.0 * random[0] - 1.0, 2.0 * np.pi * random[1]
    flat = np.sqrt(np.maximum(1.0 - up * up, 0.0))
    ball = np.stack([flat * np.cos(turn), flat * np.sin(turn), up], axis=1)
    return unit(normal + ball * (1.0 - 1e-12))


def _random_points(corners: Array, random: Array) -> tuple[Array, float]:
    """Points of a flat polygon (K, 3), even over its area, and that area; random numbers (3, N)."""
    pieces = corners[triangles(corners, np.array([len(corners)]))]
    a, b, c = np.moveaxis(pieces, 1, 0)
    area = 0.5 * np.linalg.norm(cross(b - a, c - a), axis=1)
    chosen = np.searchsorted(np.cumsum(area) / area.sum(), random[0])
    a, b, c = (x[np.minimum(chosen, len(area) - 1)] for x in (a, b, c))
    along, across = np.sqrt(random[1])[:, None], random[2][:, None]
    points = (1.0 - along) * a + along * ((1.0 - across) * b + across * c)
    return points, float(area.sum())
