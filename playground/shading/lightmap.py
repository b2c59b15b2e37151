"""The border of a chart in a lightmap: what bleeds in there, and what keeps it out.

Twin: shaders/lib/lightmap.glsl. ``texels`` are (H, W, 4): a colour, and 1 where a chart covers the
texel, else 0. Row 0 is at v = 0.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from playground.shading.texture import bilinear
from playground.shading.vector import Array

AROUND = [(x, y) for y in (-1, 0, 1) for x in (-1, 0, 1) if (x, y) != (0, 0)]


def dilated(texels: NDArray[np.floating], texel: ArrayLike) -> Array:
    """What one pass of dilation makes of texels: the mean of the covered ones around.

    A covered texel keeps its value; one with no covered neighbour among eight stays empty.
    Everything is read from the image before the pass: done in place, the result would depend
    on the order of the texels.

    Parameters
    ----------
    texels : (H, W, 4) array
    texel : (..., 2) array
        Column and row, whole numbers.

    Returns
    -------
    (..., 4) array of float64
    """
    height, width = texels.shape[:2]
    column, row = np.moveaxis(np.asarray(texel).astype(np.int64), -1, 0)
    own = np.asarray(texels[row, column], dtype=np.float64)
    total, count = np.zeros_like(own[..., :3]), np.zeros_like(own[..., 3])
    for x, y in AROUND:
        j, i = column + x, row + y
        inside = (j >= 0) & (j < width) & (i >= 0) & (i < height)
        near = texels[np.clip(i, 0, height - 1), np.clip(j, 0, width - 1)]
        covered = np.where(inside, near[..., 3], 0.0)
        total += np.where(covered[..., None] > 0.0, near[..., :3], 0.0)
        count += covered
    mean = total / np.maximum(count, 1.0)[..., None]
    spread = np.concatenate([mean, np.minimum(count, 1.0)[..., None]], axis=-1)
    return np.asarray(np.where(own[..., 3:] > 0.0, own, spread))


def bleed(texels: NDArray[np.floating], texcoord: ArrayLike) -> Array:
    """The share of a bilinear lookup that comes from texels that nothing covers, (...).

    At the border of a chart it is 1/2 without dilation, and 0 with one pass.
    """
    covered = bilinear(np.asarray(texels)[..., 3:], texcoord)[..., 0]
    return np.asarray(1.0 - covered)
