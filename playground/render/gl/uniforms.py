"""Uniforms, sorted by what changes them: the camera, or the scene and its sliders."""

from __future__ import annotations

from typing import Any

import numpy as np

from playground.render.gl.light_uniforms import standing_values, turned_values
from playground.render.precision import farthest, to_type
from playground.render.surface import Surface
from playground.render.view import View
from playground.scene.settings import Settings

# What stays exact in any precision: where points land, and the display.
NO_SHADING = {
    "clip_from_object",
    "eye_from_object",
    "normal_from_object",
    "camera_from_world",
    "world_unit",
    "exposure",
    "area_corner",
}


def view_uniforms(surface: Surface, view: View, precision: str = "native") -> dict[str, Any]:
    """What moves with the camera: ``interface/transform.glsl``, and where lights stand."""
    eye_from_object = view.eye_from_object(surface)
    clip_from_object = view.clip_from_eye @ eye_from_object
    clip_from_object[1] *= -1.0  # drawn upside down: row 0 of the target is the top row
    values: dict[str, Any] = {
        "clip_from_object": clip_from_object,
        "eye_from_object": eye_from_object[:3],
        "normal_from_object": surface.normal_from_object,
        "camera_from_world": view.camera_from_world,  # these two are for the bug zoo alone
        "world_unit": view.scale,
    }
    lit = any(light.diffuse.any() or light.specular.any() for light in surface.lights)
    met = surface.lights if lit else ()  # those of stored light have done their work
    limit = farthest(np.float16 if precision == "float16" else np.float32)
    values |= standing_values(met, view, limit)
    return _in_precision(values, precision)


def surface_uniforms(surface: Surface, settings: Settings) -> dict[str, Any]:
    """What a slider moves: ``interface/surface.glsl`` and ``interface/display.glsl``."""
    values: dict[str, Any] = {
        "constant_terms": surface.constant_terms,
        "shininess": surface.shininess,
        "exposure": settings.exposure,
    }
    if surface.stored is not None:
        values["stored_reflectance"] = surface.reflectance
    for kind in {light.kind for light in surface.lights}:
        lights = [light for light in surface.lights if light.kind == kind]
        values[f"{kind}_diffuse"] = np.array([light.diffuse for light in lights])
        values[f"{kind}_specular"] = np.array([light.specular for light in lights])
    values |= turned_values(surface.lights)
    return _in_precision(values, settings.precision)


def _in_precision(values: dict[str, Any], precision: str) -> dict[str, Any]:
    """Lights and colours rounded to float16 for it; the GPU does the rest by their types."""
    if precision != "float16":
        return values
    return {
        name: value if name in NO_SHADING else to_type(value, np.float16)
        for name, value in values.items()
    }
