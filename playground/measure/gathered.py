"""The picture of a solution without patches to be seen: light gathered anew at every pixel.

At the point behind the centre of each pixel: emitters by closed form and many shadow rays, all
other light by rays over the hemisphere that bring the colours of the patches they meet. What
patches do to a picture (steps, smeared shadows, leaks) is not in it; their error in what
they send on is, and that is far smaller.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from playground.measure import metrics
from playground.measure.record import Errors
from playground.render.lightmap.gather import Points, emitters, from_emitters, gathered
from playground.render.lightmap.surroundings import Surroundings
from playground.render.radiosity.direct import arriving_at
from playground.render.radiosity.factor.visibility import between
from playground.render.radiosity.result import radiosity
from playground.render.trace.hits import closest
from playground.render.trace.meetings import meetings
from playground.render.trace.traced_scene import prepare
from playground.scene.setup import Setup
from playground.shading.floats import Array

Size = tuple[int, int]
PATCHES, QUICK_PATCHES = 2400, 300  # of the solution from which light is gathered
SHADOW_RAYS, QUICK_SHADOW_RAYS = 400, 100  # to each emitter
RAYS, QUICK_RAYS = 1024, 256  # over the hemisphere
REFERENCE = "light gathered at every pixel by rays, from the patches of a fine solution"


@dataclass(frozen=True, eq=False)
class Gathered:
    """Colours (H, W, 3) where ``known`` (H, W) says that a surface with stored light is seen."""

    pixels: Array
    known: NDArray[np.bool_]


def gathered_picture(setup: Setup, size: Size, quick: bool = False) -> Gathered:
    """The picture of the diffuse and emissive terms of ``setup``."""
    result = radiosity(setup.with_(patches=QUICK_PATCHES if quick else PATCHES, refinement=0))
    result.solve()
    result.close()
    patches, scene = result.patches, prepare(setup, size)
    pixel = np.arange(size[0] * size[1])
    rays = scene.rays_through(pixel % size[0] + 0.5, pixel // size[0] + 0.5)
    hits = closest(scene.solids, *rays)
    lamps = np.array([solid.object is None for solid in scene.solids])
    seen = np.flatnonzero((hits.solid >= 0) & ~lamps[hits.solid])
    met = meetings(scene.solids, rays[0][seen], rays[1][seen], type(hits)(*(c[seen] for c in hits)))
    position = met.position / scene.view.scale + (scene.view.eye - patches.origin)
    at = Points(position, met.normal, met.side)
    colours = result.light - patches.emission
    around = Surroundings(patches)
    shadow_rays, count = (QUICK_SHADOW_RAYS, QUICK_RAYS) if quick else (SHADOW_RAYS, RAYS)
    light = from_emitters(emitters(patches), between(patches), at, shadow_rays)
    light += arriving_at(setup, patches, position, met.normal, met.side)
    light += gathered(around, at, colours, count, seen % 16)
    weights, materials = setup.settings.weights, [item.material for item in setup.scene.objects]
    owner = np.array([-1 if solid.object is None else solid.object for solid in scene.solids])
    diffuse = np.array([m.diffuse for m in materials])[owner[met.solid]] * weights["diffuse"]
    emissive = np.array([m.emissive for m in materials])[owner[met.solid]] * weights["emissive"]
    pixels, known = np.zeros((len(pixel), 3)), np.zeros(len(pixel), dtype=bool)
    pixels[seen] = emissive + diffuse * met.texel * light
    known[seen] = met.front
    return Gathered(pixels.reshape(size[1], size[0], 3), known.reshape(size[1], size[0]))


def light_errors(got: Array, want: Gathered, **more: float) -> Errors:
    """The errors of a picture (H, W, 3) where both show stored light, as shares of the mean."""
    a, b = got[want.known].astype(np.float64), want.pixels[want.known]
    scale = float(np.mean(b))
    return Errors(
        rmse=metrics.rmse(a, b) / scale,
        max=metrics.largest(a, b) / scale,
        mean=float(np.mean(np.abs(a - b))) / scale,
        reference=REFERENCE,
        more=more,
    )
