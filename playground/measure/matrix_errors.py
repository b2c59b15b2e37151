"""How far rows of form factors are from the right ones, and what the right ones are."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from playground.measure.record import Errors
from playground.render.radiosity.factor.closed_form import ClosedForm
from playground.render.radiosity.factor.pairs import exact
from playground.render.radiosity.factor.visibility import facing
from playground.render.radiosity.patch.patches import Patches
from playground.shading.floats import Array

Ints = NDArray[np.intp]
SUM_OFF = "row sum off by"
# Points and rays per side of a patch of the converged rows: 31 in place of 23 rays
# change the rows of 2,376 patches by 0.01 %, those of 594 by 0.04 %. Far more must not be asked
# for: llvmpipe ends all loops of a pixel after 65,535 rounds, without a word.
POINTS, RAYS = 4, 23


def some_rows(patches: Patches, count: int) -> Ints:
    """About ``count`` patches, evenly spread over all of them: the rows that are judged."""
    return np.arange(0, len(patches), max(len(patches) // count, 1))


def row_errors(got: Array, want: Array, reference: str) -> Errors:
    """The errors of rows (k, N) of a closed scene.

    ``mean`` is the sum of all errors beside that of all form factors, ``rmse`` the root mean square
    of them beside that of the form factors, ``max`` the largest error of one.
    """
    off = np.abs(np.subtract(got, want, dtype=np.float64))
    return Errors(
        rmse=float(np.sqrt(np.sum(off**2) / np.sum(want**2))),
        max=float(off.max()),
        mean=float(off.sum() / want.sum()),
        reference=reference,
        more={SUM_OFF: float(np.abs(np.sum(got, axis=1, dtype=np.float64) - 1.0).max())},
    )


def exact_rows(patches: Patches, chosen: Ints) -> Array:
    """What polygons exchange by closed form, where nothing stands in between; (k, N)."""
    i, j = np.repeat(chosen, len(patches)), np.tile(np.arange(len(patches)), len(chosen))
    power = np.zeros(len(i))
    meet = np.flatnonzero(facing(patches, i, j))
    power[meet] = exact(patches, i[meet], j[meet])
    return power.reshape(len(chosen), -1) / patches.area[chosen, None]


def converged_rows(patches: Patches, chosen: Ints) -> Array:
    """Rows (k, N) by closed form and 23² segments for each pair: by brute force, on the GPU."""
    from playground.render.gl.context import headless
    from playground.render.gl.radiosity.pairs import GpuPairs

    gpu = GpuPairs(headless(), patches, points=POINTS, rays=RAYS, look=False)
    try:
        return ClosedForm(patches, gpu=gpu)(chosen)
    finally:
        gpu.release()
