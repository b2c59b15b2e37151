"""What a texel sees around it: the patches of a solved scene, met by rays."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from playground.render.radiosity.factor.visibility import halves, lift_of, tree_of
from playground.render.radiosity.patch.patches import Patches
from playground.render.trace import walk
from playground.render.trace.bvh import Bvh
from playground.render.trace.lamp import square_points
from playground.shading.floats import Array
from playground.shading.vector import cross, dot

Ints = NDArray[np.intp]
NO_SHIFT = np.zeros(2)


class Met(NamedTuple):
    """What rays met first: t (inf for nothing), the patch (−1), and whether its front."""

    t: Array
    patch: Ints
    front: NDArray[np.bool_]


class Surroundings:
    """The patches ready to be met by rays, through Embree where it is installed."""

    def __init__(self, patches: Patches) -> None:
        triangles, self._patch = halves(patches.polygon)
        self._tree: Bvh = tree_of(triangles)
        self._normal = patches.normal
        self._walker: Any = _walker()
        self.lift = lift_of(patches)

    def meet(self, origin: Array, direction: Array, limit: float = np.inf) -> Met:
        """The first patches along rays (N, 3) that start on surfaces, lifted off them."""
        t, triangle, _ = self._walker.closest(self._tree, origin, direction, limit)
        hit = triangle >= 0
        patch = np.where(hit, self._patch[triangle], -1)
        front = hit & (dot(self._normal[patch], direction) < 0.0)
        return Met(np.where(hit, t, np.inf), patch, front)


def _walker() -> Any:
    try:
        import embreex  # noqa: F401
    except ImportError:
        return walk
    from playground.render.trace import embree

    return embree


def hemisphere(count: int, shift: Array = NO_SHIFT) -> Array:
    """``count`` directions about +z, (count, 3), as dense as the cosine to it.

    Each stands for the same share of the light that arrives (Nusselt's analogue: evenly spread
    over the disc below them). ``shift`` (2,) moves them all, within the square they come from.
    """
    square = (square_points(count) + shift) % 1.0
    radius, turn = np.sqrt(square[:, 0]), 2.0 * np.pi * square[:, 1]
    across = np.stack([radius * np.cos(turn), radius * np.sin(turn)], axis=1)
    return np.column_stack([across, np.sqrt(1.0 - radius**2)])


def frames(normal: Array) -> Array:
    """Two unit vectors across each unit normal (N, 3), and the normal itself: rows of (N, 3, 3).

    Source: Duff et al., Building an Orthonormal Basis, Revisited, JCGT 6(1), 2017.
    """
    x, y, z = normal.T
    sign = np.where(z >= 0.0, 1.0, -1.0)
    a = -1.0 / (sign + z)
    b = x * y * a
    first = np.stack([1.0 + sign * x * x * a, sign * b, -sign * x], axis=1)
    return np.stack([first, cross(normal, first), normal], axis=1)
