"""The shadow rays from the points that one pixel's rays met, one by one, with what stops them.

The tracer asks only how much light arrives (`playground.render.trace.direct`); here the same rays
are shot again, and what they met is written down.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from playground.explain.ray_tree import ARRIVING, BLOCKED, LightThere, ShadowRay
from playground.render.surface import SurfaceLight
from playground.render.trace.direct import BEFORE, light_of, shadow, soft_shadow, unshadowed
from playground.render.trace.hits import arriving, closest
from playground.render.trace.lamp import facing_of, points_on
from playground.render.trace.meetings import Meetings
from playground.render.trace.solids import Solid
from playground.render.trace.traced_scene import TracedScene
from playground.shading.floats import Array
from playground.shading.light import toward
from playground.shading.ray import offset_ray
from playground.shading.shadow import lamp_weight
from playground.shading.vector import dot


def lights_there(scene: TracedScene, met: Meetings) -> tuple[LightThere, ...]:
    """What each light of the scene adds at one point, ``met`` of length 1."""
    found = []
    for number, light in enumerate(scene.setup.scene.lights):
        diffuse, specular, to_light = unshadowed(scene, number, met)
        shares = np.ones((1, 3)), np.ones((1, 3))
        rays: tuple[ShadowRay, ...] = ()
        if diffuse.any() or specular.any():
            prepared = light_of(scene, number)
            if prepared.corners is None:
                arrives = shadow(scene, number, prepared, met, to_light)
                shares = arrives, arrives
            else:
                shares = soft_shadow(scene, number, prepared, met)
            rays = _rays(scene, number, prepared, met, to_light)
        terms = diffuse[0], specular[0], shares[0][0], shares[1][0]
        found.append(LightThere(number, light.kind, *terms, rays))
    return tuple(found)


def _rays(
    scene: TracedScene, number: int, light: SurfaceLight, met: Meetings, to_light: Array
) -> tuple[ShadowRay, ...]:
    start = offset_ray(met.position, met.side, met.error)
    if light.corners is None:
        if light.position is None:
            far = np.array([scene.view.far * scene.view.scale])
            return (_ray(scene, None, start, to_light, np.array([np.inf]), far),)
        direction, distance = toward(start, scene.view.relative(light.position))
        return (_ray(scene, None, start, direction, distance * BEFORE, distance),)

    # Of an area light only the points that the surface faces are asked, as the tracer does.
    corners, rays = scene.view.corners(light.corners), []
    for point in points_on(corners, scene.settings.light_samples):
        direction, distance = toward(start, point)
        angle = lamp_weight(direction, distance, facing_of(corners), light.two_sided)
        faces = (dot(met.normal, direction) > 0.0) & (dot(met.side, direction) > 0.0)
        if faces[0] and angle[0] > 0.0:
            rays.append(_ray(scene, number, start, direction, distance * BEFORE, distance))
    return tuple(rays)


def _ray(
    scene: TracedScene,
    lamp: int | None,
    start: Array,
    direction: Array,
    limit: Array,
    distance: Array,
) -> ShadowRay:
    """One shadow ray, every array of length 1; ``distance`` is how long it is to be drawn."""
    others = [s for s in scene.solids if lamp is None or s.surface.emitter != lamp]
    clear = scene.settings.clear_shadows
    share = arriving(others, start, direction, limit, None, clear)[0]
    glass = [s for s in others if clear and s.transmissive]
    stopper, t = _first([s for s in others if s not in glass], start, direction, limit)
    if stopper is None and not share.any() and glass:  # glass that lets nothing through
        stopper, t = _first(glass, start, direction, limit)
    end = start + (distance if stopper is None else t)[:, None] * direction
    until = limit if stopper is None else t
    crossed = [s for s in glass if s is not stopper and _first([s], start, direction, until)[0]]
    return ShadowRay(
        kind=ARRIVING if stopper is None else BLOCKED,
        start=scene.view.world(start[0]),
        end=scene.view.world(end[0]),
        share=share,
        blocker=None if stopper is None else stopper.object,
        through=tuple(s.object for s in crossed if s.object is not None),
    )


def _first(
    solids: Sequence[Solid], start: Array, direction: Array, limit: Array
) -> tuple[Solid | None, Array]:
    """What one ray meets first, and where (t)."""
    hit = closest(solids, start, direction, limit)
    number = int(hit.solid[0])
    return (solids[number] if number >= 0 else None), hit.t
