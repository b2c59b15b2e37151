"""Uniforms: what changes when a light, a material, a slider or the camera moves."""

from __future__ import annotations

import numpy as np

from playground.render.gl.program import Program
from playground.render.surface import Surface
from playground.render.view import View
from playground.scene.settings import Settings


def write_place(program: Program, surface: Surface, view: View) -> None:
    """Where the surface stands: ``interface/transform.glsl``."""
    eye_from_object = view.eye_from_object(surface)
    clip_from_object = view.clip_from_eye @ eye_from_object
    clip_from_object[1] *= -1.0  # drawn upside down: row 0 of the target is the top row
    program.write("clip_from_object", clip_from_object)
    program.write("eye_from_object", eye_from_object[:3])
    program.write("normal_from_object", surface.normal_from_object)


def write_surface(program: Program, surface: Surface, view: View, settings: Settings) -> None:
    """Material and lights: ``interface/surface.glsl`` and ``interface/display.glsl``."""
    program.write("constant_terms", surface.constant_terms)
    program.write("shininess", surface.shininess)
    program.write("exposure", settings.exposure)
    for kind in {light.kind for light in surface.lights}:
        lights = [light for light in surface.lights if light.kind == kind]
        program.write(f"{kind}_diffuse", [light.diffuse for light in lights])
        program.write(f"{kind}_specular", [light.specular for light in lights])
        if kind == "directional":
            program.write(f"{kind}_to_light", [light.to_light for light in lights])
            continue
        positions = np.array([light.position for light in lights])
        program.write(f"{kind}_position", view.relative(positions))
        program.write(f"{kind}_attenuation", [view.attenuation(x.attenuation) for x in lights])
        if kind == "spot":
            program.write("spot_axis", [light.axis for light in lights])
            program.write("spot_edge_width", [light.edge_width for light in lights])
