"""The same questions as `walk`, answered by Intel's Embree: several times faster on a CPU.

Optional: it needs the package ``embreex``. Embree finds the triangle in float32; how far away it
is and where on it the hit lies are then computed in float64, so pictures differ from those of
`walk` only where two triangles are within `NEAREST` of each other along a ray, or where a ray
passes a silhouette within a rounding of float32.
"""

from __future__ import annotations

import os
import weakref
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from playground.errors import PlaygroundError
from playground.render.trace import walk
from playground.render.trace.bvh import Bvh
from playground.shading.ray import NO_HIT
from playground.shading.vector import cross, dot

Ints = NDArray[np.int64]
Floats = NDArray[np.float64]

# Rounded to float32, a ray may start a few roundings of its coordinates beyond the surface that it
# leaves. So it starts farther along by this share of the largest coordinate; the few that still
# meet what they left, at a grazing angle, are recognised by their t in float64.
NEAREST = 32.0 * float(np.finfo(np.float32).eps)
FARTHEST = 1e38  # a t that float32 can hold
PART = 2**15  # rays that a thread takes at a time: what is computed of them fits into its cache

_scenes: weakref.WeakKeyDictionary[Bvh, Any] = weakref.WeakKeyDictionary()


def check_embree() -> None:
    """Raise an error that says how to install Embree if it is not there."""
    try:
        import embreex  # noqa: F401
    except ImportError as error:
        raise PlaygroundError(
            "the renderer embree needs a package that is not installed",
            got=str(error),
            allowed="auto, gl or numpy without it",
            fix="Install it: pip install embreex",
        ) from None


def closest(
    bvh: Bvh, origin: ArrayLike, direction: ArrayLike, limit: ArrayLike
) -> tuple[Floats, Ints, Floats]:
    """The first triangle along each ray; arguments and results as `walk.closest`."""
    start, along, reach = _rays(origin, direction, limit)
    slot, t, weights = _meet(bvh, start, along, reach)
    wrong = np.flatnonzero((slot >= 0) & ~((t > 0.0) & (t < reach)))
    number = np.append(bvh.order, -1)[slot].astype(np.int64)
    if len(wrong):
        again = walk.closest(bvh, start[wrong], along[wrong], reach[wrong])
        t[wrong], number[wrong], weights[wrong] = again
    return t, number, weights


def blocked(
    bvh: Bvh, origin: ArrayLike, direction: ArrayLike, limit: ArrayLike
) -> NDArray[np.bool_]:
    """Whether each ray meets any triangle with 0 < t < limit, (N,); arguments as `closest`."""
    return np.asarray(closest(bvh, origin, direction, limit)[1] >= 0)


def _rays(origin: ArrayLike, direction: ArrayLike, limit: ArrayLike) -> tuple[Floats, ...]:
    start = np.asarray(origin, dtype=np.float64).reshape(-1, 3)
    along = np.asarray(direction, dtype=np.float64).reshape(-1, 3)
    reach = np.broadcast_to(np.asarray(limit, dtype=np.float64), len(start))
    return start, along, reach


def _meet(
    bvh: Bvh, start: Floats, along: Floats, reach: Floats
) -> tuple[NDArray[np.int32], Floats, Floats]:
    """What Embree finds: the slot (N,), −1 for none; t (N,) and weights (N, 3) in float64."""
    if bvh.nodes == 0 or len(start) == 0:
        none = np.full(len(start), -1, dtype=np.int32)
        return none, np.full(len(start), NO_HIT), np.zeros((len(start), 3))
    scene = _scene(bvh)
    count = -(-len(start) // PART)
    if count == 1:
        return _meet_part(scene, bvh, start, along, reach)
    given = [np.array_split(rays, count) for rays in (start, along, reach)]
    with ThreadPoolExecutor(os.cpu_count()) as threads:  # Embree and NumPy let others run
        found = list(threads.map(lambda *part: _meet_part(scene, bvh, *part), *given))
    slot, t, weights = (np.concatenate(parts) for parts in zip(*found, strict=True))
    return slot, t, weights


def _meet_part(
    scene: Any, bvh: Bvh, start: Floats, along: Floats, reach: Floats
) -> tuple[NDArray[np.int32], Floats, Floats]:
    """`_meet` for as many rays as one thread takes."""
    largest = max(float(np.abs(bvh.low[0]).max()), float(np.abs(bvh.high[0]).max()))
    size = np.maximum(np.abs(start).max(axis=1), largest)
    later = NEAREST * size / np.abs(along).max(axis=1)
    ahead = (start + later[:, None] * along).astype(np.float32)
    far = np.clip(reach - later, 0.0, FARTHEST)
    far = np.nextafter(far.astype(np.float32), np.float32(np.inf))
    found = scene.run(ahead, along.astype(np.float32), dists=far, output=True)
    slot = np.asarray(found["primID"], dtype=np.int32)
    met = np.flatnonzero(slot >= 0)
    t, weights = np.full(len(start), NO_HIT), np.zeros((len(start), 3))
    t[met], weights[met] = _on_plane(bvh.corners[slot[met]], start[met], along[met])
    return slot, t, weights


def _scene(bvh: Bvh) -> Any:
    """Embree's own tree over the triangles, by slot; built once."""
    if bvh not in _scenes:
        from embreex.mesh_construction import TriangleMesh
        from embreex.rtcore_scene import EmbreeScene

        scene = EmbreeScene()
        TriangleMesh(scene, np.ascontiguousarray(bvh.corners, dtype=np.float32))
        _scenes[bvh] = scene
    return _scenes[bvh]


def _on_plane(corners: NDArray[Any], start: Floats, along: Floats) -> tuple[Floats, Floats]:
    """Where rays meet the planes of triangles (M, 3, 3): t (M,) and weights (M, 3).

    Source: Möller & Trumbore, Fast, Minimum Storage Ray/Triangle Intersection, 1997; which side
    of an edge the ray passes has been decided before.
    """
    a, b, c = np.moveaxis(corners.astype(np.float64), 1, 0)
    u, v, seen = b - a, c - a, start - a
    across, turned = cross(along, v), cross(seen, u)
    whole = dot(u, across)
    scale = 1.0 / np.where(whole == 0.0, np.inf, whole)
    second, third = dot(seen, across) * scale, dot(along, turned) * scale
    weights = np.clip(np.stack([1.0 - second - third, second, third], axis=-1), 0.0, 1.0)
    return dot(v, turned) * scale, weights
