"""A setup made ready for tracing: its solids, its media, its lights, seen from its camera."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from playground.render.raster.coverage import SUBPIXELS, sample_position
from playground.render.surface import Surface, surfaces
from playground.render.trace import analytic, walk
from playground.render.trace.bvh import build, bvh_of
from playground.render.trace.hits import closest
from playground.render.trace.lamp import parallelogram
from playground.render.trace.media import Media
from playground.render.trace.solids import Solid, Walker
from playground.render.view import View, view_of
from playground.scene.light import AreaLight, Light
from playground.scene.material import Material
from playground.scene.scene import Object
from playground.scene.settings import Settings
from playground.scene.setup import Setup
from playground.shading.floats import Array
from playground.shading.vector import normal_matrix, unit

FLAT = 1e-12  # thinner than this beside its length, a matrix has no inverse to speak of
NO_MATERIAL = Material()


@dataclass(frozen=True, eq=False)
class TracedScene:
    """What rays are traced through; everything relative to the eye."""

    setup: Setup
    size: tuple[int, int]
    view: View
    solids: tuple[Solid, ...]
    media: Media

    @property
    def settings(self) -> Settings:
        """The settings of the setup."""
        return self.setup.settings

    @cached_property
    def around_eye(self) -> NDArray[np.bool_]:
        """Which media the eye itself is in, (M,)."""
        here = self.holding(np.zeros(3))
        return np.array([n in here for n in self.media.solids], dtype=bool)

    def holding(self, point: Array) -> list[int]:
        """The closed solids around a point (3,): a ray from there first meets their back."""
        origin, direction = point[None], unit(np.array([[0.36, 0.48, 0.8]]))
        found = []
        for number, solid in enumerate(self.solids):
            if not solid.closed:
                continue
            hit = closest((solid,), origin, direction, np.array([np.inf]))
            if hit.solid[0] == 0:
                at = solid.points(origin, direction, hit.t, hit.triangle, hit.weights)
                if float(at.outward[0] @ direction[0]) > 0.0:
                    found.append(number)
        return found

    def camera_rays(
        self, pixels: NDArray[np.intp], offset: tuple[float, float]
    ) -> tuple[Array, Array, Array]:
        """Origin, unit direction (N, 3) and limit (N,) of the rays through pixels, row by row.

        They pass through the very points that the rasteriser samples. A near and a far plane
        that the camera names itself cut off what lies beyond them; fitted ones do not.
        """
        x, y = sample_position(offset) / SUBPIXELS
        return self.rays_through(pixels % self.size[0] + x, pixels // self.size[0] + y)

    def rays_through(self, x: Array, y: Array) -> tuple[Array, Array, Array]:
        """The same through points (N,) of the picture, in pixels from its upper left corner."""
        width, height = self.size
        across = 2.0 * x / width - 1.0
        up = 1.0 - 2.0 * y / height
        half = self.view.pixel(height) * height / 2.0
        seen = np.stack([across * half * width / height, up * half, -np.ones(len(x))], axis=1)
        towards = seen @ self.view.camera_from_world
        length = np.sqrt(np.einsum("ni,ni->n", towards, towards))
        camera, scale = self.setup.camera, self.view.scale
        origin = towards * (camera.near * scale)
        limit = np.full(len(x), np.inf)
        if camera.far:
            limit = (camera.far - camera.near) * scale * length
        return origin, towards / length[:, None], limit


def prepare(setup: Setup, size: tuple[int, int], walker: Walker = walk) -> TracedScene:
    """The scene of ``setup`` for pictures of ``size`` (width, height) in pixels.

    ``walker`` finds what rays meet in meshes.
    """
    everything = surfaces(setup.scene, setup.settings.weights)
    view = view_of(setup.camera, everything, size)
    count = len(setup.scene.objects)
    solids = []
    for number, (item, surface) in enumerate(zip(setup.scene.objects, everything, strict=False)):
        if np.any(surface.linear):  # shrunk to nothing, there is nothing to meet
            kind = _kind(item) if setup.settings.surfaces == "analytic" else "mesh"
            glow = surface.constant_terms, surface.constant_terms
            solids.append(_placed(surface, kind, view, glow, number, item.material))
    sides = everything[count:]
    for front, back in zip(sides[::2], sides[1::2], strict=True):
        glow = front.constant_terms, back.constant_terms
        solids.append(_placed(*_lamp(front, setup.scene.lights), view, glow))
    solids = [replace(solid, walker=walker) for solid in solids]
    return TracedScene(setup, size, view, tuple(solids), Media(solids))


def _kind(item: Object) -> str:
    own = item.arrays is None and item.normals == "exact"
    return analytic.GENERATORS.get(item.mesh, "mesh") if own else "mesh"


def _placed(
    surface: Surface,
    kind: str,
    view: View,
    glow: tuple[Array, Array],
    number: int | None = None,
    material: Material = NO_MATERIAL,
) -> Solid:
    """A surface where it stands; one that is flattened is taken as a mesh."""
    matrix = surface.linear * view.scale
    stretch = np.linalg.svd(matrix, compute_uv=False)
    flat = bool(stretch[2] <= FLAT * stretch[0])
    kind = "mesh" if flat else kind
    inverse = np.eye(3) if flat else np.linalg.inv(matrix)
    there = np.abs(matrix)
    middle = view.relative(surface.origin)
    if kind == "mesh":
        mesh = surface.mesh
        ball = view.relative(surface.ball[0]), surface.ball[1] * view.scale
        bvh = build(mesh.positions @ matrix.T, mesh.faces) if flat else bvh_of(mesh)
        closed = mesh.closed and not flat
    else:
        ball, bvh = (middle, analytic.REACH[kind] * float(stretch[0])), None
        closed = kind in analytic.SOLID
    return Solid(
        kind=kind,
        surface=surface,
        object=number,
        matrix=matrix,
        inverse=inverse,
        spread=there if flat else there @ np.abs(inverse) @ there,
        centre=middle,
        ball=ball,
        glow=glow,
        material=material,
        absorption=np.array(material.absorption) / view.scale,
        closed=closed,
        bvh=bvh,
    )


def _lamp(front: Surface, lights: tuple[Light, ...]) -> tuple[Surface, str]:
    """The face of an area light and its kind: a parallelogram is the square, stretched."""
    light = lights[front.emitter or 0]
    assert isinstance(light, AreaLight)
    corners = np.array(light.corners) - light.corners[0]
    if not parallelogram(corners):
        return front, "mesh"
    across, along = corners[1] / 2.0, corners[3] / 2.0
    # The square faces +y; its z axis is opposite to the height of its texture.
    up = np.cross(across, along)
    linear = np.stack([across, up / np.linalg.norm(up) ** 0.5, -along], axis=1)
    origin = front.origin + corners[2] / 2.0
    normals = normal_matrix(linear)
    return replace(front, linear=linear, origin=origin, normal_from_object=normals), "quad"
