"""`explain`: why one pixel has its colour.

Traces the pixel back: which triangle it sees, with which weights, which vectors meet
there, what each light adds to each term, the sum, and what the display makes of it.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import acos, degrees
from typing import Any

import numpy as np
from numpy.typing import NDArray

from playground.errors import PlaygroundError
from playground.explain.sight import sight
from playground.render.checks import check_setup, check_size
from playground.render.needs import needs
from playground.render.numpy_renderer import eye_normals, eye_positions
from playground.render.shade import Contribution, contribution
from playground.render.surface import Surface, surfaces
from playground.render.view import View, view_of
from playground.scene.light import AreaLight, Light
from playground.scene.settings import Settings, Shading
from playground.scene.setup import Setup
from playground.shading.display import code8, display_colour
from playground.shading.phong import ambient_term, component_filter, emissive_term
from playground.shading.texture import bilinear
from playground.shading.vector import Array, halfway, reflection, turned_to_eye, unit


@dataclass(frozen=True, eq=False)
class LightAtPoint:
    """What one light does at one point: vectors (3,), cosines, and its terms (3,), weighted.

    ``specular_cosine`` is what is raised to the shininess, r·v or n·h; ``gated`` says
    that the gate on n·l has put the highlight out. For an area light l points to its middle,
    ``diffuse_factor`` is the form factor F, and ``specular_factor`` the lobe's integral over π.
    """

    kind: str
    to_light: Array
    reflection: Array
    halfway: Array
    n_dot_l: float
    r_dot_v: float
    rho: float  # degrees between r and v
    strength: float
    diffuse_factor: float
    specular_cosine: float
    specular_factor: float
    gated: bool
    light_diffuse: Array
    light_specular: Array
    light_ambient: Array
    diffuse: Array
    specular: Array
    ambient: Array
    area: bool = False


@dataclass(frozen=True, eq=False)
class ShadedPoint:
    """The Phong model at one point: where, which vectors, the terms per light, their sum."""

    position: Array  # world
    normal: Array
    to_eye: Array
    lights: tuple[LightAtPoint, ...]
    material_diffuse: Array  # m_d, filtered by the texture
    emissive: Array
    colour: Array


@dataclass(frozen=True, eq=False)
class Explanation:
    """The result of `explain`; `text`, `latex` and `to_dict` tell it in three ways.

    ``corners`` are the points at which the model was evaluated, and ``weights`` how
    they mix: one point with weight 1 for per-fragment and flat shading, the three
    vertices with their barycentric weights for per-vertex shading. ``light`` is the area light
    whose own face the pixel sees, in place of an object; ``front`` is which side it sees.
    """

    setup: Setup
    pixel: tuple[int, int]
    size: tuple[int, int]
    colour: Array
    shown: Array
    codes: NDArray[np.uint8]
    object: int | None = None
    triangle: int | None = None
    weights: Array = field(default_factory=lambda: np.ones(1))
    corners: tuple[ShadedPoint, ...] = ()
    shininess: float = 0.0
    needs: str = ""
    light: int | None = None
    front: bool = True

    def text(self) -> str:
        """The explanation for a terminal."""
        from playground.explain.words import text

        return text(self)

    def latex(self) -> str:
        """The equation with this pixel's numbers, as LaTeX."""
        from playground.explain.words import latex

        return latex(self)

    def to_dict(self) -> dict[str, Any]:
        """The explanation as plain values under the names of the vocabulary."""
        from playground.explain.words import to_dict

        return to_dict(self)

    def __str__(self) -> str:
        return self.text()


def explain(
    setup: Setup, pixel: tuple[int, int], size: tuple[int, int] = (640, 480)
) -> Explanation:
    """Why ``pixel`` = (x, y), counted from the top left corner, has its colour.

    Computed by the float64 reference for a picture of ``size``, one sample at the
    centre of the pixel.

    Raises
    ------
    PlaygroundError
        The pixel is outside the picture.
    """
    check_setup(setup)
    width, height = check_size(size)
    x, y = check_pixel(pixel, width, height)
    settings = setup.settings
    everything = surfaces(setup.scene, settings.weights)
    view = view_of(setup.camera, everything, (width, height))
    frame = sight(everything, view, setup.camera, (width, height))
    number = int(frame.object[y, x])
    if number < 0:
        return _explanation(setup, (x, y), (width, height), np.array(setup.scene.background))

    # Evaluate the model where the shading mode does: at the point, the centre, the vertices.
    surface, triangle = everything[number], int(frame.triangle[y, x])
    if surface.emitter is not None:
        emitted = surface.constant_terms
        return _explanation(setup, (x, y), (width, height), emitted, light=surface.emitter)
    weights = frame.weights[y, x]
    front = bool(frame.front[y, x]) != surface.mirrored
    positions, normals, mix = evaluated_at(surface, view, settings, triangle, weights)
    texel = texel_at(surface, triangle, weights)
    corners = tuple(
        _shaded_point(setup, number, surface, view, position, seen, texel)
        for position, normal in zip(positions, normals, strict=True)
        for seen in [normal if front else turned_to_eye(normal, -position)]
    )
    colour = np.einsum("c,cx->x", mix, [corner.colour for corner in corners])
    return _explanation(
        setup,
        (x, y),
        (width, height),
        colour,
        object=number,
        triangle=triangle,
        weights=mix,
        corners=corners,
        shininess=surface.shininess,
        needs=needs(surface, view, settings).describe(),
        front=front,
    )


