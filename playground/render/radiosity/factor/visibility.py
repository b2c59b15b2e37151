"""Whether two patches see each other: which face, and what stands in between.

Segments between points on patches are held against the undivided parents of the patches:
few triangles. No segment meets the surface on which it ends, nor a coplanar neighbour of it,
because its ends are lifted off their planes, to the front, by more than the error of any test,
yet by far less than one could see (`lift_of`).
"""

from __future__ import annotations

import weakref
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from playground.render.radiosity.patch.patches import Patches
from playground.render.trace.bvh import Bvh, build
from playground.render.trace.walk import blocked
from playground.shading.floats import Array

Ints = NDArray[np.intp]
Bools = NDArray[np.bool_]

# Of the largest coordinate. A corner that was cut from its parent is off by a few roundings of it,
# the shear of a ray by six, the products of the test by a few more: below 20 in all.
LIFT = 32.0
UNIT = float(np.finfo(np.float64).eps)
SINGLE = float(np.finfo(np.float32).eps)
BATCH = 1 << 22  # heights of parents over planes at a time


@dataclass(frozen=True, eq=False)
class Between:
    """What can stand between points: a tree of triangles, and the `lift_of` the patches.

    ``tree`` holds the parents that can hide patches from one another.
    """

    tree: Bvh
    lift: float
    parents: Array  # (M, 4, 3): all of them

    @cached_property
    def whole(self) -> Bvh:
        """The tree of all parents: seen from a lamp outside, walls stand in the way."""
        return tree_of(halves(self.parents)[0])

    def hidden(self, start: Array, up: Array, end: Array, down: Array) -> Bools:
        """Whether something stands between points on patches, (P,).

        ``start`` and ``end`` (P, 3) are relative to the patches' origin, ``up`` and ``down``
        (P, 3) the unit normals there.
        """
        if self.tree.nodes == 0:
            return np.zeros(len(start), dtype=bool)
        origin = start + self.lift * up
        return blocked(self.tree, origin, end + self.lift * down - origin, 1.0)


_known: weakref.WeakKeyDictionary[Patches, Between] = weakref.WeakKeyDictionary()


def between(patches: Patches) -> Between:
    """What can stand between ``patches``; prepared once for as long as they live."""
    found = _known.get(patches)
    if found is None:
        corners = patches.parents.corners
        triangles, _ = halves(corners[can_hide(patches)])
        found = _known[patches] = Between(tree_of(triangles), lift_of(patches), corners)
    return found


def lift_of(patches: Patches) -> float:
    """How far the ends of segments are lifted off their planes.

    The rounding of the tests, and how far quads made of two triangles with float32 coordinates
    are bent.
    """
    return LIFT * UNIT * size_of(patches) + 2.0 * bend_of(patches)


def bend_of(patches: Patches) -> float:
    """How far from flat the parents are at most."""
    corners = patches.parents.corners
    height = np.einsum("mi,mki->mk", parent_normals(patches), corners - corners[:, :1])
    return float(np.ptp(height, axis=1).max())


def size_of(patches: Patches) -> float:
    """The largest coordinate, relative to the patches' own origin."""
    return float(np.abs(patches.parents.corners).max())


def parent_normals(patches: Patches) -> Array:
    """The unit normals of the parents, (M, 3)."""
    corners = patches.parents.corners
    across = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    return np.asarray(across / np.linalg.norm(across, axis=-1, keepdims=True))


def tree_of(triangles: Array) -> Bvh:
    """The tree over triangles (F, 3, 3)."""
    return build(triangles.reshape(-1, 3), np.arange(3 * len(triangles)).reshape(-1, 3))


def halves(polygons: Array) -> tuple[Array, Ints]:
    """Triangles (F, 3, 3) of triangles and convex quads (M, 4, 3), and whose they are, (F,)."""
    quads = np.flatnonzero((polygons[:, 2] != polygons[:, 3]).any(axis=-1))
    triangles = np.concatenate([polygons[:, :3], polygons[quads][:, [0, 2, 3]]])
    return triangles, np.concatenate([np.arange(len(polygons)), quads])


def can_hide(patches: Patches) -> Bools:
    """Which parents have others on both sides of their plane, (M,): only these can hide anything.

    The walls of a room with nothing outside are in nobody's way: no ray is tested against them.
    Coordinates of meshes are float32: what lies behind a plane by no more than their rounding
    counts as on it, such as a block put onto a floor.
    """
    corners = patches.parents.corners
    normal = parent_normals(patches)
    points = np.unique(corners.reshape(-1, 3), axis=0)
    found, step = [], max(BATCH // len(points), 1)
    rounding = max(lift_of(patches), SINGLE * size_of(patches))
    for first in range(0, len(corners), step):
        up = normal[first : first + step]
        height = (
            up @ points.T - np.einsum("mi,mi->m", up, corners[first : first + step, 0])[:, None]
        )
        found.append((height.max(axis=1) > rounding) & (height.min(axis=1) < -rounding))
    return np.concatenate(found)


def facing(patches: Patches, i: Ints, j: Ints) -> Bools:
    """Which pairs have a part of either patch before the other, (P,).

    Coplanar patches and those behind exchange no light, and nothing further is computed for them.
    """
    rounding = lift_of(patches)
    return _before(patches, i, j, rounding) & _before(patches, j, i, rounding)


def _before(patches: Patches, i: Ints, j: Ints, rounding: float) -> Bools:
    """Whether a part of patch j is before the plane of i by more than rounding, (P,)."""
    corners, normal = patches.polygon, patches.normal
    height = np.einsum("pki,pi->pk", corners[j] - corners[i, :1], normal[i])
    return np.asarray((height > rounding).any(axis=1))
