"""Rows of form factors by closed form and rays; each pair is computed once.

A_i F_ij is the same from either side: what earlier rows have told is not computed again, which
halves the work for all rows.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from playground.render.radiosity.factor.pairs import by_size, exact, exchange, near
from playground.render.radiosity.factor.visibility import facing
from playground.render.radiosity.patch.patches import Patches
from playground.shading.floats import Array

Ints = NDArray[np.intp]
# Rows (k,) and columns (c,) -> A_i F_ij as if all were far, and the visible shares, (k, c) each.
Pairs = Callable[[Ints, Ints], tuple[NDArray[Any], NDArray[Any]]]

PAIRS = 200_000  # at a time
MOST_BYTES = 2**29  # for what is kept: the rows of 11,585 patches in float32


class ClosedForm:
    """Rows F_ij of the chosen patches, (k, N), whenever it is called.

    Parameters
    ----------
    occlusion : bool
        Whether patches hide one another.
    points, rays : int
        Per side of a patch, see `pairs`: with 3 and 5 the whole matrix of a room with blocks is
        off by 0.4 % at 594 patches and by 0.2 % at 2,376 (the sum of all errors over that of all
        factors), nearly all of it in half-shadows; with 17 segments per side by 0.1 %.
    gpu : function, optional
        What computes far pairs and shares in place of NumPy: `gl.radiosity.pairs.GpuPairs`.
    """

    def __init__(
        self,
        patches: Patches,
        occlusion: bool = True,
        points: int = 3,
        rays: int = 5,
        gpu: Pairs | None = None,
    ) -> None:
        self._patches, self._gpu = patches, gpu
        self._knobs = occlusion, points, rays
        size = len(patches)
        self._dtype = np.float64 if gpu is None else np.float32
        keeps = size * size * np.dtype(self._dtype).itemsize <= MOST_BYTES
        # A column for each row that is known, in the order in which they came: what these know of
        # a patch lies side by side, and a search through all of memory is saved.
        self._kept = np.empty((size, size) if keeps else (0, 0), dtype=self._dtype)
        self._slot = np.full(size, -1, dtype=np.intp)  # which column holds the row of a patch
        self._patch = np.empty(size, dtype=np.intp)  # whose row is in a column
        self._count = 0

    def __call__(self, chosen: ArrayLike) -> Array:
        """The rows of the chosen patches, (k, N)."""
        wanted = np.asarray(chosen, dtype=np.intp).reshape(-1)
        rows = np.empty((len(wanted), len(self._patches)), dtype=self._dtype)
        step = max(PAIRS // len(self._patches), 1)
        for first in range(0, len(wanted), step):
            part = wanted[first : first + step]
            rows[first : first + step] = self._powers(part) / self._patches.area[part, None]
        return rows

    def _powers(self, chosen: Ints) -> Array:
        """A_i F_ij, (k, N): from the rows that are known, and what is missing."""
        if not self._kept.size:
            return self._compute(chosen, np.arange(len(self._patches)))
        fresh = np.unique(chosen[self._slot[chosen] < 0])
        if len(fresh):
            self._learn(fresh)
        return np.asarray(self._kept[:, self._slot[chosen]].T)

    def _learn(self, fresh: Ints) -> None:
        """Compute and keep rows that are not known."""
        known, missing = self._patch[: self._count], np.flatnonzero(self._slot < 0)
        columns = slice(self._count, self._count + len(fresh))
        powers = np.empty((len(fresh), len(self._slot)), dtype=self._dtype)
        powers[:, known] = self._kept[fresh, : self._count]
        powers[:, missing] = self._compute(fresh, missing)
        self._kept[:, columns] = powers.T
        self._slot[fresh], self._patch[columns] = np.arange(columns.start, columns.stop), fresh
        self._count = columns.stop

    def _compute(self, rows: Ints, columns: Ints) -> Array:
        """A_i F_ij of rows and columns, (k, c)."""
        if self._gpu is None:
            i, j = (x.ravel() for x in np.meshgrid(rows, columns, indexing="ij"))
            return exchange(self._patches, i, j, *self._knobs).reshape(len(rows), len(columns))
        powers, share = self._gpu(rows, columns)
        row, column = np.nonzero(near(self._patches, rows[:, None], columns))
        seen = facing(self._patches, rows[row], columns[column]) & (share[row, column] > 0.0)
        powers[row, column] = 0.0
        row, column = row[seen], column[seen]
        pairs = by_size(self._patches, rows[row], columns[column])
        powers[row, column] = share[row, column] * exact(self._patches, *pairs)
        return powers


def closed_form(
    patches: Patches, chosen: ArrayLike, occlusion: bool = True, points: int = 3, rays: int = 5
) -> Array:
    """Rows F_ij from patch to patch, (len(chosen), N) float64; `pairs` says how."""
    return ClosedForm(patches, occlusion, points, rays)(chosen)
