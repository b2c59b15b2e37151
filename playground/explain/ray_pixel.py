"""Follow the rays behind one pixel and write down what each of them met.

The very waves of the ray tracer (`playground.render.trace.whitted`), for one primary ray
through the centre of the pixel, in float64.
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass, field
from math import asin, atan2, degrees
from pathlib import Path
from typing import Any

import numpy as np

from playground.explain.pixel import check_pixel
from playground.explain.ray_tree import (
    PRIMARY,
    REFLECTION,
    REFRACTION,
    TOTAL,
    RayNode,
    RayTree,
    added_up,
)
from playground.explain.shadow_rays import lights_there
from playground.render.checks import check_setup, check_size
from playground.render.trace import whitted
from playground.render.trace.meetings import Meetings
from playground.render.trace.traced_scene import TracedScene, prepare
from playground.render.trace.whitted import Wave, primary, waves
from playground.scene.setup import Setup
from playground.shading.display import code8, display_colour
from playground.shading.optics import cosine_transmitted, sine_between
from playground.shading.vector import Array, dot

CENTRE = (0.5, 0.5)  # of a pixel


def trace_pixel(
    setup: Setup, pixel: tuple[int, int], size: tuple[int, int] = (640, 480)
) -> RayTree:
    """The tree of rays behind ``pixel`` = (x, y), counted from the top left corner.

    For a picture of ``size``, one sample at the centre of the pixel.

    Raises
    ------
    PlaygroundError
        The pixel is outside the picture.
    """
    check_setup(setup)
    width, height = check_size(size)
    x, y = check_pixel(pixel, width, height)
    scene = prepare(setup, (width, height))
    number = np.array([y * width + x])
    origin, direction, limit = scene.camera_rays(number, CENTRE)
    rays = primary(scene, origin, direction, np.zeros(1, dtype=np.intp))
    found: list[_Found] = []
    rendered = np.zeros(3)
    for wave in waves(scene, rays, limit):
        found += _taken(scene, wave)
        rendered = rendered + wave.added.sum(axis=0)
    root = _Tree(found, any(np.any(solid.absorption) for solid in scene.solids)).root()
    colour = added_up(root.walk())
    s = setup.settings
    shown = display_colour(colour, s.exposure, s.clamp, s.curve)
    names = tuple(_name(setup, n) for n in range(len(setup.scene.objects)))
    place = (x, y), (width, height)
    return RayTree(setup, *place, root, colour, rendered, shown, code8(shown), names)


@dataclass(frozen=True, eq=False)
class _Found:
    """A ray as the tracer left it, before it has a place in the tree.

    ``number`` and ``parent`` are the tracer's own; ``values`` are fields of `RayNode`;
    ``sends`` (3,) is by what the boundary at its end weighs each kind of ray that goes on.
    """

    number: int
    parent: int
    kind: int
    weight: Array
    values: dict[str, Any]
    total: bool = False
    sends: dict[int, Array] = field(default_factory=dict)


def _taken(scene: TracedScene, wave: Wave) -> list[_Found]:
    """The rays of a wave, one by one."""
    row = {int(ray): k for k, ray in enumerate(wave.hit)}
    found = []
    for i in range(len(wave.t)):
        rays, world = wave.rays, scene.view.world
        values: dict[str, Any] = {
            "depth": wave.depth,
            "start": world(rays.origin[i]),
            "direction": rays.direction[i],
            "end": None,
            "local": np.array(scene.setup.scene.background),
            "unfollowed": wave.lost[i],
        }
        total, sends = False, {}
        if i in row:
            values |= _ending(scene, wave, row[i])
            total = values["fresnel"] is not None and values["refraction"] is None
            material = scene.solids[wave.met.solid[row[i]]].material
            through, share = np.array(material.transmittance), wave.fresnel[row[i]]
            sends[whitted.REFLECTION] = material.reflectance + through * share
            sends[whitted.REFRACTION] = through * (1.0 - share)
        ids = wave.first + i, int(rays.parent[i]), int(rays.kind[i])
        found.append(_Found(*ids, rays.weight[i], values, total, sends))
    return found


def _ending(scene: TracedScene, wave: Wave, k: int) -> dict[str, Any]:
    """Where hit number ``k`` of a wave is, its angles, its lights: fields of `RayNode`."""
    met = Meetings(*(column[k : k + 1] for column in wave.met))
    solid = scene.solids[met.solid[0]]
    values: dict[str, Any] = {
        "end": scene.view.world(met.position[0]),
        "normal": met.normal[0],
        "local": wave.local[k],
        "glow": solid.glow[0 if met.front[0] else 1],
    }
    if solid.object is None:
        light = solid.surface.emitter or 0
        kind = scene.setup.scene.lights[light].kind
        values |= {"light": light, "name": f"light {light} ({kind})"}
    else:
        values |= {"object": solid.object, "name": _name(scene.setup, solid.object)}
        values["lights"] = lights_there(scene, met)
    normal = wave.normal[k]
    index_i, index_t = float(wave.index_i[k]), float(wave.index_t[k])
    sine = float(sine_between(normal, met.to_eye[0]))
    values |= {
        "incidence": degrees(atan2(sine, float(dot(normal, met.to_eye[0])))),
        "refraction": None,
        "fresnel": None,
        "index_i": index_i,
        "index_t": index_t,
    }
    if solid.transmissive:
        cosine = float(cosine_transmitted(sine, index_i, index_t))
        bent = degrees(atan2(index_i / index_t * sine, cosine)) if cosine >= 0.0 else None
        edge = degrees(asin(index_t / index_i)) if index_t < index_i else None
        values |= {"refraction": bent, "critical": edge, "fresnel": float(wave.fresnel[k])}
    return values


def _name(setup: Setup, number: int) -> str:
    item = setup.scene.objects[number]
    return f"object {number} ({Path(item.mesh).name if item.arrays is None else item.arrays.name})"


class _Tree:
    """Puts the rays in their places; ``absorbing`` says that media weaken what goes through."""

    def __init__(self, found: list[_Found], absorbing: bool) -> None:
        self.children: dict[int, list[_Found]] = defaultdict(list)
        for ray in found:
            self.children[ray.parent].append(ray)
        self.absorbing = absorbing
        self.count = 0

    def root(self) -> RayNode:
        """The primary ray with all that it sent out."""
        (first,) = self.children[-1]
        faded = first.weight if self.absorbing else np.ones(3)
        return self._node(first, PRIMARY, np.ones(3), faded, np.ones(3))

    def _node(self, ray: _Found, kind: str, factor: Array, faded: Array, parent: Array) -> RayNode:
        number, self.count = self.count, self.count + 1
        weight = parent * factor * faded
        below = [
            self._node(child, *self._edge(ray, child), weight)
            for child in sorted(self.children[ray.number], key=lambda child: child.number)
        ]
        return RayNode(
            number=number,
            kind=kind,
            factor=factor,
            faded=faded,
            weight=weight,
            added=weight * ray.values["local"],
            children=tuple(below),
            **ray.values,
        )

    def _edge(self, ray: _Found, child: _Found) -> tuple[str, Array, Array]:
        """Kind, factor and fading of the way from a ray to one that it sent out."""
        factor = ray.sends[child.kind]
        kind = REFRACTION
        if child.kind == whitted.REFLECTION:
            kind = TOTAL if ray.total else REFLECTION
        sent = ray.weight * factor
        faded = np.ones(3)
        if self.absorbing:  # not told by the tracer: what arrived of what was sent
            faded = np.where(sent > 0.0, child.weight / np.where(sent > 0.0, sent, 1.0), 1.0)
        return kind, factor, faded
