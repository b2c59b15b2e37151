"""The form factors F_ij of all patches, row by row, each computed when somebody asks for it.

Row i says how the light that leaves patch i is shared out: F_ij of it arrives at patch j. The
radiosity equation gathers along rows; shooting sends along them too, since by reciprocity
A_i F_ij = A_j F_ji a row is also a column. How the numbers are computed, this file does not know:
it is handed a function.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from playground.errors import PlaygroundError
from playground.render.radiosity.factor.closure import is_closed
from playground.render.radiosity.factor.matrix_report import MatrixReport, report_on
from playground.render.radiosity.patch.patches import Patches
from playground.shading.floats import Array

Rows = Callable[[NDArray[Any]], Array]  # patches (k,) -> their rows (k, N)
BATCH = 64  # rows that are computed at once: enough for the GPU to draw them together
BLOCK = 512  # rows that are multiplied at once: 10 MB of float64 at 2,400 patches
MOSTLY_COVERED = 0.5  # a row of a closed scene that sums to less is not stretched to 1
MOST_BYTES = 2**30


class HasArea(Protocol):
    """Patches, or as much of them as products of known rows need."""

    @property
    def area(self) -> Array:
        """(N,)."""


class FormFactors:
    """Rows of the matrix F, lazily, and the products that solvers need.

    Rows are kept as they came, in ``dtype``, until ``most_bytes`` are full; later ones are
    computed again whenever they are needed. The rows a solver asks for first are those of the
    brightest patches, which it will need again. All products are summed in float64.

    Correction: if ``normalise`` is set and the scene is closed, every row is divided by its sum,
    so that no light is lost or made; a row that sums to less than `MOSTLY_COVERED` (a
    patch that stands in another object) is left alone. The divisor is kept in float64
    beside the row: a sum of float32 numbers is off by up to 1e-8, which counts at
    a reflectance of 1 − 1e-6.

    Parameters
    ----------
    rows : function
        Patches (k,) -> their rows (k, N), any floating type.
    patches : Patches
        Or, where the rows are known anyhow, whatever has an ``area``.
    normalise : bool
        Whether the correction is made in a closed scene.
    closed : bool, optional
        Whether all light that leaves a patch meets the front of another; without it
        `closure.is_closed` looks, when it first matters.
    dtype : float32 or float64, optional
    most_bytes : int, optional
        Memory for rows.
    """

    def __init__(
        self,
        rows: Rows,
        patches: HasArea,
        normalise: bool = True,
        *,
        closed: bool | None = None,
        dtype: type[np.floating[Any]] = np.float32,
        most_bytes: int = MOST_BYTES,
    ) -> None:
        self.area: Array = np.asarray(patches.area, np.float64)
        self.normalise, self.most_bytes = normalise, most_bytes
        self._rows, self._patches, self._closed = rows, patches, closed
        size = len(self.area)
        capacity = min(size, most_bytes // (np.dtype(dtype).itemsize * max(size, 1)))
        self._kept = np.empty((capacity, size), dtype)  # memory is taken page by page, when used
        self._slot = np.full(size, -1, np.int64)  # where the row of a patch is kept
        self._patch = np.empty(capacity, np.int64)  # whose row is in a slot
        self._count = 0
        self._sum = np.full(size, np.nan)
        self.calls = 0  # how many rows have been computed; one that found no room counts every time

    def __len__(self) -> int:
        return len(self.area)

    @property
    def computed(self) -> int:
        """Of how many patches the row has been asked for so far."""
        return int(np.count_nonzero(~np.isnan(self._sum)))

    @property
    def closed(self) -> bool:
        """Whether all light that leaves a patch meets the front of another patch."""
        if self._closed is None:
            self._closed = isinstance(self._patches, Patches) and is_closed(self._patches)
        return self._closed

    @property
    def correction(self) -> str:
        """What is done to the rows, in words."""
        if not self.normalise:
            return "none: normalise is off"
        return "each row divided by its sum" if self.closed else "none: the scene is open"

    def rows(self, chosen: ArrayLike) -> Array:
        """The corrected rows of the chosen patches, (k, N) float64."""
        patches = self._known(chosen)
        raw = self._raw(patches)
        return np.multiply(raw, self._scale(patches)[:, None], dtype=np.float64)

    def row_sums(self, chosen: ArrayLike) -> Array:
        """What the corrected rows of the chosen patches sum to, (k,): 1 where it was corrected."""
        patches = self._known(chosen)
        if np.isnan(self._sum[patches]).any():
            self._raw(patches)
        return np.asarray(self._sum[patches] * self._scale(patches))

    def _known(self, chosen: ArrayLike) -> NDArray[Any]:
        """The chosen patches (k,), if there are such."""
        patches = np.atleast_1d(np.asarray(chosen)).reshape(-1)
        whole = np.issubdtype(patches.dtype, np.integer) or len(patches) == 0
        if not whole or not np.all((patches >= 0) & (patches < len(self))):
            raise PlaygroundError(
                "there is no such patch",
                got=chosen,
                allowed=f"whole numbers from 0 to {len(self) - 1}",
            )
        return patches.astype(np.int64)

    def raw_sums(self) -> Array:
        """What the rows summed to as they came, (N,); NaN for those not computed yet."""
        return self._sum.copy()

    def matrix(self) -> Array:
        """The whole corrected matrix, (N, N) float64.

        Raises
        ------
        PlaygroundError
            It does not fit into the memory for rows.
        """
        size = len(self)
        self.must_fit(8 * size * size, int((self.most_bytes / 8) ** 0.5))
        whole = np.empty((size, size))
        for patches, raw in self._blocks():
            whole[patches] = raw * self._scale(patches)[:, None]
        return whole

    def must_fit(self, size: int, patches: int) -> None:
        """Raise an error for work of ``size`` bytes where there is memory for so many patches."""
        if size > self.most_bytes:
            raise PlaygroundError(
                f"{len(self)} patches are too many for this way of solving",
                got=f"{size / 2**20:,.0f} MiB",
                allowed=f"{self.most_bytes / 2**20:,.0f} MiB",
                fix=f"Take at most {patches} patches, or the solver 'progressive'.",
            )

    def gather(self, light: Array) -> Array:
        """What arrives everywhere, F C, of the light (N, c) of all patches; asks for all rows."""
        arriving = np.empty(light.shape)
        for patches, raw in self._blocks():
            arriving[patches] = (raw @ light) * self._scale(patches)[:, None]
        return arriving

    def send(self, chosen: NDArray[Any], light: Array) -> Array:
        """What arrives everywhere, (N, c), of the light (k, c) that the chosen patches send.

        Σ_i A_i F_ij C_i / A_j: the rows of the senders are all it takes, by reciprocity.
        """
        raw = self._raw(chosen)
        power = light * (self.area[chosen] * self._scale(chosen))[:, None]
        # Not as a product of matrices: for so few rows BLAS wakes its threads in vain, which on a
        # busy machine takes a hundred times as long as the work.
        return np.asarray(np.einsum("kc,kn->cn", power, raw).T / self.area[:, None])

    def column_sums(self) -> Array:
        """Σ_i A_i F_ij / A_j of every patch j, (N,): by reciprocity its row sum; all rows."""
        power = np.zeros(len(self))
        for patches, raw in self._blocks():
            power += raw.T @ (self.area[patches] * self._scale(patches))
        return power / self.area

    def exchange(self, light: Array) -> Array:
        """K C with K = (A F + (A F)ᵀ) / 2: power (N, c), the mean of gathering and sending.

        K is symmetric to the last bit, whatever the form factors fail of reciprocity.
        """
        power = np.zeros(light.shape)
        for patches, raw in self._blocks():
            weight = (0.5 * self.area[patches] * self._scale(patches))[:, None]
            power[patches] += weight * (raw @ light)
            power += raw.T @ (weight * light[patches])
        return power

    def report(self) -> MatrixReport:
        """Row sums, reciprocity and closure of the rows computed so far."""
        kept = self._patch[: self._count]
        return report_on(
            self._kept[: self._count],
            kept,
            self.area,
            self.raw_sums(),
            self._scale(np.arange(len(self))),
            self.closed,
            self.correction,
        )

    def _scale(self, patches: NDArray[Any]) -> Array:
        """By what the rows are multiplied: 1 / their sum, or 1."""
        if not (self.normalise and self.closed):
            return np.ones(len(patches))
        sums = self._sum[patches]
        return 1.0 / np.where(sums >= MOSTLY_COVERED, sums, 1.0)

    def _raw(self, patches: NDArray[Any]) -> Array:
        """The rows as they came, (k, N); those that are missing are computed and kept."""
        missing = np.unique(patches[self._slot[patches] < 0])
        if len(missing) == 0:
            return np.asarray(self._kept[self._slot[patches]])
        if len(patches) <= BATCH and len(missing) == len(patches):
            return self._compute(patches)
        raw = np.empty((len(patches), len(self)), self._kept.dtype)
        for first in range(0, len(missing), BATCH):
            some = missing[first : first + BATCH]
            fresh = self._compute(some)
            place = np.searchsorted(some, patches)
            here = some[np.minimum(place, len(some) - 1)] == patches
            raw[here] = fresh[place[here]]
        known = ~np.isin(patches, missing)
        raw[known] = self._kept[self._slot[patches[known]]]
        return raw

    def _compute(self, patches: NDArray[Any]) -> Array:
        """Compute rows, check them, keep what there is room for."""
        raw = np.asarray(self._rows(patches)).astype(self._kept.dtype, copy=False)
        with np.errstate(invalid="ignore", over="ignore"):
            sums = raw.sum(axis=1, dtype=np.float64)
        if not np.all(np.isfinite(sums)):
            worst = int(patches[np.argmin(np.isfinite(sums))])
            raise PlaygroundError(
                "a form factor is not a number",
                got=f"in the row of patch {worst}",
                fix="Is there a patch without area, or with a corner at infinity?",
            )
        self.calls += len(patches)
        self._sum[patches] = sums
        room = patches[: len(self._patch) - self._count]
        slots = np.arange(self._count, self._count + len(room))
        self._kept[slots], self._patch[slots], self._slot[room] = raw[: len(room)], room, slots
        self._count += len(room)
        return raw

    def _blocks(self) -> Iterator[tuple[NDArray[Any], Array]]:
        """All rows once, block by block: patches (k,) and float64 rows (k, N) as they came."""
        for first in range(0, self._count, BLOCK):
            block = slice(first, min(first + BLOCK, self._count))
            yield self._patch[block].copy(), self._kept[block].astype(np.float64, copy=False)
        missing = np.flatnonzero(self._slot < 0)
        for first in range(0, len(missing), BATCH):
            some = missing[first : first + BATCH]
            yield some, self._compute(some).astype(np.float64, copy=False)
