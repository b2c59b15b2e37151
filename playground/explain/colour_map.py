"""A colour-blind-safe scale from 0 to 1: dark violet through green to yellow."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

# viridis at 0, 1/8, ..., 1, sRGB. Source: Smith & van der Walt, matplotlib 2015 (CC0).
VIRIDIS = np.array(
    [
        (0.267, 0.005, 0.329),
        (0.282, 0.141, 0.458),
        (0.254, 0.265, 0.530),
        (0.207, 0.372, 0.553),
        (0.128, 0.567, 0.551),
        (0.135, 0.659, 0.518),
        (0.369, 0.789, 0.383),
        (0.678, 0.864, 0.190),
        (0.993, 0.906, 0.144),
    ]
)


def colour_of(value: ArrayLike) -> NDArray[np.float64]:
    """Colours (..., 3) in [0, 1] for values (...); those outside [0, 1] are cut."""
    stops = np.linspace(0.0, 1.0, len(VIRIDIS))
    value = np.clip(np.asarray(value, dtype=np.float64), 0.0, 1.0)
    return np.stack([np.interp(value, stops, VIRIDIS[:, i]) for i in range(3)], axis=-1)
