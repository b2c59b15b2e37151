"""The reference renderer: NumPy in float64 unless asked otherwise, GL's rules, no GL.

The oracle against which the GPU's pictures are judged, and the fallback where there is
no driver. The three shadings are the same function called in three places: per triangle,
per vertex, per pixel.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

from playground.errors import PlaygroundError
from playground.render.checks import check_out, check_setup
from playground.render.image import Image
from playground.render.precision import arithmetic, number_type, to_type
from playground.render.raster.rasterize import Frame, rasterize
from playground.render.shade import shade
from playground.render.surface import Surface, surfaces
from playground.render.view import View, view_of
from playground.scene.settings import Settings, Shading
from playground.scene.setup import Setup
from playground.shading.phong import component_filter
from playground.shading.texture import bilinear
from playground.shading.vector import Array, turned_to_eye, unit

BLOCK = 2**16  # pixels shaded at a time: bounds the memory whatever the size of the picture


class NumpyRenderer:
    """Draws setups of one size, in float64 or the precision of the setup."""

    name = "numpy"

    def __init__(self, size: tuple[int, int]) -> None:
        self.size = size

    def render(self, setup: Setup, out: NDArray[Any] | None = None) -> Image | NDArray[Any]:
        """Draw ``setup``; see `playground.render.renderer.Renderer.render`."""
        check_setup(setup)
        if out is not None:
            check_out(out, self.size)
        if setup.settings.bugs:
            raise PlaygroundError(
                "the NumPy renderer is the reference and makes no mistakes",
                got=f"bugs = {', '.join(setup.settings.bugs)}",
                fix="Use --renderer gl, or --set bugs= for none.",
            )
        colour = np.zeros((self.size[1], self.size[0], 3))
        covered = np.zeros((self.size[1], self.size[0]))
        offsets = sample_offsets(setup.settings.samples)
        everything = self._surfaces_of(setup)
        for offset in offsets:
            sample, drawn = render_sample(
                setup, self.size, offset, everything, self._background_of(setup)
            )
            colour += sample / len(offsets)
            covered += drawn / len(offsets)
        image = Image(colour.astype(np.float32), covered.astype(np.float32), setup, self.name)
        return image if out is None else image.into(out)

    def _surfaces_of(self, setup: Setup) -> tuple[Surface, ...]:
        return surfaces(setup.scene, setup.settings.weights)

    def _background_of(self, setup: Setup) -> tuple[float, float, float]:
        return setup.scene.background

    def samples(self, setup: Setup) -> int:
        """As many samples per pixel as ``setup`` asks for."""
        return setup.settings.samples

    def close(self) -> None:
        """Nothing is held."""

    def __enter__(self) -> NumpyRenderer:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()


def sample_offsets(samples: int) -> list[tuple[float, float]]:
    """Where in the pixel the samples lie: points of the R2 sequence about its centre.

    The sequence runs both ways from the centre, so that the points mirror each other and their
    mean is the centre: more samples do not move the picture.
    Source: Roberts, The Unreasonable Effectiveness of Quasirandom Sequences, 2018.
    """
    step = np.array([0.7548776662466927, 0.5698402909980532])
    points = (0.5 + (np.arange(samples)[:, None] - (samples - 1) / 2.0) * step) % 1.0
    return [(float(x), float(y)) for x, y in points]


def render_sample(
    setup: Setup,
    size: tuple[int, int],
    offset: tuple[float, float] = (0.5, 0.5),
    everything: tuple[Surface, ...] | None = None,
    background: tuple[float, float, float] | None = None,
) -> tuple[Array, NDArray[np.bool_]]:
    """Linear colour (H, W, 3) and coverage (H, W) at one sample position per pixel.

    ``everything`` are the surfaces to draw and ``background`` is what is behind them, if not what
    follows from the setup.
    """
    if everything is None:
        everything = surfaces(setup.scene, setup.settings.weights)
    view = view_of(setup.camera, everything, size)
    frame = visibility(everything, view, size, offset)
    colour = np.empty((size[1], size[0], 3))
    colour[...] = setup.scene.background if background is None else background
    for number, surface in enumerate(everything):
        rows, columns = np.nonzero(frame.object == number)
        vertex_colours = colours_before(surface, view, setup.settings)
        for start in range(0, len(rows), BLOCK):
            at = rows[start : start + BLOCK], columns[start : start + BLOCK]
            colour[at] = pixel_colours(surface, view, setup.settings, frame, at, vertex_colours)
    return colour, frame.drawn


def visibility(
    everything: tuple[Surface, ...],
    view: View,
    size: tuple[int, int],
    offset: tuple[float, float] = (0.5, 0.5),
) -> Frame:
    """Which triangle of which surface each pixel sees, and with which weights."""
    frame = Frame.empty(size)
    for number, surface in enumerate(everything):
        clip = clip_positions(surface, view)
        cull = culled(surface, view)
        rasterize(clip, surface.mesh.faces, size, cull, frame, number, offset)
    return frame


def clip_positions(surface: Surface, view: View) -> Array:
    """The vertices of a surface in clip space, shape (N, 4)."""
    matrix = view.clip_from_eye @ view.eye_from_object(surface)
    return np.asarray(surface.mesh.positions @ matrix[:, :3].T + matrix[:, 3])


def culled(surface: Surface, view: View) -> Any:
    """The side that cannot be seen, as `rasterize` names it; mirroring turns windings around."""
    if view.two_sided(surface):
        return None
    return "front" if surface.mirrored else "back"


def eye_positions(surface: Surface, view: View, points: NDArray[Any]) -> Array:
    """Points of a mesh (..., 3) relative to the eye."""
    matrix = view.eye_from_object(surface)
    return np.asarray(points @ matrix[:3, :3].T + matrix[:3, 3])


def eye_normals(surface: Surface, normals: NDArray[Any], dtype: DTypeLike = np.float64) -> Array:
    """Normals of a mesh (..., 3) in the axes of the world, made unit length in ``dtype``."""
    return unit(to_type(normals @ surface.normal_from_object.T, dtype))


VertexColours = tuple[tuple[Array, Array], tuple[Array, Array]] | None


def colours_before(surface: Surface, view: View, settings: Settings) -> VertexColours:
    """What is shaded before rasterising: (diffuse, rest) of the front and of the back.

    Per vertex (N, 3), for flat shading per triangle (M, 3); None for per-fragment.
    """
    mesh = surface.mesh
    if settings.shading == Shading.PER_FRAGMENT:
        return None
    if settings.shading == Shading.PER_VERTEX:
        points, normals = mesh.positions, mesh.normals
    else:
        points = mesh.triangle_centres.astype(np.float32)
        normals = mesh.triangle_normals.astype(np.float32)
    dtype = number_type(settings)

    def shaded(normal: Array) -> tuple[Array, Array]:
        diffuse, rest = shade(surface, view, settings, position, normal)
        if dtype == np.float64 or surface.texels is not None:
            return diffuse, rest
        return np.zeros_like(rest), diffuse + rest  # rounded here, as by the vertex stage

    with arithmetic(dtype):
        position = to_type(eye_positions(surface, view, points), dtype)
        normal = eye_normals(surface, normals, dtype)
        front = shaded(normal)
        if not view.two_sided(surface):
            return front, front
        return front, shaded(turned_to_eye(normal, -position))


def pixel_colours(
    surface: Surface,
    view: View,
    settings: Settings,
    frame: Frame,
    at: tuple[NDArray[np.intp], NDArray[np.intp]],
    before: VertexColours,
) -> Array:
    """The colours of the pixels ``at`` (rows, columns), which see ``surface``; (K, 3)."""
    with arithmetic(number_type(settings)):
        return _pixel_colours(surface, view, settings, frame, at, before)


def _pixel_colours(
    surface: Surface,
    view: View,
    settings: Settings,
    frame: Frame,
    at: tuple[NDArray[np.intp], NDArray[np.intp]],
    before: VertexColours,
) -> Array:
    mesh, dtype = surface.mesh, number_type(settings)
    triangle, weights = frame.triangle[at], frame.weights[at]
    front = (frame.front[at] != surface.mirrored)[:, None]
    corners = mesh.faces[triangle]

    def interpolate(attribute: NDArray[Any]) -> Array:
        return np.asarray(np.einsum("kc,kcx->kx", weights, attribute[corners]))

    if before is None:
        position = to_type(eye_positions(surface, view, interpolate(mesh.positions)), dtype)
        normals = mesh.normals
        if surface.stretched:  # as the vertex stage does, so that all weigh the same
            normal = unit(to_type(interpolate(eye_normals(surface, normals)), dtype))
        else:
            normal = eye_normals(surface, interpolate(normals), dtype)
        normal = np.where(front, normal, turned_to_eye(normal, -position))
        diffuse, rest = shade(surface, view, settings, position, normal)
    else:
        faces = settings.shading == Shading.FLAT
        pick = (lambda a: a[triangle]) if faces else interpolate
        (diffuse_front, rest_front), (diffuse_back, rest_back) = before
        diffuse = to_type(np.where(front, pick(diffuse_front), pick(diffuse_back)), dtype)
        rest = to_type(np.where(front, pick(rest_front), pick(rest_back)), dtype)
    stored = surface.stored
    if stored is not None and surface.reflectance is not None:
        light = to_type(stored.at(interpolate), dtype)
        diffuse = component_filter(light, to_type(surface.reflectance, dtype))
    if surface.texels is not None and mesh.texcoords is not None:
        texel = bilinear(surface.texels, interpolate(mesh.texcoords))
        diffuse = diffuse * to_type(texel, dtype)
    colour = diffuse + rest
    return colour if stored is None else np.where(front, colour, 0.0)  # backs get nothing
