"""What all generated shapes share: lattices of vertices, circles, and joining pieces.

Knows rows and columns. Must not know any particular shape.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from playground.errors import PlaygroundError
from playground.scene.mesh import Mesh

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]


class Piece(NamedTuple):
    """A part of a surface in float64, before it is rounded into a `Mesh`.

    positions and normals have the shape (N, 3), texcoords (N, 2), faces (M, 3).
    """

    positions: Floats
    normals: Floats
    texcoords: Floats
    faces: Integers


def circle(segments: int) -> tuple[Floats, Floats]:
    """Cosine and sine of i/segments turns for i = 0..segments, each of shape (segments + 1,).

    The last entry repeats the first to the bit, and quarter turns are exactly 0 and
    +-1, so that seams and quadrants fit together without a gap.
    """
    at_least(segments, 3)
    quarter, rest = np.divmod(4 * (np.arange(segments + 1) % segments), segments)
    angle = rest * (0.5 * np.pi / segments)
    cosine, sine = np.cos(angle), np.sin(angle)
    # Turn the first quadrant by whole quarters; adding 0 removes negative zeros
    around = np.stack([cosine, -sine, -cosine, sine])
    column = np.arange(segments + 1)
    return around[quarter, column] + 0.0, around[quarter - 1, column] + 0.0


def steps(count: int) -> Floats:
    """The numbers -1..1 in ``count`` equal steps, mirror-symmetric to the bit."""
    at_least(count, 1)
    return (2 * np.arange(count + 1) - count) / count


def lattice(
    rows: int, columns: int, first_is_point: bool = False, last_is_point: bool = False
) -> Integers:
    """Triangles over (rows + 1) x (columns + 1) vertices numbered row by row.

    Counter-clockwise seen from the side on which rows run down and columns run right.

    Parameters
    ----------
    rows, columns : int
        Number of cells.
    first_is_point, last_is_point : bool
        The first or last row lies in one point: each cell there is one triangle, and
        vertex j of that row belongs to cell j alone.

    Returns
    -------
    int64 array of shape (M, 3)
    """
    corner = np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)
    left, right, below = corner, corner + 1, corner + columns + 1
    lower = np.stack([left, below, below + 1], axis=-1)
    upper = np.stack([left, below + 1, right], axis=-1)
    cells = np.stack([lower, upper], axis=2)
    keep = np.ones((rows, columns, 2), dtype=bool)
    if first_is_point:
        keep[0, :, 1] = False
    if last_is_point:
        # Only the upper triangle is left; let it hang on the pole vertex of its cell
        keep[-1, :, 0] = False
        cells[-1, :, 1, 1] = below[-1]
    faces: Integers = cells[keep]
    return faces


def join(pieces: list[Piece], name: str) -> Mesh:
    """One mesh of all pieces, without the vertices no triangle uses."""
    starts = np.cumsum([0] + [len(piece.positions) for piece in pieces[:-1]])
    faces = np.concatenate(
        [piece.faces + start for piece, start in zip(pieces, starts, strict=True)]
    )
    used = np.zeros(sum(len(piece.positions) for piece in pieces), dtype=bool)
    used[faces] = True
    return Mesh.create(
        np.concatenate([piece.positions for piece in pieces])[used],
        (np.cumsum(used) - 1)[faces],
        np.concatenate([piece.normals for piece in pieces])[used],
        np.concatenate([piece.texcoords for piece in pieces])[used],
        name,
    )


def at_least(tessellation: int, low: int) -> None:
    """Raise PlaygroundError if a shape cannot be made of so few parts."""
    if tessellation < low:
        raise PlaygroundError(
            "tessellation is too small", got=tessellation, allowed=f"{low} or more for this shape"
        )
