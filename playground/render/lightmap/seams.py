"""Edges that the atlas cuts: both sides are made to show the same light along them.

A seam is an edge of two triangles that lie apart in the atlas while the surface goes on smoothly.
Each side is looked up among its own texels, so their light jumps there, a little. The texels
around are changed by as little as possible so that it does not: a least-squares problem over
samples along all seams.
Source: Iwanicki, Lighting Technology of The Last of Us, SIGGRAPH 2013 Talks.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from playground.render.lightmap.atlas import Atlas
from playground.render.lightmap.texels import placed
from playground.scene.scene import Scene
from playground.shading.floats import Array

Ints = NDArray[np.int64]
SAME_PLACE = 2.0**-20  # of the size of the scene: corners this near are one
SMOOTH = 0.9998  # cosine between normals that count as one, 1.1°
MOST_AT_AN_EDGE = 4  # triangles
PER_TEXEL = 3  # samples of a seam
STIFF = 0.02  # weight of a texel's own light against a sample of the jump
STEPS = 200  # of the conjugate gradients, at most
ENOUGH = 1e-6  # share of the residual that is left when they stop


@dataclass(frozen=True, eq=False)
class Seams:
    """S samples along seams: on either side the four texels of a lookup, and their weights.

    ``texel`` (S, 2, 4): row · size + column; ``weight`` (S, 2, 4): sums to 1 on each side.
    """

    texel: Ints
    weight: Array

    def jump(self, image: Array) -> Array:
        """How far apart the two sides are in an image (H, W, C), at each sample, (S, C)."""
        return _jump(image.reshape(-1, image.shape[2]), self.texel, self.weight)


def find_seams(scene: Scene, atlas: Atlas) -> Seams:
    """All seams of the scene in ``atlas``, within objects and between them."""
    places, normals, texcoords = _edges(scene, atlas)
    key = np.sort(_welded(places), axis=1)
    flip = _welded(places)[:, 0] != key[:, 0]
    ends = np.where(flip[:, None], [1, 0], [0, 1])
    rows = np.arange(len(key))[:, None]
    normals, texcoords = normals[rows, ends], texcoords[rows, ends] * atlas.size
    order = np.lexsort((key[:, 1], key[:, 0]))
    key, normals, texcoords = key[order], normals[order], texcoords[order]

    pairs = []
    for apart in range(1, MOST_AT_AN_EDGE):
        first, second = slice(None, -apart or None), slice(apart, None)
        alike = (key[first] == key[second]).all(axis=1) & (key[first, 0] != key[first, 1])
        smooth = np.einsum("nei,nei->ne", normals[first], normals[second]) > SMOOTH
        cut = np.abs(texcoords[first] - texcoords[second]).max(axis=(1, 2)) > 1e-3
        at = np.flatnonzero(alike & smooth.all(axis=1) & cut)
        pairs.append(np.stack([texcoords[at], texcoords[at + apart]], axis=1))
    return _sampled(np.concatenate(pairs), atlas.size)


def sewn(image: Array, seams: Seams) -> Array:
    """The image (H, W, C) with texels at seams changed so that both sides agree.

    Minimises Σ jump² + STIFF Σ change² by conjugate gradients: where there is no jump, nothing
    changes. Light stays 0 or more.
    """
    if len(seams.texel) == 0:
        return image
    own, index = np.unique(seams.texel, return_inverse=True)
    texel = index.reshape(seams.texel.shape)
    values = image.reshape(-1, image.shape[2])[own]
    weight = seams.weight * np.array([1.0, -1.0])[:, None]

    def spread(jump: Array) -> Array:
        """How each texel takes part in the jumps: the transpose of `_jump`."""
        shares = weight[..., None] * jump[:, None, None]
        flat, count = texel.ravel(), len(own)
        columns = [
            np.bincount(flat, shares[..., c].ravel(), minlength=count) for c in range(jump.shape[1])
        ]
        return np.stack(columns, axis=1)

    change = np.zeros_like(values)
    residual = -spread(_jump(values, texel, seams.weight))
    direction, size = residual, np.sum(residual**2, axis=0)
    goal = ENOUGH**2 * size
    for _ in range(STEPS):
        if (size <= goal).all():
            break
        turned = spread(_jump(direction, texel, seams.weight)) + STIFF * direction
        slope = np.sum(direction * turned, axis=0)
        step = size / np.where(slope > 0.0, slope, np.inf)
        change, residual = change + step * direction, residual - step * turned
        before, size = size, np.sum(residual**2, axis=0)
        direction = residual + size / np.where(before > 0.0, before, np.inf) * direction
    result = image.reshape(-1, image.shape[2]).copy()
    result[own] = np.maximum(values + change, 0.0)
    return result.reshape(image.shape)


def _jump(values: Array, texel: Ints, weight: Array) -> Array:
    sides = np.einsum("sek,sekc->sec", weight, values[texel])
    return np.asarray(sides[:, 0] - sides[:, 1])


def _edges(scene: Scene, atlas: Atlas) -> tuple[Array, Array, Array]:
    """Places (E, 2, 3), unit normals (E, 2, 3) and texcoords (E, 2, 2) of all triangle edges."""
    columns: list[tuple[Array, Array, Array]] = []
    for item, part in zip(scene.objects, atlas.parts, strict=True):
        if part is None:
            continue
        places, normals = placed(item, np.zeros(3))
        kept = part.faces[(part.charts[part.faces] >= 0).all(axis=1)]
        ends = np.stack([kept, np.roll(kept, -1, axis=1)], axis=2).reshape(-1, 2)
        whole = part.vertices[ends]
        columns.append((places[whole], normals[whole], part.texcoords[ends].astype(np.float64)))
    places, normals, texcoords = (np.concatenate(x) for x in zip(*columns, strict=True))
    return places, normals, texcoords


def _welded(places: Array) -> Ints:
    """A number for each place of (E, 2, 3), the same for places that are one; (E, 2)."""
    low = places.min(axis=(0, 1))
    size = float((places.max(axis=(0, 1)) - low).max())
    cells = np.round((places - low) / (size * SAME_PLACE)).astype(np.int64).reshape(-1, 3)
    single = (cells[:, 0] << 42) | (cells[:, 1] << 21) | cells[:, 2]
    return np.unique(single, return_inverse=True)[1].reshape(places.shape[:2])


def _sampled(ends: Array, size: int) -> Seams:
    """Samples along seams whose sides run between ``ends`` (P, 2, 2, 2), in texels."""
    length = np.linalg.norm(ends[:, :, 1] - ends[:, :, 0], axis=2).max(axis=1)
    count = np.ceil(PER_TEXEL * length).astype(np.int64) + 1
    seam = np.repeat(np.arange(len(ends)), count)
    place = np.arange(len(seam)) - np.repeat(np.cumsum(count) - count, count)
    share = (place / np.maximum(count - 1, 1)[seam])[:, None, None]
    at = ends[seam, :, 0] * (1.0 - share) + ends[seam, :, 1] * share - 0.5
    corner = np.floor(at)
    t = at - corner
    column = corner[..., 0, None].astype(np.int64) + np.array([0, 1, 0, 1])
    row = corner[..., 1, None].astype(np.int64) + np.array([0, 0, 1, 1])
    u = np.stack([1.0 - t[..., 0], t[..., 0]] * 2, axis=-1)
    v = np.stack([1.0 - t[..., 1]] * 2 + [t[..., 1]] * 2, axis=-1)
    return Seams((row % size) * size + column % size, u * v)
