"""How right a matrix of form factors is, by the laws it must keep: row sums and reciprocity."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from playground.percent import percent
from playground.shading.floats import Array

STRETCHED = 0.05  # a row that lacks more misses patches it should see: that is no rounding
PAIRED = 1024  # rows among which reciprocity is looked at, evenly chosen


@dataclass(frozen=True)
class MatrixReport:
    """What is known of the rows computed so far; all sums are those before any correction."""

    computed: int  # rows
    patches: int
    lowest: float  # row sum; NaN like the next two if no row has been computed
    highest: float
    mean: float
    reciprocity: float  # max |A_i F_ij − A_j F_ji|, in units of the largest A_i F_ij
    reciprocity_share: float  # Σ |A_i F_ij − A_j F_ji| / Σ A_i F_ij
    paired: int  # among how many rows both were looked at
    closed: bool
    correction: str
    stretched: int  # rows that are corrected although they lack more than `STRETCHED`
    stretched_most: float  # by what the lowest of them is multiplied; 1 if there is none
    left_short: int  # rows that are left alone, because most of what they see is missing

    def __str__(self) -> str:
        """For a person, a line per law."""
        scene = "closed: every sum should be 1" if self.closed else "open: sums may be below 1"
        lines = [f"{self.computed} of {self.patches} rows computed; the scene is {scene}"]
        if self.computed:
            lines += [
                f"row sums {self.lowest:.6f} to {self.highest:.6f}, mean {self.mean:.6f}",
                f"reciprocity |A_i F_ij - A_j F_ji|: at most {self.reciprocity:.2e} of the largest"
                f" A_i F_ij, {percent(self.reciprocity_share, '.2f')} in all ({self.paired} rows)",
            ]
        lines.append(f"correction: {self.correction}")
        if self.stretched:
            lines.append(
                f"{self.stretched} rows sum to less than {1.0 - STRETCHED:g} and are stretched, by "
                f"at most {self.stretched_most:.3g}: these patches are partly covered, or light "
                "leaks out there, and what they miss is taken to be as bright as what they see"
            )
        if self.left_short:
            lines.append(f"{self.left_short} rows are mostly covered and left as they are")
        return "\n".join(lines)


def report_on(
    rows: Array,
    of: NDArray[Any],
    area: Array,
    sums: Array,
    scale: Array,
    closed: bool,
    correction: str,
) -> MatrixReport:
    """The report on rows (k, N) of the patches ``of`` (k,).

    Parameters
    ----------
    area : (N,) array
    sums : (N,) array
        Row sums, NaN where the row is not known.
    scale : (N,) array
        What the rows are multiplied by.
    closed, correction : bool, str
        What becomes of the rows.
    """
    known = sums[~np.isnan(sums)]
    lowest, highest, mean = (known.min(), known.max(), known.mean()) if len(known) else [np.nan] * 3
    short, corrected = sums < 1.0 - STRETCHED, scale != 1.0  # NaN is not below anything
    stretched = scale[short & corrected] if closed else np.empty(0)
    some = np.unique(np.linspace(0, len(of) - 1, min(PAIRED, len(of))).astype(int))
    sent = rows[some][:, of[some]] * area[of[some], None] if len(some) else np.zeros((1, 1))
    differing, largest, total = np.abs(sent - sent.T), float(np.abs(sent).max()), float(sent.sum())
    return MatrixReport(
        computed=len(known),
        patches=len(area),
        lowest=float(lowest),
        highest=float(highest),
        mean=float(mean),
        reciprocity=float(differing.max()) / largest if largest > 0.0 else 0.0,
        reciprocity_share=float(differing.sum()) / total if total > 0.0 else 0.0,
        paired=len(some),
        closed=closed,
        correction=correction,
        stretched=len(stretched),
        stretched_most=float(stretched.max(initial=1.0)),
        left_short=int(np.count_nonzero(short & ~corrected)) if corrected.any() else 0,
    )
