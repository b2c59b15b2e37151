"""Where in the world a texel of a lightmap lies, and which texel lies under a ray."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from playground.render.lightmap.lightmap import Lightmap
from playground.render.lightmap.texels import placed
from playground.scene.scene import Scene
from playground.shading.floats import Array
from playground.shading.triangle import ray_triangle
from playground.shading.vector import cross, unit

NEAR = 3.0  # texels from a triangle at which a texel still belongs to it: dilation goes as far


@dataclass(frozen=True, eq=False)
class TexelPlace:
    """One texel: where in the atlas it is, and what of the world it stands for."""

    column: int
    row: int
    item: int  # number of the object
    position: Array  # (3,), world
    side: Array  # (3,), unit normal of the triangle, to the side of its winding


@dataclass(frozen=True, eq=False)
class TexelPlaces:
    """All triangles of a lightmap, in the world and in the atlas.

    ``corners`` (F, 3, 3) are world positions, ``flat`` (F, 3, 2) the same in texels, ``item`` (F,)
    numbers of objects, ``spacing`` the width of a texel in the world.
    """

    size: int
    corners: Array
    flat: Array
    item: NDArray[np.int64]
    spacing: float

    def of_texel(self, column: int, row: int) -> TexelPlace | None:
        """What a texel shows, at its middle, or at the place next to it that is on a triangle."""
        if not len(self.flat):
            return None
        middle = np.array([column + 0.5, row + 0.5])
        weights = np.maximum(_barycentric(self.flat, middle), 0.0)
        weights /= weights.sum(axis=1, keepdims=True)
        nearest = np.einsum("fk,fkx->fx", weights, self.flat) - middle
        away = np.einsum("fx,fx->f", nearest, nearest)
        best = int(np.argmin(away))
        if away[best] > NEAR * NEAR:
            return None
        return self._place(column, row, best, weights[best])

    def under_ray(self, origin: Array, direction: Array) -> TexelPlace | None:
        """The texel of the first surface that a ray meets, from either side."""
        distance, weights = ray_triangle(origin, direction, *np.moveaxis(self.corners, 1, 0))
        met = np.flatnonzero(distance > 0.0)
        if len(met) == 0:
            return None
        best = int(met[np.argmin(distance[met])])
        place = np.clip(np.floor(weights[best] @ self.flat[best]), 0, self.size - 1)
        return self._place(int(place[0]), int(place[1]), best, weights[best])

    def _place(self, column: int, row: int, triangle: int, weights: Array) -> TexelPlace:
        a, b, c = self.corners[triangle]
        side = unit(cross(b - a, c - a))
        position = weights @ self.corners[triangle]
        return TexelPlace(column, row, int(self.item[triangle]), position, side)


def texel_places(lightmap: Lightmap, scene: Scene) -> TexelPlaces:
    """The triangles of ``scene`` as ``lightmap`` has them.

    Raises
    ------
    PlaygroundError
        The lightmap was baked for other geometry.
    """
    lightmap.check_fits(scene)
    corners, flat, items = [np.zeros((0, 3, 3))], [np.zeros((0, 3, 2))], [np.zeros(0, np.int64)]
    for number, (item, part) in enumerate(zip(scene.objects, lightmap.parts, strict=True)):
        if part is None:
            continue
        kept = part.faces[(part.charts[part.faces] >= 0).all(axis=1)]
        positions, _ = placed(item, np.zeros(3))
        corners.append(positions[part.vertices[kept]])
        flat.append(part.texcoords[kept].astype(np.float64) * lightmap.size)
        items.append(np.full(len(kept), number, np.int64))
    world, atlas = np.concatenate(corners), np.concatenate(flat)
    area = np.linalg.norm(cross(*_sides(world)), axis=1).sum()
    texels = np.linalg.norm(cross(*_sides(np.pad(atlas, ((0, 0), (0, 0), (0, 1))))), axis=1).sum()
    spacing = float(np.sqrt(area / texels)) if texels > 0.0 else 0.0
    return TexelPlaces(lightmap.size, world, atlas, np.concatenate(items), spacing)


def _sides(triangles: Array) -> tuple[Array, Array]:
    """Two sides of triangles (F, 3, 3), from their first corner."""
    return triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]


def _barycentric(triangles: Array, point: Array) -> Array:
    """The weights (F, 3) of the corners of flat triangles (F, 3, 2) at a point (2,)."""
    a, b, c = np.moveaxis(triangles, 1, 0)
    first, second, to = b - a, c - a, point - a
    area = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
    safe = np.where(area == 0.0, 1.0, area)
    v = (to[:, 0] * second[:, 1] - to[:, 1] * second[:, 0]) / safe
    w = (first[:, 0] * to[:, 1] - first[:, 1] * to[:, 0]) / safe
    weights = np.stack([1.0 - v - w, v, w], axis=1)
    weights[area == 0.0] = 1.0 / 3.0  # a triangle of no area: its middle
    return np.asarray(weights)
