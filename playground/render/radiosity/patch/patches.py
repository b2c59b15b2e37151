"""The patches that radiosity trades light between: flat pieces, each of one colour.

What they are, in flat arrays; `divide` makes them of a setup.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from playground.shading.floats import Array
from playground.shading.vector import cross

Ints = NDArray[np.int32]
# No edge of anything built by hand is at a right angle to it. Roberts 2018: multiples fill a cube.
SLANTED = np.array([0.8191725133961645, 0.6710436067037893, 0.5497004779019703])


@dataclass(frozen=True, eq=False)
class Parents:
    """The M undivided triangles and convex quads that the patches were cut from.

    A regular parent is cut evenly, so that its patches can be found from where a point lies
    on it: a quad into ``grid`` = (m, n) pieces along its first edge and along its last, the
    piece in column a and row b being patch ``first + a * n + b``; a triangle into m = n parts
    of each edge, m² pieces: of the cell in column a and row b, along the edges from its first
    corner, the half at that corner is patch ``first + a * (2m - a) + 2b``, the other the next.
    """

    corners: Array  # (M, 4, 3): counter-clockwise from the front; a triangle repeats its last
    grid: Ints  # (M, 2)
    first: Ints  # (M,): its first patch; its patches follow one another
    regular: NDArray[np.bool_]  # (M,)

    @property
    def triangle(self) -> NDArray[np.bool_]:
        """Which parents are triangles, (M,)."""
        return np.asarray(np.all(self.corners[:, 2] == self.corners[:, 3], axis=-1))

    def patch_at(self, parent: Ints, s: Array, t: Array) -> Ints:
        """Which patch (K,) of regular parents (K,) holds the points (s, t), (K,) in [0, 1] each.

        On a quad the point is the bilinear mean of the corners a, b, c, d, with s from a to b
        and t from a to d; on a triangle it is a + s (b − a) + t (c − a), s + t at most 1.
        """
        m, n = self.grid[parent].T
        a = np.minimum((s * m).astype(np.int32), m - 1)
        b = np.minimum((t * n).astype(np.int32), n - 1)
        beyond = (s * m - a) + (t * n - b) > 1.0
        beyond &= a + b < m - 1  # the cells along the third edge have one half
        piece = np.where(self.triangle[parent], a * (2 * m - a) + 2 * b + beyond, a * n + b)
        return np.asarray(self.first[parent] + piece, dtype=np.int32)


@dataclass(frozen=True, eq=False)
class Cells:
    """What adaptive division divides: pieces before the seams to smaller neighbours are cut."""

    corners: Ints  # (C, 4): into the points, like those of patches
    of: Ints  # (N,): of which cell a patch is the whole or a part


@dataclass(frozen=True, eq=False)
class Patches:
    """N flat patches. All lengths are in world units, all points relative to ``origin``."""

    origin: Array  # (3,): in the world; keeps the digits of a scene far from its origin
    points: Array  # (V, 3): corners; patches joined smoothly share them
    normals: Array  # (V, 3): unit shading normals there
    texcoords: Array | None  # (V, 2), None if no object has any
    corners: Ints  # (N, 4): into `points`, from the front; a triangle repeats its last
    owner: Ints  # (N,): which object of the scene; after the objects come the area lights
    parent: Ints  # (N,): of which parent it is a piece
    reflectance: Array  # (N, 3): w_d m_d, times the mean of the texture, in [0, 1)
    emission: Array  # (N, 3): w_e m_e, or the s_d of an area light: as radiance, like all colours
    parents: Parents
    cells: Cells | None = None  # None where each patch is one
    warnings: tuple[str, ...] = ()

    def __len__(self) -> int:
        return len(self.corners)

    @cached_property
    def polygon(self) -> Array:
        """The corners themselves, (N, 4, 3)."""
        return np.asarray(self.points[self.corners])

    @cached_property
    def triangle(self) -> NDArray[np.bool_]:
        """Which patches are triangles, (N,)."""
        return np.asarray(self.corners[:, 2] == self.corners[:, 3])

    @cached_property
    def _area_vector(self) -> Array:
        a, b, c, d = np.moveaxis(self.polygon, 1, 0)
        return 0.5 * cross(c - a, d - b)  # of a flat quad; of a triangle too, where d is c

    @cached_property
    def area(self) -> Array:
        """(N,), in world units squared."""
        return np.asarray(np.linalg.norm(self._area_vector, axis=-1))

    @cached_property
    def normal(self) -> Array:
        """Unit normals of the flat pieces themselves, to the front, (N, 3)."""
        return np.asarray(self._area_vector / self.area[:, None])

    @cached_property
    def turned(self) -> Array:
        """`polygon` with each patch's lowest corner along `SLANTED` first, (N, 4, 3).

        Points of a patch that are counted from there are the same wherever its mesh, or the author
        of a lamp, begins to list the corners.
        """
        height = self.polygon @ SLANTED
        lowest = np.where(
            self.triangle, np.argmin(height[:, :3], axis=1), np.argmin(height, axis=1)
        )[:, None]
        of_three = (lowest + np.array([0, 1, 2, 2])) % 3
        place = np.where(self.triangle[:, None], of_three, (lowest + np.arange(4)) % 4)
        return np.asarray(np.take_along_axis(self.polygon, place[..., None], axis=1))

    @cached_property
    def box(self) -> tuple[Array, Array]:
        """The lowest and the highest coordinates of each patch, (N, 3) both."""
        return self.polygon.min(axis=1), self.polygon.max(axis=1)

    @cached_property
    def rank(self) -> Ints:
        """The place of each patch, (N,), from the smallest to the largest.

        Among those of one area, in single precision, it goes by the height along `SLANTED`: not by
        the number, which follows from the order of corners.
        """
        order = np.lexsort((self.centre @ SLANTED, self.area.astype(np.float32)))
        rank = np.empty(len(self), dtype=np.int32)
        rank[order] = np.arange(len(self), dtype=np.int32)
        return rank

    @cached_property
    def centre(self) -> Array:
        """Centroids, (N, 3): the mean of both halves of a quad by their areas."""
        a, b, c, d = np.moveaxis(self.polygon, 1, 0)
        normal = self.normal
        halves = (a + b + c) / 3.0, (a + c + d) / 3.0
        areas = [
            0.5 * np.einsum("ni,ni->n", cross(u - a, v - a), normal)[:, None]
            for u, v in ((b, c), (c, d))
        ]
        return np.asarray((halves[0] * areas[0] + halves[1] * areas[1]) / (areas[0] + areas[1]))
