"""Unit vectors between two others."""

from __future__ import annotations

from math import pi

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
LEAST = 1e-3  # sine of an angle below which two directions count as one


def arc(a: Array, b: Array, count: int = 25) -> Array:
    """Unit vectors (count, 3) on the way from ``a`` to ``b``."""
    angle = float(np.arccos(np.clip(a @ b, -1.0, 1.0)))
    shares = np.linspace(0.0, 1.0, count)[:, None]
    if angle < LEAST or angle > pi - LEAST:
        return np.repeat(a[None], count, axis=0)
    mixed = np.sin((1.0 - shares) * angle) * a + np.sin(shares * angle) * b
    return np.asarray(mixed / np.sin(angle))
