"""False colours for numbers that a picture would hide.

Twin: shaders/lib/marks.glsl. A screen shows NaN as black, infinity as white, and cuts what
is negative or above 1; each gets a flat colour here instead. The colours can be told apart
with any colour vision (Okabe & Ito, Color Universal Design, 2008).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from playground.shading.floats import Array

KINDS = ("nan", "infinite", "negative", "denormal", "clamped")  # the first that applies shows
MEANING = {
    "nan": "not a number, as from 0/0",
    "infinite": "beyond the largest number",
    "negative": "below 0, cut there",
    "denormal": "so small that digits are lost",
    "clamped": "above 1 when exposed, cut there",
}
COLOURS = np.array(
    [(204, 121, 167), (240, 228, 66), (0, 114, 178), (0, 158, 115), (213, 94, 0)], dtype=np.uint8
)


def kinds_of(colour: ArrayLike, exposure: float, smallest: float) -> NDArray[np.bool_]:
    """Which `KINDS` each linear colour (..., 3) shows in any of its channels: (..., 5).

    Above 1 counts after ``exposure``, as the clamp does; everything else before.
    ``smallest`` is the smallest normal number: what is nearer to 0 is denormal.
    """
    colour = np.asarray(colour)
    with np.errstate(over="ignore", invalid="ignore"):
        channels = (
            np.isnan(colour),
            np.isinf(colour),
            colour < 0.0,
            (colour != 0.0) & (np.abs(colour) < smallest),
            colour * exposure > 1.0,
        )
    return np.stack([np.any(channel, axis=-1) for channel in channels], axis=-1)


def marked(
    shown: ArrayLike, colour: ArrayLike, exposure: float, smallest: float, wanted: int
) -> Array:
    """``shown`` (..., 3) in [0, 1], with false colours where linear ``colour`` is marked.

    Bit k of ``wanted`` asks for kind k of `KINDS`.
    """
    result = np.array(shown)
    found = kinds_of(colour, exposure, smallest)
    for k in reversed(range(len(KINDS))):
        if wanted >> k & 1:
            result[found[..., k]] = COLOURS[k] / 255.0
    return result
