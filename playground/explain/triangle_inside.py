"""The whole triangle that a pixel sees: shaded at every point, or mixed from its vertices."""

from __future__ import annotations

import numpy as np

from playground.explain.pixel import Explanation
from playground.render.numpy_renderer import eye_normals, eye_positions
from playground.render.shade import shade
from playground.render.surface import surfaces
from playground.render.view import view_of
from playground.shading.texture import bilinear
from playground.shading.vector import Array, turned_to_eye, unit


def mixed_inside(why: Explanation, mix: Array) -> Array:
    """What the rasteriser makes of the colours at the vertices, at points of the triangle.

    ``mix`` (..., 3) are the weights of the vertices, the result linear colours (..., 3); of flat
    shading one colour everywhere. The texture is that of the pixel.
    """
    colours = np.array([corner.colour for corner in why.corners])
    return np.asarray(
        mix @ colours if len(colours) == 3 else np.broadcast_to(colours[0], mix.shape)
    )


def shaded_inside(why: Explanation, mix: Array) -> Array:
    """The model evaluated at these points themselves, as per-fragment shading does; (..., 3).

    Raises
    ------
    ValueError
        The pixel sees no object.
    """
    if why.object is None or why.triangle is None:
        raise ValueError("the pixel sees no triangle of an object")
    setup = why.setup
    everything = surfaces(setup.scene, setup.settings.weights)
    surface, view = everything[why.object], view_of(setup.camera, everything, why.size)
    mesh = surface.mesh
    corners = mesh.faces[why.triangle]
    position = eye_positions(surface, view, mix @ mesh.positions[corners])
    normal = unit(mix @ eye_normals(surface, mesh.normals[corners]))
    if not why.front:
        normal = turned_to_eye(normal, -position)
    diffuse, rest = shade(surface, view, setup.settings, position, normal)
    if surface.texels is not None and mesh.texcoords is not None:
        diffuse = diffuse * bilinear(surface.texels, mix @ mesh.texcoords[corners])
    return np.asarray(diffuse + rest)
