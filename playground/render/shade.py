"""The Phong model at many points of one surface: the twin of shaders/shade.glsl.

The formulas themselves are in `playground.shading`; here they meet the lights. Everything is
computed in the type of the positions, to which colours and lights are rounded first.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from playground.render.precision import farthest, to_type
from playground.render.surface import Surface, SurfaceLight
from playground.render.view import View
from playground.scene.settings import Settings
from playground.shading.area_light import (
    form_factor,
    lobe_integral,
    lobe_integral_above,
)
from playground.shading.light import BRIGHTEST, attenuation, spot_cone, toward
from playground.shading.phong import (
    blinn_factor,
    diffuse_factor,
    diffuse_term,
    gate,
    specular_factor,
    specular_term,
)
from playground.shading.polygon import stretch_factor, stretched
from playground.shading.vector import Array, reflection, unit

KINDS = ("directional", "point", "spot", "area")  # in the order of shaders/shade.glsl


class Contribution(NamedTuple):
    """What one light adds at points of shape (...): factors (...) and colours (..., 3).

    ``to_light`` (..., 3) is the unit vector l, ``strength`` (...) what distance and
    spot cone leave of the light. For an area light l points to its middle, and the factors are
    the form factor F and the lobe's integral over π. ``diffuse`` and ``specular`` are weighted
    terms.
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
    to_eye: Array | None = None,
) -> Contribution:
    """What ``light`` adds where ``surface`` has these eye-relative positions and unit normals.

    ``to_eye`` (..., 3) is where the light goes if not to the eye: back along a traced ray.
    """
    light = _in_type(light, position.dtype)
    if to_eye is None:
        to_eye = unit(-position)
    if light.corners is not None:
        return _area_contribution(light, surface, view, settings, position, normal, to_eye)
    to_light, strength = _arriving(light, view, position)
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


def _area_contribution(
    light: SurfaceLight,
    surface: Surface,
    view: View,
    settings: Settings,
    position: Array,
    normal: Array,
    to_eye: Array,
) -> Contribution:
    """`contribution` of an area light; its factors are computed in float64, then rounded."""
    assert light.corners is not None
    dtype = position.dtype
    corners, two_sided = view.corners(light.corners), light.two_sided
    lambert = to_type(form_factor(position, normal, corners, two_sided), dtype)
    highlight = np.zeros_like(lambert)
    if light.specular.any():
        highlight = to_type(
            _area_highlight(surface, settings, position, normal, to_eye, corners, two_sided), dtype
        )
    to_light = np.broadcast_to(unit(np.mean(corners, axis=0) - position), position.shape)
    return Contribution(
        to_type(to_light, dtype),
        np.ones_like(lambert),
        lambert,
        highlight,
        diffuse_term(lambert, light.diffuse),
        specular_term(highlight, light.specular),
    )


def _area_highlight(
    surface: Surface,
    settings: Settings,
    position: Array,
    normal: Array,
    to_eye: Array,
    corners: Array,
    two_sided: bool,
) -> Array:
    """1/π ∫ max(r·ω, 0)^sh dω over an area light, r the view vector mirrored about the normal."""
    axis = reflection(normal, to_eye)
    exponent, factor = surface.shininess, np.array(1.0 / np.pi)
    if settings.highlight == "blinn":
        offset = corners - np.asarray(position, np.float64)[..., None, :]
        widened = stretched(offset, normal[..., None, :], axis[..., None, :])
        corners = position[..., None, :] + widened
        exponent, factor = exponent / 4.0, factor * stretch_factor(normal, axis)
    if settings.gate:
        return factor * lobe_integral_above(position, normal, axis, corners, exponent, two_sided)
    return factor * lobe_integral(position, axis, corners, exponent, two_sided)


def shade(
    surface: Surface, view: View, settings: Settings, position: Array, normal: Array
) -> tuple[Array, Array]:
    """The diffuse term, which a texture would filter, and the rest of the sum; (..., 3) each."""
    diffuse = np.zeros_like(position)
    rest = np.empty_like(position)
    rest[...] = to_type(surface.constant_terms, position.dtype)
    for light in _in_order(surface.lights, position.dtype):
        if light.diffuse.any() or light.specular.any():
            added = contribution(light, surface, view, settings, position, normal)
            diffuse += added.diffuse
            rest += added.specular
    return diffuse, rest


def _arriving(light: SurfaceLight, view: View, position: Array) -> tuple[Array, Array]:
    """The unit vector to the light and the share of it that arrives, (..., 3) and (...)."""
    if light.to_light is not None:
        return np.broadcast_to(light.to_light, position.shape), np.ones_like(position[..., 0])
    place, fading = _place(light, view, position.dtype)
    return from_lamp(light, position, place, fading)


def from_lamp(
    light: SurfaceLight, position: Array, place: Array, fading: tuple[float, float, float]
) -> tuple[Array, Array]:
    """The unit vector to a point or spot light at ``place`` (3,), and the share that arrives.

    ``fading`` is (k_c, k_l, k_q) for distances in the units of the positions (..., 3).
    """
    to_light, distance = toward(position, place)
    strength = np.ones_like(distance)
    if light.attenuates:
        brightest = min(BRIGHTEST, float(np.finfo(position.dtype).max))
        strength = np.minimum(attenuation(distance, *fading), brightest)
    if light.axis is not None:
        strength = strength * spot_cone(light.axis, -to_light, *light.edge_width)
    return to_light, strength


def _place(
    light: SurfaceLight, view: View, dtype: np.dtype[Any]
) -> tuple[Array, tuple[float, float, float]]:
    """Where a light stands relative to the eye, (3,), and its attenuation for distances there."""
    assert light.position is not None
    if dtype == np.float64:
        return view.relative(light.position), view.attenuation(light.attenuation)
    place, fading = view.light_place(light.position, light.attenuation, farthest(dtype))
    return to_type(place, dtype), fading


def _in_order(lights: tuple[SurfaceLight, ...], dtype: np.dtype[Any]) -> list[SurfaceLight]:
    """The order in which the shader adds lights up, kind by kind: with few digits it shows."""
    if dtype == np.float64:
        return list(lights)
    return sorted(lights, key=lambda light: KINDS.index(light.kind))


def _in_type(light: SurfaceLight, dtype: np.dtype[Any]) -> SurfaceLight:
    """The light with colours and directions rounded to a type, its place left in the world."""
    if dtype == np.float64:
        return light
    rounded: dict[str, Any] = {
        name: to_type(value, dtype)
        for name in ("diffuse", "specular", "to_light", "axis")
        if (value := getattr(light, name)) is not None
    }
    return replace(light, **rounded)
