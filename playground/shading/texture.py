"""Looking up an image that gives m_d at every point of a surface.

Twin: shaders/lib/texture.glsl. The lookup is written out rather than left to the
texture unit, whose weights have 8 bits: 1/256 of the contrast between two texels.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from playground.shading.vector import Array


def bilinear(texels: NDArray[np.floating], texcoord: ArrayLike) -> Array:
    """Bilinear interpolation in a repeating image.

    Parameters
    ----------
    texels : (H, W, C) array
        Row 0 is at v = 0, the bottom of the picture. Texel (i, j) has its centre at
        u = (j + 1/2)/W, v = (i + 1/2)/H.
    texcoord : (..., 2) array
        u to the right, v up; the image repeats beyond [0, 1].

    Returns
    -------
    (..., C) array of float64.
        Source: OpenGL 4.6 core specification, section 8.14.2.
    """
    height, width = texels.shape[:2]
    texcoord = np.asarray(texcoord, dtype=np.float64)
    fraction = texcoord - np.floor(texcoord)
    x = fraction[..., 0] * width - 0.5
    y = fraction[..., 1] * height - 0.5
    left, bottom = np.floor(x), np.floor(y)
    tx, ty = (x - left)[..., None], (y - bottom)[..., None]
    j0, i0 = left.astype(np.int64) % width, bottom.astype(np.int64) % height
    j1, i1 = (j0 + 1) % width, (i0 + 1) % height
    low = texels[i0, j0] * (1.0 - tx) + texels[i0, j1] * tx
    high = texels[i1, j0] * (1.0 - tx) + texels[i1, j1] * tx
    return np.asarray(low * (1.0 - ty) + high * ty)
