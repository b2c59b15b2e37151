"""The light that comes straight from directional, point and spot lights, with shadows.

It is no part of what patches exchange: the radiosity equation adds it to what arrives. In the unit
of colours, s_d max(n·l, 0) times what distance and spot cone leave, as in
`playground.render.shade`. Area lights are patches themselves.
"""

from __future__ import annotations

import numpy as np

from playground.render.radiosity.factor.pairs import point_at, stretch
from playground.render.radiosity.factor.visibility import between, size_of
from playground.render.radiosity.patch.patches import Patches
from playground.render.shade import from_lamp
from playground.render.surface import SurfaceLight, surface_light
from playground.render.trace.walk import blocked
from playground.scene.material import Material
from playground.scene.scene import Object
from playground.scene.setup import Setup
from playground.shading.floats import Array
from playground.shading.phong import diffuse_factor
from playground.shading.vector import dot, length_any

POINTS = 4  # per side of a patch: 16 in all, between which a shadow's edge may run
BEFORE = 1.0 - 1e-9  # of the way to a light: what lies nearer to it than this is the light itself
FARTHEST = 8.0  # largest coordinates from any point: nothing of the scene is beyond
WHITE = Object(material=Material(diffuse=(1.0, 1.0, 1.0)))  # reflects what arrives
WEIGHTS = {"diffuse": 1.0, "specular": 0.0}


def direct_light(setup: Setup, patches: Patches) -> Array:
    """D_i, (N, 3): the mean over each patch, from 4 × 4 of Gauss's points on it.

    For a square under a point light as high as its side, fading as 1/d², it is right to 6e-5
    without a shadow; the error falls as the height to the power of -8.
    """
    total = np.zeros((len(patches), 3))
    if not lamps(setup):
        return total
    nodes, weights = np.polynomial.legendre.leggauss(POINTS)
    side = patches.polygon, patches.normal
    for s, along in zip(nodes, weights, strict=True):
        for t, across in zip(nodes, weights, strict=True):
            place = np.array([1.0 + s, 1.0 + t]) / 2.0
            share = along * across / 4.0 * stretch(side, place) / patches.area
            light = arriving_at(setup, patches, point_at(patches.polygon, place), patches.normal)
            total += share[:, None] * light
    return total


def arriving_at(
    setup: Setup, patches: Patches, points: Array, normals: Array, sides: Array | None = None
) -> Array:
    """The same at points on surfaces, (P, 3).

    Parameters
    ----------
    patches : Patches
        Those of ``setup``: what casts the shadows.
    points : (P, 3) array
        Relative to the origin of the patches.
    normals, sides : (P, 3) arrays
        Unit normals, and if these are interpolated those of the flat pieces the points lie on.
    """
    total = np.zeros_like(points)
    sides = normals if sides is None else sides
    for light in lamps(setup):
        to_light, distance, strength = _light_at(light, points, patches.origin)
        factor = strength * diffuse_factor(normals, to_light)
        lit = np.flatnonzero((factor > 0.0) & (dot(sides, to_light) > 0.0))
        if setup.settings.occlusion and len(lit):
            stands = between(patches)
            origin = points[lit] + stands.lift * sides[lit]
            limit = BEFORE * np.minimum(distance[lit], FARTHEST * size_of(patches))
            lit = lit[~blocked(stands.whole, origin, to_light[lit], limit)]
        total[lit] += factor[lit, None] * light.diffuse
    return total


def lamps(setup: Setup) -> list[SurfaceLight]:
    """The lights that count here: no area light, and none that is black."""
    found = [surface_light(light, WHITE, WEIGHTS) for light in setup.scene.lights]
    return [light for light in found if light.corners is None and light.diffuse.any()]


def _light_at(light: SurfaceLight, points: Array, origin: Array) -> tuple[Array, Array, Array]:
    """Unit vectors to the light (P, 3), its distance and what is left of its strength, (P,)."""
    if light.to_light is not None:
        to_light = np.broadcast_to(light.to_light, points.shape)
        return to_light, np.full(len(points), np.inf), np.ones(len(points))
    assert light.position is not None
    place = light.position - origin
    to_light, strength = from_lamp(light, points, place, light.attenuation)
    return to_light, length_any(place - points), strength
