"""Pictures that NumPy traces beside the window: without a tracer on the GPU, and of its effort."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from playground.explain.colour_map import colour_of
from playground.explain.ray_tests import CENTRE, tests_of
from playground.gui.work.long_work import Piece, Pieces
from playground.render.shown import shown_colour
from playground.render.trace.traced_scene import prepare
from playground.render.trace.tracer import Tracing
from playground.scene.setup import Setup
from playground.shading.display import code8

Codes = NDArray[np.uint8]
Size = tuple[int, int]
BLOCK = 2**14  # pixels of a piece
MOST = 1000  # tests of one ray that are yellow; 1 is violet, between them a logarithmic scale
ALMOST = 0.999  # done, while the picture itself is not there


def traced_codes(setup: Setup, size: Size) -> Pieces[Codes]:
    """The 8-bit codes (H, W, 4) of the ray traced picture in float64, the only item."""
    tracing = Tracing(setup, size)
    for share in tracing.steps():
        yield Piece(min(share, ALMOST))
    codes = np.full((size[1], size[0], 4), 255, dtype=np.uint8)
    codes[..., :3] = code8(shown_colour(tracing.image().pixels, setup.settings))
    yield Piece(1.0, codes)


def effort_codes(setup: Setup, size: Size) -> Pieces[Codes]:
    """How many tests the ray through each pixel takes, as codes (H, W, 4), the only item."""
    scene, pixels = prepare(setup, size), size[0] * size[1]
    counts = np.zeros(pixels, dtype=np.int64)
    for start in range(0, pixels, BLOCK):
        chosen = np.arange(start, min(start + BLOCK, pixels))
        counts[chosen] = tests_of(scene, *scene.camera_rays(chosen, CENTRE))
        yield Piece(min(float(chosen[-1] + 1) / pixels, ALMOST))
    yield Piece(1.0, painted(counts.reshape(size[1], size[0])))


def painted(counts: NDArray[np.int64]) -> Codes:
    """The colours of numbers of tests (H, W), as codes (H, W, 4): black for none."""
    codes = np.full((*counts.shape, 4), 255, dtype=np.uint8)
    codes[..., :3] = np.round(255.0 * colour_of(np.log(np.maximum(counts, 1)) / np.log(MOST)))
    codes[counts == 0] = (0, 0, 0, 255)
    return codes
