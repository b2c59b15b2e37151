"""In which arithmetic a setup is shaded, and what that leaves of its numbers.

Only the shading changes: positions (relative to the eye), normals, colours and lights are
rounded to the precision, and every operation on them after that. Matrices, coverage, depth,
interpolation, texture addresses and the display stay what they are.
"""

from __future__ import annotations

from contextlib import AbstractContextManager
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, DTypeLike

from playground.render.view import FARTHEST
from playground.scene.settings import Settings
from playground.shading.floats import Array

_TYPES = {
    "native": np.float64,
    "float16": np.float16,
    "float32": np.float32,
    "float64": np.float64,
}
FARTHEST_HALF = 2.0**14  # scene sizes from where light is parallel to 14 bits; float16 has 11


def number_type(settings: Settings) -> np.dtype[Any]:
    """The type in which NumPy shades; its own is float64."""
    return np.dtype(_TYPES[settings.precision])


def on_gpu(settings: Settings) -> str:
    """What the GPU makes of a precision: its own is float32, so that this is ``native``."""
    return "native" if settings.precision == "float32" else settings.precision


def to_type(values: ArrayLike, dtype: DTypeLike) -> Array:
    """The values (...) rounded to a type; beyond its range infinite, below it zero."""
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        return np.asarray(values).astype(dtype, copy=False)


def farthest(dtype: DTypeLike) -> float:
    """How far from the eye a light may stand, in eye-relative units, to count where it is."""
    return FARTHEST_HALF if dtype == np.float16 else FARTHEST


def arithmetic(dtype: np.dtype[Any]) -> AbstractContextManager[None]:
    """What computing in a type means for NumPy's warnings: small types overflow, as they must."""
    if dtype == np.float64:
        return np.errstate()
    return np.errstate(over="ignore", under="ignore", invalid="ignore", divide="ignore")


def smallest_normal(settings: Settings) -> float:
    """Below this a number is denormal: in float16, or in the float32 of the picture."""
    kind = np.float16 if settings.precision == "float16" else np.float32
    return float(np.finfo(kind).tiny)
