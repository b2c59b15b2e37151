"""Form factors by the Nusselt analogue: rays from a hemisphere around the centre of a patch.

Directions spread as the cosine are points spread evenly over the base of the hemisphere. So the
share of the rays that meet a patch is the share of the base that its projection covers, which is
its form factor.

Source: Nusselt, Graphische Bestimmung des Winkelverhältnisses bei der Wärmestrahlung, VDI 72,
1928; Malley, A Shading Method for Computer Generated Images, 1988, on the rays.
"""

from __future__ import annotations

import weakref

import numpy as np
from numpy.typing import ArrayLike, NDArray

from playground.render.radiosity.factor.visibility import halves, lift_of, tree_of
from playground.render.radiosity.patch.patches import Patches
from playground.render.trace.bvh import Bvh
from playground.render.trace.walk import closest
from playground.shading.floats import Array
from playground.shading.vector import dot, unit

Ints = NDArray[np.intp]

RAYS = 200_000  # at a time
SEED = 1  # the same patches get the same rays, each its own


def hemisphere(
    patches: Patches, chosen: ArrayLike, occlusion: bool = True, samples: int = 1024
) -> Array:
    """Rows F_ij from the centres of the chosen patches, (len(chosen), N).

    ``samples`` rays per patch, rounded up to a square number n: one in each of √n × √n cells of
    the base. Only cells on the border of a projection may count wrongly: with its perimeter P on
    the unit disc, 1.3 P √(n/π) of them, each with a standard deviation of at most 1/(2n). So the
    standard error is below √(P/5) n^(-3/4). Without the cells it would be √(F (1 − F)/n).
    Rays that meet nothing, or a back, count for no patch. Without ``occlusion`` a ray counts for
    every patch along it.
    """
    wanted = np.asarray(chosen, dtype=np.intp).reshape(-1)
    side = int(np.ceil(np.sqrt(samples)))
    rows = np.zeros((len(wanted), len(patches)))
    step = max(RAYS // side**2, 1)
    for first in range(0, len(wanted), step):
        rows[first : first + step] = _rows(patches, wanted[first : first + step], occlusion, side)
    return rows


def nusselt(position: ArrayLike, normal: ArrayLike, points: ArrayLike) -> Array:
    """Where points (K, 3) fall on the base of the unit hemisphere over ``position``, (K, 2).

    First onto the hemisphere, towards its centre, then straight down onto the base, a unit disc:
    the projection of a patch covers F π of it. In the axes of `base`; points below the horizon
    must be cut off before. Between the corners of a patch, edges become arcs of ellipses.
    """
    towards = unit(np.asarray(points, np.float64) - np.asarray(position, np.float64))
    across, along = base(np.asarray(normal, np.float64))
    return np.stack([dot(towards, across), dot(towards, along)], axis=-1)


def base(normal: Array) -> tuple[Array, Array]:
    """Two unit vectors that make a right-handed frame with unit normals, (..., 3) each.

    Source: Duff et al., Building an Orthonormal Basis, Revisited, JCGT 6(1), 2017.
    """
    x, y, z = np.moveaxis(normal, -1, 0)
    sign = np.copysign(1.0, z)
    a = -1.0 / (sign + z)
    b = x * y * a
    across = np.stack([1.0 + sign * x * x * a, sign * b, -sign * x], axis=-1)
    return across, np.stack([b, sign + y * y * a, -y], axis=-1)


def stratified(patches: Ints, side: int) -> Array:
    """Points of the unit disc, (k, side², 2): a random one in each of side² cells of equal area.

    The map from square to disc makes no cell long and thin.
    Source: Shirley & Chiu, A Low Distortion Map Between Disk and Square, JGT 2(3), 1997.
    """
    row, column = np.divmod(np.arange(side * side), side)
    places = (side * side, 2)
    jitter = np.stack([np.random.default_rng((SEED, int(i))).random(places) for i in patches])
    a, b = np.moveaxis(2.0 * (np.stack([column, row], axis=1) + jitter) / side - 1.0, -1, 0)
    wide = np.abs(a) > np.abs(b)
    radius, other = np.where(wide, a, b), np.where(wide, b, a)
    turn = np.pi / 4.0 * other / np.where(radius == 0.0, 1.0, radius)
    angle = np.where(wide, turn, np.pi / 2.0 - turn)
    return np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=-1)


def _rows(patches: Patches, chosen: Ints, occlusion: bool, side: int) -> Array:
    """The rows of a few patches, (k, N)."""
    count, size = len(chosen), len(patches)
    on_base = stratified(chosen, side)
    height = np.sqrt(np.maximum(1.0 - np.sum(on_base**2, axis=-1), 0.0))
    normal = patches.normal[chosen]
    axes = np.stack([*base(normal), normal], axis=1)
    local = np.concatenate([on_base, height[..., None]], axis=-1)
    direction = np.einsum("kra,kax->krx", local, axes).reshape(-1, 3)
    lift = lift_of(patches)
    origin = np.repeat(patches.centre[chosen] + lift * normal, side * side, axis=0)
    row = np.repeat(np.arange(count), side * side)
    hits = np.zeros(count * size, dtype=np.intp)
    tree, owner = _tree(patches)
    while len(row):
        t, triangle, _ = closest(tree, origin, direction, np.inf)
        met = np.flatnonzero(triangle >= 0)
        row, origin, direction, t = row[met], origin[met], direction[met], t[met]
        patch = owner[triangle[met]]
        cosine = dot(patches.normal[patch], direction)
        hits += np.bincount((row * size + patch)[cosine < 0.0], minlength=len(hits))
        if occlusion:
            break

        # On to what lies behind: beyond the plane that was met.
        beyond = np.copysign(lift, cosine)[:, None] * patches.normal[patch]
        origin = origin + t[:, None] * direction + beyond
    return hits.reshape(count, size) / side**2


_trees: weakref.WeakKeyDictionary[Patches, tuple[Bvh, Ints]] = weakref.WeakKeyDictionary()


def _tree(patches: Patches) -> tuple[Bvh, Ints]:
    """The tree of all patches, and whose its triangles are; made once."""
    found = _trees.get(patches)
    if found is None:
        triangles, owner = halves(patches.polygon)
        found = _trees[patches] = tree_of(triangles), owner
    return found
