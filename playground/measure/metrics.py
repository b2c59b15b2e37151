"""How far two pictures are apart: RMSE, maximum, PSNR, SSIM, FLIP.

All take two pictures, arrays (H, W, 3) of any one unit of colours, and reduce in float64.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

SSIM_SIGMA, SSIM_RADIUS = 1.5, 5  # an 11 x 11 Gaussian window: Wang et al. 2004
SSIM_K1, SSIM_K2 = 0.01, 0.03
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])  # ITU-R BT.709


def rmse(a: ArrayLike, b: ArrayLike) -> float:
    """Root of the mean squared difference over all components, in the unit of the pictures."""
    difference = np.subtract(a, b, dtype=np.float64)
    return float(np.sqrt(np.mean(difference * difference)))


def largest(a: ArrayLike, b: ArrayLike) -> float:
    """The largest absolute difference of any component, in the unit of the pictures."""
    return float(np.max(np.abs(np.subtract(a, b, dtype=np.float64))))


def psnr(a: ArrayLike, b: ArrayLike) -> float:
    """Peak signal-to-noise ratio in dB for a peak of 1; infinite for equal pictures."""
    error = rmse(a, b)
    return float("inf") if error == 0.0 else -20.0 * float(np.log10(error))


def ssim(a: ArrayLike, b: ArrayLike) -> float:
    """Mean structural similarity of luminance in [0, 1]: 1 for equal pictures.

    Source: Wang, Bovik, Sheikh & Simoncelli, Image Quality Assessment: From Error
    Visibility to Structural Similarity, 2004, equation 13, with the Gaussian window and
    the constants given there; windows that leave the picture are not counted, and a picture
    smaller than the window is one window.
    """
    x, y = np.asarray(a, np.float64) @ LUMINANCE, np.asarray(b, np.float64) @ LUMINANCE
    mean_x, mean_y = _windows(x), _windows(y)
    var_x = _windows(x * x) - mean_x**2
    var_y = _windows(y * y) - mean_y**2
    covariance = _windows(x * y) - mean_x * mean_y
    c1, c2 = SSIM_K1**2, SSIM_K2**2
    similarity = (2 * mean_x * mean_y + c1) * (2 * covariance + c2)
    similarity /= (mean_x**2 + mean_y**2 + c1) * (var_x + var_y + c2)
    return float(np.mean(similarity))


def flip_map(a: ArrayLike, b: ArrayLike) -> Array:
    """The FLIP error map, (H, W), of two pictures as shown on a screen, (H, W, 3) in [0, 1].

    What a viewer notices when the two alternate: 0 for nothing, 1 for black and white.
    Computed by the authors' own library at their default viewing distance.
    Source: Andersson et al., FLIP: A Difference Evaluator for Alternating Images, 2020.
    """
    import flip_evaluator

    reference = np.ascontiguousarray(a, dtype=np.float32)
    test = np.ascontiguousarray(b, dtype=np.float32)
    error, _, _ = flip_evaluator.evaluate(
        reference, test, "LDR", inputsRGB=True, applyMagma=False, computeMeanError=False
    )
    return np.asarray(error, dtype=np.float64).reshape(reference.shape[:2])


def _windows(values: Array) -> Array:
    """The Gaussian-weighted mean of every window, separably along rows and columns."""
    for axis in (0, 1):
        radius = min(SSIM_RADIUS, (values.shape[axis] - 1) // 2)
        offsets = np.arange(-radius, radius + 1)
        kernel = np.exp(-0.5 * (offsets / SSIM_SIGMA) ** 2)
        kernel /= kernel.sum()
        view = np.lib.stride_tricks.sliding_window_view(values, len(kernel), axis=axis)
        values = view @ kernel
    return values
