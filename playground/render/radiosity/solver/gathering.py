"""Gathering: every patch collects the light that arrives, over and over, until it stays.

A sweep takes the row of every patch. Jacobi gathers from the light of the sweep before,
so that k sweeps are k bounces; Gauss and Seidel gather from the newest there is.
Source: Cohen and Greenberg, The Hemi-Cube, SIGGRAPH 1985; Cohen and Wallace, Radiosity and
Realistic Image Synthesis, 1993, chapter 5.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from playground.render.radiosity.solver.patience import Patience
from playground.render.radiosity.solver.system import Step, System, narrow, nothing_sent
from playground.shading.floats import Array

TOGETHER = 64  # patches whose Gauss–Seidel updates are made at once, with the very same result


def jacobi(system: System, convergence: float, start: Step | None = None) -> Iterator[Step]:
    """C ← E + rho (D + F C): step k holds the light after k bounces.

    Arguments and steps as `solve.SOLVERS` has them.
    """
    return _gathered(system, convergence, start, "jacobi", lambda light: light)


def gauss_seidel(system: System, convergence: float, start: Step | None = None) -> Iterator[Step]:
    """C_i ← E_i + rho_i (D_i + Σ_j F_ij C_j), patch by patch, F_ii C_i taken to the left side.

    Arguments and steps as `solve.SOLVERS` has them. About half the sweeps of `jacobi`; each
    step gathers once more to see what is left, and shows that light too.
    """
    return _gathered(system, convergence, start, "gauss-seidel", _Seidel(system))


def _gathered(
    system: System,
    convergence: float,
    start: Step | None,
    name: str,
    improve: Callable[[Array], Array],
) -> Iterator[Step]:
    """Steps of a method that improves the light (N, c) sent on from sweep to sweep.

    What arrives of it, and is reflected, is what a step shows: one bounce more than was sent.
    The difference of the two is the light unshot.
    """
    work, factors = system.working, system.form_factors
    patience = Patience(system, name, convergence)
    done, light = 0, work.first
    if start is None:
        yield nothing_sent(system, name)
    elif start.finished(name, convergence):
        return
    else:
        done = start.done if start.solver == name else 0
        light = narrow(start.exact, work.lit)

    # Of the light of patch j the share 1 − Σ_i A_i F_ij / A_j arrives nowhere.
    arrives = factors.column_sums()[:, None]
    largest = float(arrives.max(initial=0.0))
    while True:
        sent = improve(light)
        arriving = work.direct + factors.gather(sent)
        light = work.emission + work.rho * arriving
        unshot = light - sent
        escaped = work.power((1.0 - arrives) * sent)
        done += 1
        step = work.step(name, done, arriving, unshot, escaped, largest=largest)
        yield step
        if step.residual <= convergence:
            return
        patience.look(done, step.residual)


class _Seidel:
    """One Gauss–Seidel sweep, `TOGETHER` patches at a time.

    Of a block b with the triangle L of F_bb below and on the diagonal, patch-by-patch updates
    solve (1 − rho L) x = E + rho (D + (F C)_b − L C_b), C the newest light outside of b and the
    old one in it. The inverses of the small matrices are kept; no approximation is made.
    """

    def __init__(self, system: System) -> None:
        self._system, self._lower, self._inverse = system, [], []  # type: ignore[var-annotated]
        self._blocks = [
            np.arange(first, min(first + TOGETHER, len(system.area)))
            for first in range(0, len(system.area), TOGETHER)
        ]

    def __call__(self, light: Array) -> Array:
        work, light = self._system.working, light.copy()
        for number, block in enumerate(self._blocks):
            rows = self._system.form_factors.rows(block)
            if number == len(self._lower):
                lower = np.tril(rows[:, block])
                each = np.eye(len(block)) - work.rho[block].T[:, :, None] * lower
                self._lower.append(lower)
                self._inverse.append(np.linalg.inv(each))
            lower, inverse = self._lower[number], self._inverse[number]
            others = rows @ light - lower @ light[block]
            known = work.emission[block] + work.rho[block] * (work.direct[block] + others)
            light[block] = np.einsum("cij,jc->ic", inverse, known)
        return light
