"""The light after so many reflections, bounce by bounce, from form factors that are there."""

from __future__ import annotations

from time import perf_counter

import numpy as np

from playground.gui.radiosity.solving import Solving
from playground.render.radiosity.factor.matrix import BATCH
from playground.render.radiosity.result import Radiosity
from playground.shading.floats import Array


class BounceRun:
    """What arrives at each patch when light may be reflected k times, for k = 0, 1, 2, ...

    Nothing arrives at k = 0, where only what shines by itself is seen. What arrives then is
    D + F (E + rho H), H being what arrived before: one sweep of Jacobi for each reflection.
    """

    def __init__(self) -> None:
        self._of: tuple[Radiosity, int] | None = None
        self._arriving: list[Array] = []
        self.working = False

    def advance(self, result: Radiosity, bounces: int, until: float) -> None:
        """Follow the light up to so many reflections; stops when the clock says ``until``."""
        if self._of != (result, result.round):
            self._of = (result, result.round)
            self._arriving = [np.zeros_like(result.patches.emission)]
        self.working = len(self._arriving) <= bounces
        missing = np.flatnonzero(np.isnan(result.form_factors.raw_sums()))
        for first in range(0, len(missing) if self.working else 0, BATCH):
            result.form_factors.row_sums(missing[first : first + BATCH])
            if perf_counter() >= until:
                return
        while self.working:
            system = result.system
            light = system.emission + system.reflectance * self._arriving[-1]
            arriving = system.direct + system.form_factors.gather(light)
            self._arriving.append(np.asarray(arriving))
            self.working = len(self._arriving) <= bounces
            if perf_counter() >= until:
                return

    def shown(self, result: Radiosity, solving: Solving) -> int | None:
        """How many reflections what is shown has; None where it is the solution."""
        known = self._of == (result, result.round)
        if not solving.by_bounce or not known:
            self.working = False
            return None
        return min(solving.bounces, len(self._arriving) - 1)

    def light(self, result: Radiosity, solving: Solving) -> tuple[Array, Array] | None:
        """What arrives after the reflections that are shown, (N, 3): all light, and direct."""
        bounces = self.shown(result, solving)
        if bounces is None:
            return None
        return self._arriving[bounces], self._arriving[min(bounces, 1)]
