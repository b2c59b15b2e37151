"""Divides patches where the light changes, and leaves no corner in the middle of an edge."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from playground.render.radiosity.patch.edges import edges_of
from playground.render.radiosity.patch.memory import check_memory
from playground.render.radiosity.patch.patches import Cells, Patches
from playground.render.radiosity.patch.seams import Mesh, balanced, divide_cells, pieces_of
from playground.shading.floats import Array

Integers = NDArray[np.int64]

CONTRAST = 0.1  # a step of light between neighbours, of the mean light, that asks for division


def refine(patches: Patches, light: Array, contrast: float = CONTRAST) -> Patches:
    """The patches with those divided whose light, (N, 3), differs much from that of a neighbour.

    A quad becomes 2 × 2, a triangle 4. What lies beside a divided patch is cut into transition
    pieces that end at its new corners, and no edge is divided twice as often as the one across
    (red-green refinement; Bank, Sherman, Weiser 1983). The next call takes transition pieces
    back before it divides, so they never become slivers; ``cells`` remembers of what they are
    parts. Where nothing asks for division the same patches are returned.

    New patches keep the reflectance and the emission of the whole that they were part of. Their
    parents are no longer regular.

    Parameters
    ----------
    light : (N, 3) array
        What the patches send out.
    contrast : float
        How large a difference between patches that share an edge and its points may be, as a
        share of the mean light of the patches that reflect (weighed by area).

    Raises
    ------
    PlaygroundError
        The form factors of so many patches would not fit into memory.
    """
    cells = patches.cells or Cells(patches.corners, np.arange(len(patches), dtype=np.int32))
    asked = np.zeros(len(cells.corners), dtype=bool)
    asked[cells.of[_steep(patches, light, contrast)]] = True
    if not asked.any():
        return patches
    first = np.zeros(len(cells.corners), dtype=np.int64)
    first[cells.of[::-1]] = np.arange(len(patches))[::-1]
    mesh = Mesh(patches, cells.corners.astype(np.int64), first)
    divide_cells(mesh, balanced(mesh, asked))
    corners, cell = pieces_of(mesh)
    check_memory(len(corners), len(patches))
    return _patches(patches, mesh, corners, cell)


def _steep(patches: Patches, light: Array, contrast: float) -> NDArray[np.bool_]:
    """Which patches differ from a neighbour, in any channel, by more than they may."""
    light = np.asarray(light, dtype=np.float64)
    reflecting = np.any(patches.reflectance > 0.0, axis=1)
    weight = np.where(reflecting, patches.area, 0.0)
    mean = float((weight @ light).max() / max(weight.sum(), np.finfo(float).tiny))
    edges = edges_of(patches.corners)
    first, second = (edges.patch[pair] for pair in edges.twins())
    large = np.abs(light[first] - light[second]).max(axis=1) > contrast * mean
    steep = np.zeros(len(patches), dtype=bool)
    steep[first[large]] = steep[second[large]] = True
    return steep


def _patches(old: Patches, mesh: Mesh, corners: Integers, cell: Integers) -> Patches:
    """The new patches, parent by parent, with what they have from the old ones."""
    source = mesh.source[cell]
    order = np.argsort(old.parent[source], kind="stable")
    corners, source, cell = corners[order], source[order], cell[order]
    parent = old.parent[source]
    count = len(old.parents.first)
    first = np.searchsorted(parent, np.arange(count))
    before = np.bincount(old.parent, minlength=count)
    regular = old.parents.regular & (np.bincount(parent, minlength=count) == before)
    return replace(
        old,
        points=mesh.points,
        normals=mesh.normals,
        texcoords=mesh.texcoords,
        corners=corners.astype(np.int32),
        owner=old.owner[source],
        parent=parent,
        reflectance=old.reflectance[source],
        emission=old.emission[source],
        parents=replace(old.parents, first=first.astype(np.int32), regular=regular),
        cells=Cells(mesh.corners.astype(np.int32), cell.astype(np.int32)),
    )
