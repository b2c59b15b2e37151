"""Where the light has gone: emitted, absorbed, still unshot, escaped; it must add up."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from playground.shading.floats import Array


@dataclass(frozen=True)
class Ledger:
    """The energy of a solution at one step, by channel: four arrays of shape (3,).

    In units of area times colour: the area of a patch times what leaves it, or arrives at it.
    At every step of every solver emitted = absorbed + unshot + escaped, to rounding. Each of the
    four is computed by itself, so that the balance is a test.
    """

    emitted: Array  # Σ A (E + D): what patches emit, and what arrives straight from lamps
    absorbed: Array  # Σ A (1 − rho) H of what has arrived so far
    unshot: Array  # what has been reflected or emitted and has not been sent on
    escaped: Array  # what was sent and met no patch: into the open, or by form factors too small

    @property
    def imbalance(self) -> float:
        """The largest |emitted − absorbed − unshot − escaped| of a channel, relative to all light.

        The scale is the largest of the four, since a solver that shoots too much on
        purpose passes more light around than there is.
        """
        parts = np.abs([self.emitted, self.absorbed, self.unshot, self.escaped])
        missing = np.abs(self.emitted - self.absorbed - self.unshot - self.escaped)
        scale = parts.max(axis=0)
        return float(np.max(missing / np.where(scale > 0.0, scale, 1.0)))
