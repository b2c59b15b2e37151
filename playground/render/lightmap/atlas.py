"""Every surface of a scene laid out flat, side by side, in one square of texels.

The library xatlas cuts meshes into charts that can be flattened and packs them; here it is told
how large the charts may be, so that all of them fill one square and none touches another.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from playground.errors import PlaygroundError
from playground.scene.mesh import Mesh
from playground.scene.scene import Object, Scene
from playground.shading.floats import Array

Ints = NDArray[np.int32]
GUTTER = 2  # free texels between charts: one pass of dilation for each of two neighbours
BORDER = GUTTER // 2  # and this many along the border, beyond which the image repeats
SIZES = (16, 8192)  # texels along an edge of an atlas
ROUNDS = 12  # of the search for the largest charts that fit
CLOSE = 0.01  # share of the scale at which it stops
UNITS = 4096.0  # the scene as xatlas sees it: it takes areas below 1e-7 for nothing


@dataclass(frozen=True, eq=False)
class Part:
    """One object in the atlas: its mesh, cut apart where charts end.

    Parameters
    ----------
    vertices : (V,) int32
        Which vertex of the object's mesh each vertex here is.
    faces : (M, 3) int32
        The triangles of the object's mesh, in its order.
    texcoords : (V, 2) float32
        Where the vertices lie in the atlas; (0, 0) is its lower left corner, 1 its size.
    charts : (V,) int32
        On which chart; −1 for a triangle too thin to be on any.
    """

    vertices: Ints
    faces: Ints
    texcoords: NDArray[np.float32]
    charts: Ints

    def mesh(self, whole: Mesh) -> Mesh:
        """The object's mesh ``whole``, cut apart as the atlas needs it."""
        texcoords = None if whole.texcoords is None else whole.texcoords[self.vertices]
        normals = whole.normals[self.vertices]
        return Mesh(whole.positions[self.vertices], normals, self.faces, texcoords, whole.name)


@dataclass(frozen=True, eq=False)
class Atlas:
    """Where each object of a scene lies in a square of ``size`` × ``size`` texels.

    ``density`` is the number of texels along a unit of the world. A part is None where an object
    is shrunk to nothing.
    """

    size: int
    parts: tuple[Part | None, ...]
    density: float

    @property
    def charts(self) -> int:
        """How many charts there are."""
        highest = [int(part.charts.max()) for part in self.parts if part is not None]
        return max(highest, default=-1) + 1


def unwrap(scene: Scene, size: int) -> Atlas:
    """Lay out every object of ``scene``, at the same number of texels per length in the world.

    Between any two charts, and across the border of the image, stay `GUTTER` texels that no
    bilinear lookup on a chart touches. The same scene always gives the same atlas.

    Raises
    ------
    PlaygroundError
        A size that is none, a scene without objects, or charts that do not fit at any scale.
    """
    check_size(size)
    world = [_placed(item) for item in scene.objects]
    if not any(np.any(positions) for positions, _ in world):
        raise PlaygroundError("there is no surface to lay out", fix="Add an object to the scene.")
    farthest = max(float(np.abs(positions).max()) for positions, _ in world)
    scale = 2.0 ** np.floor(np.log2(UNITS / farthest))
    meshes = [(positions * scale, faces) for positions, faces in world]

    with _on_one_processor():
        packed, density = _largest(meshes, size)
        parts = _parts(packed, meshes, size)
        del packed  # with its threads
    return Atlas(size, parts, float(density * scale))


