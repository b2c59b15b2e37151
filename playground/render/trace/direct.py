"""The light that reaches points straight from the lights: the Phong model, and shadow rays.

The terms are those of `playground.render.shade`, at every hit of every ray. A light adds its
diffuse and specular term only where both normals see it and its shadow ray arrives; no shadow
ray is shot to a light that adds nothing. Ambient and emissive terms cast no shadow.

For an area light the closed form gives the light without shadows; `Settings.light_samples` points
on it, the same at every pixel, say which share of each term arrives.
"""

from __future__ import annotations

import numpy as np

from playground.render.shade import contribution
from playground.render.surface import SurfaceLight
from playground.render.trace.hits import arriving
from playground.render.trace.lamp import facing_of, points_on
from playground.render.trace.meetings import Meetings
from playground.render.trace.traced_scene import TracedScene
from playground.shading.floats import Array
from playground.shading.light import toward
from playground.shading.phong import blinn_factor, specular_factor
from playground.shading.ray import offset_ray
from playground.shading.shadow import lamp_weight, visible_share
from playground.shading.vector import dot

BEFORE = 1.0 - 1e-9  # of the way to a light: what lies nearer to it than this is the light itself


def direct(scene: TracedScene, met: Meetings) -> Array:
    """The local colour at each point, (N, 3): what the rasteriser shows, with shadows."""
    colour = np.empty_like(met.position)
    for number, solid in enumerate(scene.solids):
        front, back = solid.glow
        at = met.solid == number
        colour[at] = np.where(met.front[at, None], front, back)
    for number in range(len(scene.setup.scene.lights)):
        diffuse, specular, to_light = unshadowed(scene, number, met)
        lit = np.flatnonzero((diffuse > 0.0).any(axis=1) | (specular > 0.0).any(axis=1))
        if len(lit) == 0:
            continue
        chosen = Meetings(*(column[lit] for column in met))
        light = light_of(scene, number)
        if light.corners is None:
            share = shadow(scene, number, light, chosen, to_light[lit])
            colour[lit] += share * (diffuse[lit] + specular[lit])
        else:
            share_d, share_s = soft_shadow(scene, number, light, chosen)
            colour[lit] += share_d * diffuse[lit] + share_s * specular[lit]
    return colour


def light_of(scene: TracedScene, number: int) -> SurfaceLight:
    """One light; where it stands is the same for every surface."""
    return next(s.surface.lights[number] for s in scene.solids if s.object is not None)


def unshadowed(scene: TracedScene, number: int, met: Meetings) -> tuple[Array, Array, Array]:
    """Diffuse and specular term of one light and the vector to it, (N, 3) each, surface by surface.

    Zero where a point light is behind one of the normals; an area light may be so in part.
    """
    diffuse, specular, to_light = (np.zeros_like(met.position) for _ in range(3))
    for n, solid in enumerate(scene.solids):
        if solid.object is None:
            continue
        light = solid.surface.lights[number]
        at = np.flatnonzero(met.solid == n)
        if len(at) == 0 or not (light.diffuse.any() or light.specular.any()):
            continue
        place = met.position[at], met.normal[at], met.to_eye[at]
        added = contribution(light, solid.surface, scene.view, scene.settings, *place)
        seen = np.ones((len(at), 1), dtype=bool)
        if light.corners is None:
            above = dot(met.normal[at], added.to_light) > 0.0
            seen = (above & (dot(met.side[at], added.to_light) > 0.0))[:, None]
        diffuse[at] = np.where(seen, added.diffuse, 0.0) * met.texel[at]
        specular[at] = np.where(seen, added.specular, 0.0)
        to_light[at] = added.to_light
    return diffuse, specular, to_light


def shadow(
    scene: TracedScene, number: int, light: SurfaceLight, met: Meetings, to_light: Array
) -> Array:
    """The share of a light without extent that reaches each point, (N, 3)."""
    start = offset_ray(met.position, met.side, met.error)
    direction, limit = to_light, np.full(len(start), np.inf)
    if light.position is not None:
        direction, distance = toward(start, scene.view.relative(light.position))
        limit = distance * BEFORE
    return arriving(scene.solids, start, direction, limit, None, scene.settings.clear_shadows)


def soft_shadow(
    scene: TracedScene, number: int, light: SurfaceLight, met: Meetings
) -> tuple[Array, Array]:
    """The shares of the diffuse and the specular term of an area light that arrive, (N, 3) each."""
    assert light.corners is not None
    corners = scene.view.corners(light.corners)
    facing, settings = facing_of(corners), scene.settings
    formula = blinn_factor if settings.highlight == "blinn" else specular_factor
    shininess = np.array([solid.surface.shininess for solid in scene.solids])[met.solid]
    start = offset_ray(met.position, met.side, met.error)
    count = len(start)
    seen_d, seen_s = np.zeros((count, 3)), np.zeros((count, 3))
    whole_d, whole_s = np.zeros((count, 1)), np.zeros((count, 1))
    for point in points_on(corners, settings.light_samples):
        direction, distance = toward(start, point)
        angle = lamp_weight(direction, distance, facing, light.two_sided)
        cosine = dot(met.normal, direction)
        weight_d = (angle * np.maximum(cosine, 0.0))[:, None]
        weight_s = (angle * formula(met.normal, direction, met.to_eye, shininess))[:, None]
        if settings.gate:
            weight_s = np.where(cosine[:, None] > 0.0, weight_s, 0.0)
        whole_d, whole_s = whole_d + weight_d, whole_s + weight_s

        # No shadow ray where this piece of the light is behind the surface.
        open_ = np.flatnonzero((cosine > 0.0) & (angle > 0.0) & (dot(met.side, direction) > 0.0))
        rays = start[open_], direction[open_], distance[open_] * BEFORE
        share = arriving(scene.solids, *rays, number, settings.clear_shadows)
        seen_d[open_] += share * weight_d[open_]
        seen_s[open_] += share * weight_s[open_]
    return visible_share(seen_d, whole_d), visible_share(seen_s, whole_s)