def _explanation(
    setup: Setup, pixel: tuple[int, int], size: tuple[int, int], colour: Array, **more: Any
) -> Explanation:
    s = setup.settings
    shown = display_colour(colour, s.exposure, s.clamp, s.curve)
    return Explanation(setup, pixel, size, colour, shown, code8(shown), **more)


def evaluated_at(
    surface: Surface, view: View, settings: Settings, triangle: int, weights: Array
) -> tuple[Array, Array, Array]:
    """Where the shading mode evaluates the model for a point of a triangle, of ``weights`` (3,).

    Eye-relative positions (K, 3), unit normals (K, 3) and the weights (K,) that mix the results:
    three vertices, or one point. Per-fragment shading takes many points at once: weights (M, 3)
    make K one place of (M, 3).
    """
    mesh = surface.mesh
    corners = mesh.faces[triangle]
    if settings.shading == Shading.PER_VERTEX:
        positions, normals, mix = mesh.positions[corners], mesh.normals[corners], weights
    elif settings.shading == Shading.FLAT:
        positions = mesh.triangle_centres[triangle][None].astype(np.float32)
        normals = mesh.triangle_normals[triangle][None].astype(np.float32)
        mix = np.ones(1)
    else:
        turned = eye_normals(surface, mesh.normals[corners])
        normal = unit(weights @ turned)
        position = eye_positions(surface, view, weights @ mesh.positions[corners])
        return position[None], normal[None], np.ones(1)
    return eye_positions(surface, view, positions), eye_normals(surface, normals), mix


def texel_at(surface: Surface, triangle: int, weights: Array) -> Array:
    """What the texture multiplies the diffuse term by, at weights (..., 3) of a triangle."""
    mesh = surface.mesh
    if surface.texels is None or mesh.texcoords is None:
        return np.ones(3)
    return bilinear(surface.texels, weights @ mesh.texcoords[mesh.faces[triangle]])


def _shaded_point(
    setup: Setup,
    number: int,
    surface: Surface,
    view: View,
    position: Array,
    normal: Array,
    texel: Array,
) -> ShadedPoint:
    material = setup.scene.objects[number].material
    weights = setup.settings.weights
    lights = []
    for i, prepared in enumerate(surface.lights):
        added = contribution(prepared, surface, view, setup.settings, position, normal)
        light = setup.scene.lights[i]
        ambient = weights["ambient"] * ambient_term(light.ambient, material.ambient)
        lights.append(_light_at_point(setup, light, added, normal, unit(-position), texel, ambient))
    emissive = weights["emissive"] * emissive_term(material.emissive)
    terms = [x.diffuse + x.specular + x.ambient for x in lights]
    return ShadedPoint(
        position=view.world(position),
        normal=normal,
        to_eye=unit(-position),
        lights=tuple(lights),
        material_diffuse=component_filter(material.diffuse, texel),
        emissive=emissive,
        colour=np.sum([emissive, *terms], axis=0),
    )


def _light_at_point(
    setup: Setup,
    light: Light,
    added: Contribution,
    normal: Array,
    to_eye: Array,
    texel: Array,
    ambient: Array,
) -> LightAtPoint:
    mirrored, half = reflection(normal, added.to_light), halfway(added.to_light, to_eye)
    r_dot_v, n_dot_l = float(np.dot(mirrored, to_eye)), float(np.dot(normal, added.to_light))
    blinn = setup.settings.highlight == "blinn"
    return LightAtPoint(
        kind=light.kind,
        to_light=added.to_light,
        reflection=mirrored,
        halfway=half,
        n_dot_l=n_dot_l,
        r_dot_v=r_dot_v,
        rho=degrees(acos(min(max(r_dot_v, -1.0), 1.0))),
        strength=float(added.strength),
        diffuse_factor=float(added.diffuse_factor),
        specular_cosine=float(np.dot(normal, half)) if blinn else r_dot_v,
        specular_factor=float(added.specular_factor),
        gated=setup.settings.gate and n_dot_l <= 0.0 and not isinstance(light, AreaLight),
        light_diffuse=np.array(light.diffuse),
        light_specular=np.array(light.specular),
        light_ambient=np.array(light.ambient),
        diffuse=added.diffuse * texel,
        specular=added.specular,
        ambient=ambient,
        area=isinstance(light, AreaLight),
    )


def check_pixel(pixel: Any, width: int, height: int) -> tuple[int, int]:
    """The pixel as whole numbers, or an error if it is outside of the picture."""
    try:
        x, y = (int(v) for v in pixel)
        inside = (x, y) == tuple(pixel) and 0 <= x < width and 0 <= y < height
    except (TypeError, ValueError):
        inside = False
    if not inside:
        raise PlaygroundError(
            "there is no such pixel",
            got=pixel,
            allowed=f"x from 0 to {width - 1}, y from 0 to {height - 1}, from the top left corner",
        )
    return x, y
