"""The peer of form factors: pyviewfactor, where it is installed."""

from __future__ import annotations

from importlib import import_module
from importlib.util import find_spec

import numpy as np

from playground.render.radiosity.patch.patches import Patches
from playground.shading.floats import Array

NAME = "pyviewfactor"
INSTALLED = find_spec(NAME) is not None


def viewfactor_rows(patches: Patches) -> Array:
    """All rows F_ij of the patches, (N, N), with occlusion by whatever can hide anything."""
    from playground.render.radiosity.factor.visibility import can_hide

    pyvista = import_module("pyvista")

    def surface(quads: Array) -> object:
        count = len(quads)
        cells = np.column_stack([np.full(count, 4), np.arange(4 * count).reshape(-1, 4)])
        return pyvista.PolyData(quads.reshape(-1, 3), cells.ravel())

    blocks = patches.polygon[can_hide(patches)[patches.parent]]
    obstacles = surface(blocks).triangulate()  # type: ignore[attr-defined]
    matrix = import_module(NAME).compute_viewfactor_matrix(
        surface(patches.polygon), obstacles=obstacles
    )
    return np.asarray(matrix).T  # its [i, j] is what j sends to i
