"""Cells that are divided in four, and the pieces that close the seams between large and small."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from playground.render.radiosity.patch.edges import places
from playground.render.radiosity.patch.patches import Patches
from playground.scene.normals import direction
from playground.shading.floats import Array

Integers = NDArray[np.int64]
Flags = NDArray[np.bool_]

# How a cell is cut, by which of its edges have a point in the middle (bit k for the edge from
# corner k), up to turning it. Corners are 0 to 3, the middle of edge k is 4 + k.
QUAD_SEAMS = {
    0b0001: ((0, 4, 3, 3), (4, 1, 2, 2), (4, 2, 3, 3)),
    0b0011: ((4, 1, 5, 5), (0, 4, 3, 3), (5, 2, 3, 3), (4, 5, 3, 3)),
    0b0101: ((0, 4, 6, 3), (4, 1, 2, 6)),
    0b0111: ((0, 4, 6, 3), (4, 1, 5, 5), (5, 2, 6, 6), (4, 5, 6, 6)),
}
TRIANGLE_SEAMS = {
    0b001: ((0, 4, 2, 2), (4, 1, 2, 2)),
    0b011: ((4, 1, 5, 5), (0, 4, 5, 5), (0, 5, 2, 2)),
}


class Mesh:
    """Cells over points; an edge may have a point in its middle, where smaller cells begin."""

    def __init__(self, patches: Patches, corners: Integers, source: Integers) -> None:
        self.corners = corners  # (C, 4)
        self.source = source  # (C,): a patch that each is the whole of, or lies on
        self.patch_owner = patches.owner.astype(np.int64)
        point_owner = np.zeros(len(patches.points))
        point_owner[corners] = self.owner[:, None]
        values = [point_owner[:, None], patches.points, patches.normals]
        self.textured = patches.texcoords is not None
        values += [] if patches.texcoords is None else [patches.texcoords]
        self.values = np.concatenate(values, axis=1) + 0.0  # + 0.0: no negative zeros

    @property
    def owner(self) -> Integers:
        """Whose the cells are, (C,)."""
        return self.patch_owner[self.source]

    @property
    def points(self) -> Array:
        """Where the points are, (V, 3)."""
        return self.values[:, 1:4]

    @property
    def normals(self) -> Array:
        """Unit shading normals, (V, 3)."""
        return self.values[:, 4:7]

    @property
    def texcoords(self) -> Array | None:
        """Texture coordinates, (V, 2)."""
        return self.values[:, 7:] if self.textured else None

    @property
    def triangle(self) -> Flags:
        """Which cells are triangles, (C,)."""
        return np.asarray(self.corners[:, 2] == self.corners[:, 3])

    @property
    def real(self) -> Flags:
        """Which edges have a length, (C, 4); the third of a triangle has none."""
        return np.asarray(self.corners != np.roll(self.corners, -1, axis=1))

    def places(self) -> tuple[Integers, Integers]:
        """The places of the corners, (C, 4), and of points in the middles of edges, else −1.

        Points of one object at the very same spot are one place, also where a crease parts them.
        """
        after = np.roll(self.corners, -1, axis=1)
        middles = 0.5 * (self.points[self.corners] + self.points[after]).reshape(-1, 3)
        owner = np.concatenate([self.values[:, 0], np.repeat(self.owner, 4)])
        spot = places(np.concatenate([self.points, middles]), 0.0)
        _, place = np.unique(owner.astype(np.int64) * len(spot) + spot, return_inverse=True)
        at, middle = place[: len(self.points)], place[len(self.points) :].reshape(-1, 4)
        known = np.zeros(len(spot), dtype=bool)
        known[at] = True
        return at[self.corners], np.where(known[middle] & self.real, middle, -1)

    def blended(self, corners: Integers) -> Integers:
        """New points, the means of points (K, n); which numbers they have, (K,)."""
        mean = self.values[corners].mean(axis=1)
        total = self.normals[corners].sum(axis=1)
        none = ~np.any(total != 0.0, axis=1)  # opposite normals
        mean[:, 4:7] = direction(np.where(none[:, None], self.normals[corners[:, 0]], total))
        start = len(self.values)
        self.values = np.concatenate([self.values, mean])
        return start + np.arange(len(corners))

    def welded(self, *numbers: Integers) -> list[Integers]:
        """Points that are alike in everything become one; the same for what names them."""
        self.values, number = np.unique(self.values, axis=0, return_inverse=True)
        number = number.reshape(-1)
        self.corners = number[self.corners]
        return [number[x] for x in numbers]


def balanced(mesh: Mesh, asked: Flags) -> Flags:
    """Which cells are to be divided so that those asked for can be.

    Added are cells of which all edges would have a point in the middle, and those with a smaller
    neighbour that would be divided itself.
    """
    place, middle = mesh.places()
    after = np.roll(place, -1, axis=1)
    count = int(max(place.max(), middle.max())) + 1
    whole = _key(place, after, count)
    halves = _key(place, middle, count), _key(middle, after, count)
    asked = asked.copy()
    while True:
        cut = np.unique(whole[asked][mesh.real[asked]])
        met = (middle >= 0) | np.isin(whole, cut) | ~mesh.real
        smaller = (middle >= 0) & (np.isin(halves[0], cut) | np.isin(halves[1], cut))
        more = ~asked & (met.all(axis=1) | smaller.any(axis=1))
        if not more.any():
            return asked
        asked |= more


def _key(start: Integers, end: Integers, count: int) -> Integers:
    return np.asarray(np.minimum(start, end) * count + np.maximum(start, end))


def divide_cells(mesh: Mesh, asked: Flags) -> None:
    """Cut the cells asked for in four: at the middles of their edges."""
    quad, three = (np.flatnonzero(asked & kind) for kind in (~mesh.triangle, mesh.triangle))
    a, b, c, d = mesh.corners[quad].T
    ab, bc, cd, da = (mesh.blended(np.stack(e, axis=1)) for e in ((a, b), (b, c), (c, d), (d, a)))
    z = mesh.blended(mesh.corners[quad])
    fours = [[a, ab, z, da], [ab, b, bc, z], [z, bc, c, cd], [da, z, cd, d]]
    e, f, g, _ = mesh.corners[three].T
    ef, fg, ge = (mesh.blended(np.stack(x, axis=1)) for x in ((e, f), (f, g), (g, e)))
    threes = [[e, ef, ge, ge], [ef, f, fg, fg], [ge, fg, g, g], [ef, fg, ge, ge]]
    new = [np.stack(x, axis=1) for x in (*fours, *threes)]
    source = [mesh.source[quad]] * 4 + [mesh.source[three]] * 4
    mesh.corners = np.concatenate([mesh.corners[~asked], *new])
    mesh.source = np.concatenate([mesh.source[~asked], *source])
    mesh.welded()


def pieces_of(mesh: Mesh) -> tuple[Integers, Integers]:
    """The patches that cells become: corners (N, 4), and of which cell each is, (N,)."""
    _, middle = mesh.places()
    met = middle >= 0
    # Of a triangle the fourth edge stands in for the third, which has no length
    met[mesh.triangle, 2] = met[mesh.triangle, 3]
    met[mesh.triangle, 3] = False
    cell, slot = np.nonzero(met)
    corners = np.concatenate([mesh.corners, np.zeros_like(mesh.corners)], axis=1)
    sides = 4 - mesh.triangle[cell]
    ends = np.stack([mesh.corners[cell, slot], mesh.corners[cell, (slot + 1) % sides]], axis=1)
    corners[cell, 4 + slot] = mesh.blended(ends)
    (corners,) = mesh.welded(corners)
    kind = met @ np.array([1, 2, 4, 8])
    plain = np.flatnonzero(kind == 0)
    pieces, of = [corners[plain][:, :4]], [plain]
    for triangle, seams, size in ((False, QUAD_SEAMS, 4), (True, TRIANGLE_SEAMS, 3)):
        for pattern, template in seams.items():
            for turn in range(size):
                turned = sum(1 << ((k + turn) % size) for k in range(size) if pattern >> k & 1)
                if turn and turned == pattern:
                    break  # it looks like itself
                rows = np.flatnonzero((mesh.triangle == triangle) & (kind == turned))
                for piece in template:
                    at = [(k % 4 + turn) % size + 4 * (k > 3) for k in piece]
                    pieces.append(corners[rows][:, at])
                    of.append(rows)
    return np.concatenate(pieces), np.concatenate(of)
