"""The whole triangle that a pixel sees: shaded at every point, or mixed from its vertices."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from playground.explain.pixel import Explanation, evaluated_at, texel_at
from playground.render.shade import shade
from playground.render.surface import Surface, surfaces
from playground.render.view import View, view_of
from playground.scene.settings import Shading
from playground.shading.vector import Array, turned_to_eye


def mixed_inside(why: Explanation, mix: Array) -> Array:
    """What the rasteriser makes of the colours at the vertices, at points of the triangle.

    ``mix`` (..., 3) are the weights of the vertices at the points, the result are linear colours
    (..., 3). Flat shading has the colour of the centre everywhere.

    Raises
    ------
    ValueError
        The pixel sees no object.
    """
    surface, view, triangle = _seen(why)
    settings = why.setup.settings
    positions, normals, _ = evaluated_at(surface, view, settings, triangle, why.weights)
    diffuse, rest = _shaded(why, surface, view, positions, normals)
    share = mix if len(positions) == 3 else np.ones((*mix.shape[:-1], 1))
    return np.asarray(share @ diffuse * texel_at(surface, triangle, mix) + share @ rest)


def shaded_inside(why: Explanation, mix: Array) -> Array:
    """The model evaluated at these points themselves, as per-fragment shading does; (..., 3).

    Raises
    ------
    ValueError
        The pixel sees no object.
    """
    surface, view, triangle = _seen(why)
    everywhere = replace(why.setup.settings, shading=Shading.PER_FRAGMENT)
    position, normal, _ = evaluated_at(surface, view, everywhere, triangle, mix)
    diffuse, rest = _shaded(why, surface, view, position[0], normal[0])
    return np.asarray(diffuse * texel_at(surface, triangle, mix) + rest)


def _seen(why: Explanation) -> tuple[Surface, View, int]:
    if why.object is None or why.triangle is None:
        raise ValueError("the pixel sees no triangle of an object")
    everything = surfaces(why.setup.scene, why.setup.settings.weights)
    return everything[why.object], view_of(why.setup.camera, everything, why.size), why.triangle


def _shaded(
    why: Explanation, surface: Surface, view: View, position: Array, normal: Array
) -> tuple[Array, Array]:
    """The diffuse term and the rest of the sum, on the side that the pixel sees."""
    if not why.front:
        normal = turned_to_eye(normal, -position)
    return shade(surface, view, why.setup.settings, position, normal)