def _largest(meshes: list[tuple[Array, Ints]], size: int) -> tuple[Any, float]:
    """An xatlas with the largest charts that fit, and its texels per unit.

    The packing decides, so there is no formula for it: a search.
    """
    space = size - 2 * BORDER
    area = sum(float(_areas(positions, faces).sum()) for positions, faces in meshes)
    low, high = 0.0, space / np.sqrt(area)
    packed = _filled(meshes)
    for _ in range(ROUNDS):
        if high - low <= CLOSE * high:
            break
        density = 0.5 * (low + high) if low > 0.0 else 0.7 * high
        if _packs(packed, density, space, area):
            low = density
        else:
            high = density
    if low == 0.0:
        raise PlaygroundError(
            "the surfaces do not fit into the lightmap",
            got=f"{size} x {size} texels",
            fix="Give it more texels, or take coarser meshes: every piece needs a few texels.",
        )
    _packs(packed, low, space, area)
    return packed, low


def check_size(size: int) -> None:
    """Raise an error unless a lightmap can be ``size`` texels wide."""
    whole = isinstance(size, (int, np.integer)) and not isinstance(size, bool)
    if not whole or not SIZES[0] <= size <= SIZES[1]:
        raise PlaygroundError(
            "this cannot be the size of a lightmap",
            got=str(size),
            allowed=f"a whole number of texels from {SIZES[0]} to {SIZES[1]}",
        )


def _placed(item: Object) -> tuple[Array, Ints]:
    """Positions with the axes and the unit of the world, and faces."""
    mesh = item.geometry().mesh
    return mesh.positions.astype(np.float64) @ item.transform.matrix[:3, :3].T, mesh.faces


def _areas(positions: Array, faces: Ints) -> Array:
    a, b, c = np.moveaxis(positions[faces], 1, 0)
    return np.asarray(0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1))


@contextmanager
def _on_one_processor() -> Iterator[None]:
    """Keep this thread, and those that it starts meanwhile, on one processor if that is possible.

    xatlas 0.0.11 starts threads that get in each other's way: of some hundred atlases one
    crashes or hangs. On one processor thousands did not.
    """
    if not hasattr(os, "sched_setaffinity"):
        yield
        return
    allowed = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {min(allowed)})
    try:
        yield
    finally:
        os.sched_setaffinity(0, allowed)


def _filled(meshes: list[tuple[Array, Ints]]) -> Any:
    """An xatlas of all meshes, not yet packed; one for all attempts, since making one is slow."""
    import xatlas

    atlas = xatlas.Atlas()
    for positions, faces in meshes:
        if np.any(positions):
            atlas.add_mesh(positions.astype(np.float32), faces.astype(np.uint32))
    return atlas


def _packs(atlas: Any, density: float, space: int, area: float) -> bool:
    """Pack an xatlas at ``density`` texels per unit; False if it needs more space."""
    import xatlas

    packing = xatlas.PackOptions()
    packing.padding, packing.bilinear = GUTTER, True
    packing.resolution, packing.texels_per_unit = space, float(density)
    atlas.generate(xatlas.ChartOptions(), packing)
    if atlas.atlas_count != 1 or max(atlas.width, atlas.height) > space:
        return False

    # A chart wider than the space would have been shrunk, and have fewer texels than the others.
    covered = 0.0
    for number in range(atlas.mesh_count):
        _, faces, texcoords = atlas[number]
        places = np.pad(texcoords * (atlas.width, atlas.height), ((0, 0), (0, 1)))
        covered += float(_areas(places, faces).sum())
    return bool(covered >= 0.98 * density * density * area)


def _parts(packed: Any, meshes: list[tuple[Array, Ints]], size: int) -> tuple[Part | None, ...]:
    parts: list[Part | None] = []
    number = 0
    for positions, _ in meshes:
        if not np.any(positions):
            parts.append(None)
            continue
        vertices, faces, texcoords = packed[number]
        page, chart = (x.astype(np.int64) for x in packed.get_mesh_vertex_assignment(number))
        chart = np.where(page == 0, chart, -1)
        places = texcoords.astype(np.float64) * (packed.width, packed.height) + BORDER
        columns = (vertices, faces, places / size, chart)
        kinds = (np.int32, np.int32, np.float32, np.int32)
        parts.append(Part(*(x.astype(kind) for x, kind in zip(columns, kinds, strict=True))))
        number += 1
    return tuple(parts)
