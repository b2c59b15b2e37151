"""What every renderer refuses: no setup, an impossible size, an array that does not fit."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from playground.errors import PlaygroundError, unknown_name
from playground.scene.setup import Setup

METHODS = ("raster", "ray-tracing", "radiosity", "lightmap")
LARGEST_SIDE = 32768


def check_setup(setup: Any) -> None:
    """Raise an error for something that is no setup."""
    if not isinstance(setup, Setup):
        raise PlaygroundError(
            "what is rendered is a setup",
            got=type(setup).__name__,
            fix='Make one with load("teapot").',
        )


def check_method(method: str) -> None:
    """Raise an error for a method that is unknown."""
    if method not in METHODS:
        raise unknown_name("method", method, METHODS)


def check_size(size: Any) -> tuple[int, int]:
    """Width and height as whole numbers from 1 to 32768, or an error."""
    try:
        width, height = (int(side) for side in size)
        whole = (width, height) == tuple(size)
    except (TypeError, ValueError, OverflowError):
        whole = False
    if not whole or not (1 <= width <= LARGEST_SIDE and 1 <= height <= LARGEST_SIDE):
        raise PlaygroundError(
            "the size of a picture is (width, height) in pixels",
            got=size,
            allowed=f"whole numbers from 1 to {LARGEST_SIDE}",
        )
    return width, height


def check_out(out: NDArray[Any], size: tuple[int, int]) -> None:
    """Raise a `PlaygroundError` unless ``out`` can take a picture of ``size``, (width, height).

    It must be (H, W, 4) uint8, or (H, W, 3 or 4) float32, and writeable.
    """
    width, height = size
    good = (
        isinstance(out, np.ndarray)
        and out.shape[:2] == (height, width)
        and out.ndim == 3
        and (
            (out.dtype == np.uint8 and out.shape[2] == 4)
            or (out.dtype == np.float32 and out.shape[2] in (3, 4))
        )
        and out.flags.writeable
    )
    if not good:
        raise PlaygroundError(
            "this array cannot take the picture",
            got=f"{getattr(out, 'dtype', type(out).__name__)} {getattr(out, 'shape', '')}",
            allowed=f"uint8 ({height}, {width}, 4), or float32 ({height}, {width}, 3 or 4)",
        )
