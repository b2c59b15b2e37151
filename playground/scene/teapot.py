"""The Utah teapot: 32 bicubic Bezier patches, evaluated with their exact normals.

Knows Bernstein polynomials and the data file. Must not know the registry of shapes.

The mesh is y up, a third of Newell's size: the pot's axis is the y axis, the spout
points to +x, x runs from -1 to 1.145, y from -0.525 to 0.525, z from -2/3 to 2/3.
It is an open surface, as Newell made it: the lid rests 0.033 inside the rim, and
handle and spout end inside the body.
"""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import NDArray

from playground.errors import PlaygroundError
from playground.locate import asset
from playground.scene.mesh import Mesh
from playground.scene.normals import direction
from playground.scene.shapes_lattice import Piece, at_least, join, lattice

Floats = NDArray[np.float64]

PATCHES, VERTICES = 32, 306
SCALE = 1.0 / 3.0
MIDDLE_HEIGHT = 1.575  # half of Newell's height 3.15


def teapot(tessellation: int = 10) -> Mesh:
    """The Utah teapot with texture coordinates (u, v) of each patch.

    Parameters
    ----------
    tessellation : int
        Segments n >= 1 along each patch edge; 64 n^2 - 8 n triangles, since a cell at
        the middle of the lid or of the bottom is one triangle, not two. With n = 1 the
        lip of the spout lies on a line, and its four triangles are left out.

    References
    ----------
    M. Newell, "The Utilization of Procedure Models in Digital Image Synthesis",
    PhD thesis, University of Utah, 1975.
    """
    at_least(tessellation, 1)
    pieces = [_piece(patch, tessellation) for patch in control_points()]
    return join(pieces, "teapot")


@cache
def control_points() -> Floats:
    """The control points, float64, shape (32, 4, 4, 3): patch, row (v), column (u), x y z.

    Already turned y up, scaled and centred as the mesh is.
    """
    words = [
        line.split()
        for line in asset("meshes/utah_teapot.txt").read_text(encoding="ascii").splitlines()
        if line and not line.startswith("#")
    ]
    headings = [words[0], words[PATCHES + 1]] if len(words) == PATCHES + VERTICES + 2 else []
    if headings != [["patches", str(PATCHES)], ["vertices", str(VERTICES)]]:
        raise PlaygroundError(
            "assets/meshes/utah_teapot.txt is damaged",
            got=f"{len(words)} lines",
            allowed=f"{PATCHES} patches and {VERTICES} vertices",
            fix="Restore the file from the repository.",
        )
    numbers = np.array(words[1 : PATCHES + 1], dtype=np.int64)
    x, y, z = np.array(words[PATCHES + 2 :], dtype=np.float64).T
    # Turn z up into y up: a rotation about x by -90 degrees
    upright = np.stack([x, z - MIDDLE_HEIGHT, -y], axis=1) * SCALE
    points: Floats = upright[numbers].reshape(PATCHES, 4, 4, 3)
    points.setflags(write=False)
    return points


def bernstein(tessellation: int) -> tuple[Floats, Floats]:
    """Cubic Bernstein polynomials and their derivatives at i/n, both of shape (n + 1, 4).

    B_k(t) = C(3, k) t^k (1 - t)^(3 - k). Written so that t and 1 - t give the same
    bits: two patches that walk their common border in opposite ways agree exactly.
    """
    t = np.arange(tessellation + 1) / tessellation
    s = np.arange(tessellation, -1, -1) / tessellation
    value = np.stack([s * s * s, 3.0 * (s * s) * t, 3.0 * (t * t) * s, t * t * t], axis=1)
    first, middle, last = 3.0 * (s * s), 6.0 * (s * t), 3.0 * (t * t)
    slope = np.stack([-first, first - middle, middle - last, last], axis=1)
    return value, slope


def blend(weights: Floats, points: Floats) -> Floats:
    """sum_k weights[:, k] points[k] for points of shape (4, ...), outer pair plus inner pair.

    Sums of two do not depend on the order, so mirrored input gives mirrored output.
    """
    outer = np.multiply.outer(weights[:, 0], points[0]) + np.multiply.outer(
        weights[:, 3], points[3]
    )
    inner = np.multiply.outer(weights[:, 1], points[1]) + np.multiply.outer(
        weights[:, 2], points[2]
    )
    total: Floats = outer + inner
    return total


def evaluate(patch: Floats, tessellation: int) -> tuple[Floats, Floats]:
    """Positions and unit outward normals of one patch at the lattice points.

    Parameters
    ----------
    patch : float64 array of shape (4, 4, 3): row (v), column (u), x y z

    Returns
    -------
    positions, normals : float64 arrays of shape (n + 1, n + 1, 3), row v, column u
        The normal is dP/du x dP/dv. Where the row v = 0 is a single
        point, dP/du vanishes like v d2P/dudv, so the limit is d2P/dudv x dP/dv.
    """
    value, slope = bernstein(tessellation)
    across = np.moveaxis(patch, 1, 0)
    columns = np.moveaxis(blend(value, across), 0, 1)
    columns_du = np.moveaxis(blend(slope, across), 0, 1)
    positions = blend(value, columns) + 0.0
    along_u, along_v = blend(value, columns_du), blend(slope, columns)
    if first_row_is_point(patch):
        along_u[0] = blend(slope[:1], columns_du)[0]
    # In all of Newell's patches u x v points outwards
    return positions, direction(np.cross(along_u, along_v)) + 0.0


def first_row_is_point(patch: Floats) -> bool:
    """Whether the control points of the row v = 0 coincide (middle of lid and of bottom)."""
    return bool((patch[0] == patch[0, 0]).all())


def _piece(patch: Floats, tessellation: int) -> Piece:
    """One patch as triangles that are counter-clockwise seen from outside."""
    positions, normals = evaluate(patch, tessellation)
    parameter = np.arange(tessellation + 1) / tessellation
    u, v = np.meshgrid(parameter, parameter)
    # Seen from outside v runs down while u runs left: turn each triangle round
    faces = lattice(tessellation, tessellation, first_is_point=first_row_is_point(patch))[:, ::-1]
    return Piece(
        positions.reshape(-1, 3),
        normals.reshape(-1, 3),
        np.stack([u, v], axis=-1).reshape(-1, 2),
        faces,
    )
