"""Whether a scene is closed: whether all light that leaves a patch meets the front of another.

Then the form factors of a patch sum to exactly 1; by how much a method's sums differ from 1
is its error, which normalising removes. In an open scene a sum below 1 is the truth. Sums
alone cannot tell the two apart, so rays are asked.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from playground.render.radiosity.factor.visibility import halves, tree_of
from playground.render.radiosity.patch.patches import Patches
from playground.render.trace.walk import closest
from playground.shading.floats import Array
from playground.shading.vector import cross, dot, unit

RAYS = 16  # from each patch that is asked
ASKED = 256  # patches, evenly chosen, and as many once more by their area
MOVES = (0.7548776662466927, 0.5698402909980532)  # Roberts 2018: multiples fill a square evenly
LOST = 1e-3  # a larger share of rays that meet nothing, or a back, makes a scene open


def is_closed(patches: Patches) -> bool:
    """Whether fewer than `LOST` of some rays from all over the scene leave it or meet a back.

    `RAYS` rays start at the centre of each of up to `ASKED` patches, spread as a diffuse
    surface sends its light. A patch from which no ray meets any front is covered, as
    the floor beneath a box is, and does not count. An opening that patches see as less than
    about `LOST` of their hemisphere is missed: normalising then changes a sum by no more.
    Both evenly chosen patches and patches chosen by area must pass: many small ones, such as
    those of a round thing, must not hide what a few large ones lose.
    """
    count = min(ASKED, len(patches))
    evenly = np.linspace(0, len(patches) - 1, count).astype(int)
    by_area = np.searchsorted(
        np.cumsum(patches.area), (np.arange(count) + 0.5) / count * patches.area.sum()
    )
    return all(
        _keeps(patches, chosen) for chosen in (evenly, np.minimum(by_area, len(patches) - 1))
    )


def _keeps(patches: Patches, chosen: NDArray[np.intp]) -> bool:
    """Whether the rays of the chosen patches stay."""
    normal = patches.normal[chosen]
    direction = _spread(normal)
    size = float(np.ptp(patches.points, axis=0).max())
    start = patches.centre[chosen] + 1e-9 * size * normal  # off the plane of the patch itself
    triangles, _ = halves(patches.parents.corners)
    front = cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    origin = np.repeat(start, RAYS, axis=0)
    _, met, _ = closest(tree_of(triangles), origin, direction.reshape(-1, 3), np.inf)
    facing = dot(front[np.maximum(met, 0)], direction.reshape(-1, 3)) < 0.0
    kept = ((met >= 0) & facing).reshape(-1, RAYS)
    open_to = kept[kept.any(axis=1)]
    return bool(open_to.size and np.mean(~open_to) <= LOST)


def _spread(normal: Array) -> Array:
    """`RAYS` directions about each normal (N, 3), spread as the cosine; (N, RAYS, 3).

    A grid in the unit square, moved a little for each patch so that no ray aims along a diagonal
    at the seam between two walls; mapped to the disc and raised to the hemisphere (Malley's
    method: Pharr, Jakob and Humphreys, Physically Based Rendering, 2016, section 13.6.3).
    """
    side = int(RAYS**0.5)
    grid = np.indices((side, side)).reshape(2, 1, -1)
    moved = np.multiply.outer(MOVES, 0.5 + np.arange(len(normal)))[..., None] % 1.0
    u, v = (grid + moved) / side
    angle = 2.0 * np.pi * v
    flat = np.sqrt(u)
    local = np.stack([flat * np.cos(angle), flat * np.sin(angle), np.sqrt(1.0 - u)], axis=-1)
    axis = np.where(np.abs(normal[:, :1]) < 0.5, [[1.0, 0.0, 0.0]], [[0.0, 1.0, 0.0]])
    tangent = unit(cross(normal, axis))
    frame = np.stack([tangent, cross(normal, tangent), normal], axis=1)
    return np.asarray(np.einsum("nrk,nkx->nrx", local, frame))
