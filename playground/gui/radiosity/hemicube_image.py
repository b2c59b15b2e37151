"""The hemicube of a patch laid flat, as an image: coloured, and with the pixels of one patch lit.

Arrays are (2N, 2N) with row 0 on top, as `hemicube_view.unfolded` lays the faces out.
"""

from __future__ import annotations

from colorsys import hsv_to_rgb
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from playground.explain.colour_map import colour_of
from playground.render.radiosity.factor.hemicube_view import delta_form_factors, unfolded
from playground.render.radiosity.patch.patches import Patches
from playground.shading.floats import Array

Ints = NDArray[np.int64]
Codes = NDArray[np.uint8]
FINE = 512  # pixels of the texture at least: ImGui mixes neighbours, which would hide aliasing
GOLDEN = 0.6180339887498949  # its multiples spread hues most evenly
NOTHING = (0.0, 0.0, 0.0)  # where no patch is seen
DIMMED = 0.6  # of the brightness is left to all others where a patch is marked
Marks = tuple[tuple[int, tuple[float, float, float]], ...]


@lru_cache(maxsize=4)
def places(resolution: int) -> Ints:
    """Which pixel of the item buffer stands where in the image; −1 in the four corners."""
    numbers = np.arange(3 * resolution * resolution).reshape(3 * resolution, resolution)
    return np.asarray(unfolded(numbers, -1.0)[::-1], dtype=np.int64)


def enlarged(codes: Codes) -> Codes:
    """Each pixel as a square of so many that the image has `FINE` rows or more."""
    times = -(-FINE // len(codes))
    return codes.repeat(times, axis=0).repeat(times, axis=1)


def laid_flat(column: NDArray[np.generic]) -> NDArray[np.generic]:
    """A picture (3N, N) of the faces as the image, 0 in the corners."""
    place = places(column.shape[1])
    return np.where(place < 0, column.dtype.type(0), column.ravel()[np.maximum(place, 0)])


@lru_cache(maxsize=4)
def own_colours(count: int) -> Array:
    """A colour (count, 3) for each patch, as codes in [0, 1]: neighbours differ much."""
    colours = [
        hsv_to_rgb((GOLDEN * k) % 1.0, 0.45 + 0.25 * (k % 3), 0.95 - 0.2 * (k // 3 % 3))
        for k in range(count)
    ]
    return np.array(colours)


def material_colours(patches: Patches) -> Array:
    """What each patch looks like in white light, (N, 3) linear."""
    return np.asarray(np.minimum(patches.reflectance + patches.emission, 1.0))


def image(items: NDArray[np.int32], of: Array | None, marks: Marks = ()) -> Codes:
    """The image as 8-bit codes (2N, 2N, 4).

    ``of`` (M, 3) are the colours of the patches as codes in [0, 1]; without them each pixel shows
    its delta form factor. ``marks`` are patches and their colours there, the last wins.
    """
    resolution = items.shape[1]
    seen = np.asarray(laid_flat(items), dtype=np.int64)
    if of is None:
        deltas = delta_form_factors(resolution)
        colours = colour_of(np.asarray(laid_flat(deltas)) / deltas.max())
    else:
        colours = np.vstack([NOTHING, of])[seen]
    marked = np.isin(seen, [patch + 1 for patch, _ in marks])
    if marked.any():
        colours = DIMMED * colours
    for patch, colour in marks:
        colours[seen == patch + 1] = colour
    alpha = (places(resolution) >= 0)[..., None]
    codes = np.concatenate([colours, alpha], axis=-1) * 255.0 + 0.5
    return np.asarray(codes, dtype=np.uint8)


def pixel_at(items: NDArray[np.int32], right: float, down: float) -> tuple[int, float] | None:
    """The patch (−1 for none) and delta form factor at shares of the image; None in a corner."""
    size = 2 * items.shape[1]
    place = places(items.shape[1])
    row, column = (min(max(int(share * size), 0), size - 1) for share in (down, right))
    number = int(place[row, column])
    if number < 0:
        return None
    return int(items.ravel()[number]) - 1, float(delta_form_factors(items.shape[1]).ravel()[number])


def summed(items: NDArray[np.int32], patch: int) -> tuple[int, float]:
    """How many pixels show a patch, and the sum of their delta form factors: F of it."""
    shown = items == patch + 1
    return int(np.count_nonzero(shown)), float(delta_form_factors(items.shape[1])[shown].sum())


def row_sum(items: NDArray[np.int32]) -> float:
    """The sum over all patches: 1 in a closed scene."""
    return float(delta_form_factors(items.shape[1])[items > 0].sum())
