"""The picture of the NumPy renderer piece by piece: it can be shown how far it is, and stopped."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from playground.gui.work.long_work import Piece, Pieces
from playground.render.numpy_renderer import (
    colours_before,
    pixel_colours,
    sample_offsets,
    visibility,
)
from playground.render.surface import surfaces
from playground.render.view import view_of
from playground.scene.setup import Setup

BLOCK = 2**14  # pixels of a piece
SEEING = 0.5  # of the work is to find out what each pixel sees, about


def pieces(setup: Setup, size: tuple[int, int]) -> Pieces[NDArray[np.float32]]:
    """Linear colours (H, W, 3), float32, the only item, as of `NumpyRenderer.render`.

    In float64 whatever the precision of ``setup``, which is what others are compared with.
    """
    setup = setup.with_(precision="native")
    everything = surfaces(setup.scene, setup.settings.weights)
    view = view_of(setup.camera, everything, size)
    offsets = sample_offsets(setup.settings.samples)
    colour = np.zeros((size[1], size[0], 3))
    for done, offset in enumerate(offsets):
        yield Piece(done / len(offsets))
        frame = visibility(everything, view, size, offset)
        sample = np.empty_like(colour)
        sample[...] = setup.scene.background
        shaded, pixels = 0, max(int(np.count_nonzero(frame.object >= 0)), 1)
        for number, surface in enumerate(everything):
            rows, columns = np.nonzero(frame.object == number)
            before = colours_before(surface, view, setup.settings)
            for start in range(0, len(rows), BLOCK):
                share = SEEING + (1.0 - SEEING) * shaded / pixels
                yield Piece((done + share) / len(offsets))
                at = rows[start : start + BLOCK], columns[start : start + BLOCK]
                sample[at] = pixel_colours(surface, view, setup.settings, frame, at, before)
                shaded += len(at[0])
        colour += sample / len(offsets)
    yield Piece(1.0, colour.astype(np.float32))
