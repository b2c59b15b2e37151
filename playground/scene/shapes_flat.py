"""Shapes made of plane faces: quad, grid, box.

Knows squares. Must not know curved surfaces or the registry.
"""

from __future__ import annotations

import numpy as np

from playground.scene.mesh import Mesh
from playground.scene.shapes_lattice import Piece, join, lattice, steps

# Right and up of each face of the box as seen from outside; outward = right x up.
BOX_FACES = (
    ((0, 0, -1), (0, 1, 0)),
    ((0, 0, 1), (0, 1, 0)),
    ((1, 0, 0), (0, 0, -1)),
    ((1, 0, 0), (0, 0, 1)),
    ((1, 0, 0), (0, 1, 0)),
    ((-1, 0, 0), (0, 1, 0)),
)


def quad(tessellation: int = 1) -> Mesh:
    """The square [-1, 1]^2 in the plane y = 0, facing +y.

    Parameters
    ----------
    tessellation : int
        Cells along each edge; 1 gives two triangles.
    """
    return join([_square((1, 0, 0), (0, 0, -1), 0.0, tessellation)], "quad")


def grid(tessellation: int = 16) -> Mesh:
    """The square of `quad` with enough vertices for per-vertex lighting to be fair."""
    return join([_square((1, 0, 0), (0, 0, -1), 0.0, tessellation)], "grid")


def box(tessellation: int = 1) -> Mesh:
    """The cube [-1, 1]^3 with a sharp normal and a whole texture on each face.

    Parameters
    ----------
    tessellation : int
        Cells along each edge.
    """
    return join([_square(right, up, 1.0, tessellation) for right, up in BOX_FACES], "box")


def _square(
    right: tuple[int, int, int], up: tuple[int, int, int], distance: float, tessellation: int
) -> Piece:
    """A square of side 2 at ``distance`` from the origin along right x up."""
    line = steps(tessellation)
    across, height = np.meshgrid(line, line[::-1])
    outward = np.cross(right, up).astype(np.float64)
    across, height = across.reshape(-1, 1), height.reshape(-1, 1)
    positions = across * right + height * up + distance * outward + 0.0
    return Piece(
        positions,
        np.tile(outward, (len(positions), 1)),
        0.5 + 0.5 * np.concatenate([across, height], axis=1),
        lattice(tessellation, tessellation),
    )
