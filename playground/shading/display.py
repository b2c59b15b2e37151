"""From linear light to the 8-bit codes of a screen: expose, clamp, curve, quantise.

Twin: shaders/lib/display.glsl. Steps of the display, never of the lighting: colours
stay linear and unclamped until here.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from playground.shading.vector import Array


def clamp_colour(colour: ArrayLike) -> Array:
    """Cut every component at 0 and 1."""
    return np.clip(np.asarray(colour, dtype=np.float64), 0.0, 1.0)


def wrap_colour(colour: ArrayLike) -> Array:
    """What an 8-bit counter shows of a value that nobody clamped: code modulo 256, over 255."""
    codes = np.floor(np.asarray(colour, dtype=np.float64) * 255.0 + 0.5)
    return np.asarray(np.mod(codes, 256.0) / 255.0)


def srgb_encode(linear: ArrayLike) -> Array:
    """The sRGB transfer curve, linear to encoded; negative values count as 0.

    12.92 x up to 0.0031308, else 1.055 x^(1/2.4) − 0.055. Source: IEC 61966-2-1:1999.
    """
    x = np.maximum(np.asarray(linear, dtype=np.float64), 0.0)
    return np.asarray(np.where(x <= 0.0031308, 12.92 * x, 1.055 * np.power(x, 1.0 / 2.4) - 0.055))


def srgb_decode(encoded: ArrayLike) -> Array:
    """The inverse of `srgb_encode`. Source: IEC 61966-2-1:1999."""
    x = np.maximum(np.asarray(encoded, dtype=np.float64), 0.0)
    return np.asarray(np.where(x <= 0.04045, x / 12.92, np.power((x + 0.055) / 1.055, 2.4)))


def display_colour(
    colour: ArrayLike, exposure: float = 1.0, clamp: bool = True, curve: str = "none"
) -> Array:
    """All steps but the last: what is shown, in [0, 1], for linear ``colour`` (..., 3)."""
    with np.errstate(over="ignore", invalid="ignore"):  # of infinity, and of NaN
        shown = np.asarray(colour, dtype=np.float64) * exposure
        if clamp:
            shown = clamp_colour(shown)
        if curve == "srgb":
            shown = srgb_encode(shown)
        return shown if clamp else wrap_colour(shown)


def code8(shown: ArrayLike) -> NDArray[np.uint8]:
    """The 8-bit code of a value in [0, 1]: floor(255 s + 1/2); 0 for NaN, as on a GPU.

    Source: OpenGL 4.6 core specification, section 2.3.5.2.
    """
    number = np.fmax(np.asarray(shown, dtype=np.float64), 0.0)
    return np.floor(number * 255.0 + 0.5).astype(np.uint8)
