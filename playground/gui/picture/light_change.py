"""Changing the lights of a scene: another type, one more, one less. Pure functions."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from playground.scene.knob import knobs
from playground.scene.light import (
    LIGHTS,
    AreaLight,
    DirectionalLight,
    Light,
    PointLight,
    PolygonLight,
    RectangleLight,
    SpotLight,
)
from playground.scene.setup import Setup

WIDE, TALL = 1.0, 0.7  # radii of the scene: a new rectangle
AWAY = 2.5  # radii of the scene: how far a new lamp stands from its centre
Triple = tuple[float, float, float]


def converted(light: Light, kind: str, setup: Setup) -> Light:
    """``light`` as another type: it keeps its colours and shines from the same side."""
    if kind == light.kind:
        return light
    declared = LIGHTS[kind]
    common = {n: getattr(light, n) for n in knobs(declared) if hasattr(light, n)}
    centre, radius = setup.bounds()
    towards = _towards(light, centre)
    made: dict[str, Any] = {}
    if declared is DirectionalLight:
        made["to_light"] = _triple(towards)
    elif declared is PolygonLight:
        rectangle = light if isinstance(light, AreaLight) else converted(light, "rectangle", setup)
        assert isinstance(rectangle, AreaLight)
        made["vertices"] = rectangle.corners
    elif isinstance(light, AreaLight):
        made["position"] = light.centre
    elif "position" not in common:
        made["position"] = _triple(centre + AWAY * radius * towards)
    if declared is RectangleLight:
        made |= {"facing": _triple(-towards), "width": WIDE * radius, "height": TALL * radius}
    if declared is SpotLight:
        made["axis"] = _triple(-towards)
    return declared(**{**common, **made})


def added(setup: Setup) -> Setup:
    """``setup`` with one more light: a point light above the viewer's right shoulder."""
    centre, radius = setup.bounds()
    side = np.subtract(setup.camera.eye, centre)
    side = side / (np.linalg.norm(side) or 1.0) + np.array([0.8, 0.8, 0.0])
    place = centre + AWAY * radius * side / np.linalg.norm(side)
    light = PointLight(
        position=_triple(place),
        diffuse=(0.6, 0.6, 0.6),
        specular=(0.6, 0.6, 0.6),
        ambient=(0.0, 0.0, 0.0),
    )
    return setup.with_(lights=(*setup.scene.lights, light))


def removed(setup: Setup, index: int) -> Setup:
    """``setup`` without one of its lights."""
    lights = setup.scene.lights
    return setup.with_(lights=lights[:index] + lights[index + 1 :])


def exchanged(setup: Setup, index: int, light: Light) -> Setup:
    """``setup`` with another light in the place of one."""
    lights = list(setup.scene.lights)
    lights[index] = light
    return replace(setup, scene=replace(setup.scene, lights=tuple(lights)))


def _towards(light: Light, centre: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
    """Unit vector from the scene towards the light."""
    if isinstance(light, DirectionalLight):
        direction = np.asarray(light.to_light, dtype=np.float64)
    else:
        assert isinstance(light, (PointLight, AreaLight))
        place = light.centre if isinstance(light, AreaLight) else light.position
        direction = np.subtract(place, centre)
    norm = float(np.linalg.norm(direction))
    return direction / norm if norm else np.array([0.0, 1.0, 0.0])


def _triple(values: Any) -> Triple:
    x, y, z = (round(float(v), 4) for v in values)
    return x, y, z
