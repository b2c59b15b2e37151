"""shaders/lib/lightmap.glsl against its float64 twin, on the same float32 texels.

u = 2⁻²⁴ is the rounding of float32; texels lie in [0, 1].
"""

import numpy as np
import pytest

from playground.render.gl import probe
from playground.shading import lightmap

pytestmark = pytest.mark.gl
U = 2.0**-24


def texels(rng, height=23, width=17):
    colour = rng.uniform(0.0, 1.0, (height, width, 3))
    covered = rng.uniform(0.0, 1.0, (height, width, 1)) < 0.3
    return np.concatenate([colour, covered], axis=-1).astype(np.float32)


def all_of(image):
    rows, columns = np.indices(image.shape[:2])
    return np.stack([columns, rows], axis=-1).reshape(-1, 2)


def test_dilated(gl, rng):
    image = texels(rng)
    got = probe.call("lightmap", "dilated", all_of(image), texels=image)
    want = lightmap.dilated(image, all_of(image))
    assert np.array_equal(got[:, 3], want[:, 3])
    assert np.abs(got - want).max() <= 8 * 8 * U  # seven sums of up to 8, and a quotient, over 8


def test_bleed(gl, rng):
    image = texels(rng)
    texcoord = rng.uniform(-1.0, 2.0, (5000, 2)).astype(np.float32)
    got = probe.call("lightmap", "bleed", texcoord, texels=image)
    want = lightmap.bleed(image, texcoord.astype(np.float64))
    # The fraction of u is exact but for 2 u, scaled by 23 texels; then six roundings.
    assert np.abs(got - want).max() <= 2 * 2 * 23 * U + 6 * U
