"""Where in the world each texel of a lightmap lies, and which way its surface looks."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from playground.render.lightmap.atlas import Atlas
from playground.render.lightmap.cover import cover
from playground.scene.scene import Object, Scene
from playground.shading.floats import Array
from playground.shading.vector import cross, dot, normal_matrix, orientation, unit

Ints = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Texels:
    """T texels that charts cover, sorted by row and column.

    ``position`` (T, 3) is relative to ``origin`` (3,), in the unit of the world; ``normal`` (T, 3)
    is the interpolated one, turned to the front where it looks away, ``side`` (T, 3) the
    geometric one, to the front. A texel is ``spacing`` wide in the world.
    """

    size: int
    origin: Array
    column: Ints
    row: Ints
    item: Ints  # which object, (T,)
    chart: Ints  # which chart, (T,)
    position: Array
    normal: Array
    side: Array
    spacing: float

    def __len__(self) -> int:
        return len(self.column)

    def image(self, values: Array) -> Array:
        """Values (T, C) in their places, (H, W, C); 0 where no chart is."""
        image = np.zeros((self.size, self.size, values.shape[1]))
        image[self.row, self.column] = values
        return image

    @property
    def coverage(self) -> NDArray[np.bool_]:
        """Which texels these are, (H, W)."""
        covered = np.zeros((self.size, self.size), dtype=bool)
        covered[self.row, self.column] = True
        return covered


def lay_out(scene: Scene, atlas: Atlas, origin: Array) -> Texels:
    """The texels that the charts of ``atlas`` need, with their places relative to ``origin`` (3,).

    At least one object must have a chart.
    """
    corners, flat, normals, sides, items, charts = [], [], [], [], [], []
    for number, (item, part) in enumerate(zip(scene.objects, atlas.parts, strict=True)):
        if part is None:
            continue
        kept = part.faces[(part.charts[part.faces] >= 0).all(axis=1)]
        places, directions = placed(item, origin)
        whole = part.vertices[kept]
        corners.append(places[whole])
        normals.append(directions[whole])
        sides.append(_outward(item, places[whole]))
        flat.append(part.texcoords[kept].astype(np.float64) * atlas.size)
        items.append(np.full(len(kept), number))
        charts.append(part.charts[kept[:, 0]])
    found = cover(np.concatenate(flat), atlas.size)
    triangle = found.triangle
    position, normal = (
        np.einsum("tc,tcx->tx", found.weights, np.concatenate(x)[triangle])
        for x in (corners, normals)
    )
    side = np.concatenate(sides)[triangle]
    normal = unit(normal)
    away = dot(normal, side) <= 0.0
    return Texels(
        size=atlas.size,
        origin=origin,
        column=found.column,
        row=found.row,
        item=np.concatenate(items)[triangle],
        chart=np.concatenate(charts)[triangle].astype(np.int64),
        position=position,
        normal=np.where(away[:, None], _turned(normal, side), normal),
        side=side,
        spacing=1.0 / atlas.density,
    )


def _turned(normal: Array, side: Array) -> Array:
    """Normals that look away, turned to the front; one within the surface becomes ``side``."""
    return np.where((dot(normal, side) < 0.0)[:, None], -normal, side)


def placed(item: Object, origin: Array) -> tuple[Array, Array]:
    """The vertices (V, 3) of an object, in the world relative to ``origin``, and unit normals."""
    geometry, matrix = item.geometry(), item.transform.matrix
    linear = matrix[:3, :3]
    local = geometry.mesh.positions.astype(np.float64) + geometry.offset
    normals = unit(geometry.mesh.normals.astype(np.float64) @ normal_matrix(linear).T)
    return local @ linear.T + (matrix[:3, 3] - origin), normals


def _outward(item: Object, corners: Array) -> Array:
    """Unit normals (F, 3) to the front of triangles (F, 3, 3)."""
    a, b, c = np.moveaxis(corners, 1, 0)
    outward = unit(cross(b - a, c - a))
    mirrored = orientation(item.transform.matrix[:3, :3]) < 0.0  # then corners run the other way
    return -outward if mirrored else outward
