"""The Phong model at many points of one surface, in float64: the twin of shaders/shade.glsl.

The formulas themselves are in `playground.shading`; here they meet the lights.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from playground.render.surface import Surface, SurfaceLight
from playground.render.view import View
from playground.scene.settings import Settings
from playground.shading.light import BRIGHTEST, attenuation, spot_cone, toward
from playground.shading.phong import (
    blinn_factor,
    diffuse_factor,
    diffuse_term,
    gate,
    specular_factor,
    specular_term,
)
from playground.shading.vector import Array, unit


class Contribution(NamedTuple):
    """What one light adds at points of shape (...): factors (...) and colours (..., 3).

    ``to_light`` (..., 3) is the unit vector l, ``strength`` (...) what distance and
    spot cone leave of the light. ``diffuse`` and ``specular`` are weighted terms.
    """

    to_light: Array
    strength: Array
    diffuse_factor: Array
    specular_factor: Array
    diffuse: Array
    specular: Array


def contribution(
    light: SurfaceLight,
    surface: Surface,
    view: View,
    settings: Settings,
    position: Array,
    normal: Array,
) -> Contribution:
    """What ``light`` adds where ``surface`` has these eye-relative positions and unit normals."""
    to_light, strength = _arriving(light, view, position)
    to_eye = unit(-position)
    lambert = diffuse_factor(normal, to_light)
    highlight = np.zeros_like(lambert)
    if light.specular.any():
        formula = blinn_factor if settings.highlight == "blinn" else specular_factor
        highlight = formula(normal, to_light, to_eye, surface.shininess)
        if settings.gate:
            highlight = highlight * gate(normal, to_light)
    return Contribution(
        to_light,
        strength,
        lambert,
        highlight,
        diffuse_term(strength * lambert, light.diffuse),
        specular_term(strength * highlight, light.specular),
    )


def shade(
    surface: Surface, view: View, settings: Settings, position: Array, normal: Array
) -> tuple[Array, Array]:
    """The diffuse term, which a texture would filter, and the rest of the sum; (..., 3) each."""
    diffuse = np.zeros(position.shape)
    rest = np.broadcast_to(surface.constant_terms, position.shape).copy()
    for light in surface.lights:
        if light.diffuse.any() or light.specular.any():
            added = contribution(light, surface, view, settings, position, normal)
            diffuse += added.diffuse
            rest += added.specular
    return diffuse, rest


def _arriving(light: SurfaceLight, view: View, position: Array) -> tuple[Array, Array]:
    """The unit vector to the light and the share of it that arrives, (..., 3) and (...)."""
    if light.to_light is not None:
        return np.broadcast_to(light.to_light, position.shape), np.ones(position.shape[:-1])
    assert light.position is not None
    to_light, distance = toward(position, view.relative(light.position))
    strength = np.ones(position.shape[:-1])
    if light.attenuates:
        fading = attenuation(distance, *view.attenuation(light.attenuation))
        strength = np.minimum(fading, BRIGHTEST)
    if light.axis is not None:
        strength = strength * spot_cone(light.axis, -to_light, *light.edge_width)
    return to_light, strength
