"""Shooting: the patch with most to give sends its light to all others, then the next.

One row of the matrix per shot, so the first picture comes early and a patch that never shoots
needs no row. Three orders: progressive refinement (Cohen, Chen, Wallace and Greenberg, A
Progressive Refinement Approach to Fast Radiosity Image Generation, SIGGRAPH 1988), Southwell's
relaxation (Gortler, Cohen and Slusallek, Radiosity and Relaxation Methods, IEEE CG&A 14(6),
1994), and overshooting (Feda and Purgathofer, Accelerating Radiosity by Overshooting,
Eurographics Workshop on Rendering, 1992).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from playground.render.radiosity.solver.patience import Patience
from playground.render.radiosity.solver.system import Ints, Step, System, narrow
from playground.shading.floats import Array

SHOTS_PER_STEP = 32
NEARLY = 0.25  # who has less to give than this part of the brightest does not shoot with it
LEAST_LOST = 1e-6  # of a flight; less makes the estimate no better, and 0 would divide by it
OVERSHOTS = 8  # how often a patch may send more than it has; then it only settles


def progressive(
    system: System,
    convergence: float,
    start: Step | None = None,
    *,
    shots_per_step: int = SHOTS_PER_STEP,
    ambient: bool = True,
) -> Iterator[Step]:
    """The patch with the most unshot power A U shoots; the rest is shown as a guess.

    Arguments and steps as `solve.SOLVERS` has them, and:

    Parameters
    ----------
    shots_per_step : int
        How many patches may shoot together in a step: the brightest, and of the next
        brightest those with at least `NEARLY` as much. 1 is the method as published.
    ambient : bool
        Whether `Step.light` has the ambient estimate added, rho times what would arrive if all
        unshot light went round evenly; it vanishes as the unshot light does. Unlike the published
        estimate it does not overdo open scenes: in each round only the share stays that has met a
        patch so far, all of it in a closed scene.
    """
    return _Shooting(system, "progressive", shots_per_step).steps(convergence, start, ambient)


def southwell(
    system: System,
    convergence: float,
    start: Step | None = None,
    *,
    shots_per_step: int = SHOTS_PER_STEP,
) -> Iterator[Step]:
    """The patch with the largest residual U shoots, the brightest rather than the strongest.

    It solves the equation with the largest error, as Southwell did for frameworks in 1940. Large
    dim patches wait longer than in `progressive`. Arguments as there.
    """
    return _Shooting(system, "southwell", shots_per_step).steps(convergence, start, False)


def overshooting(
    system: System,
    convergence: float,
    start: Step | None = None,
    *,
    shots_per_step: int = SHOTS_PER_STEP,
) -> Iterator[Step]:
    """A patch sends its unshot light and what the ambient estimate says is still to come.

    What it has sent too much is unshot light below zero, taken back when its turn comes. After
    `OVERSHOTS` shots a patch sends only what it has, which always converges where the others do.
    Arguments as `progressive`.
    """
    return _Shooting(system, "overshooting", shots_per_step).steps(convergence, start, False)


@dataclass
class _State:
    """Where a solver is; copied into each step, so that any of them can be gone on from."""

    arriving: Array  # (N, c): H
    unshot: Array  # (N, c): U
    escaped: Array  # (c,)
    turns: Ints  # (N,): how often each patch has shot
    sent: float  # power sent so far, of all channels, whatever its sign
    met: float  # how much of that met a patch
    largest: float  # row sum so far
    done: int

    def copy(self) -> _State:
        """The same, sharing nothing."""
        return replace(
            self,
            arriving=self.arriving.copy(),
            unshot=self.unshot.copy(),
            escaped=self.escaped.copy(),
            turns=self.turns.copy(),
        )


class _Shooting:
    def __init__(self, system: System, name: str, shots_per_step: int) -> None:
        self.system, self.work, self.name = system, system.working, name
        self.shots = min(max(shots_per_step, 1), len(system.area))
        area, rho = self.work.area, self.work.rho
        self.all_area = float(area.sum())
        self.mean = self.work.power(rho) / self.all_area

    def steps(self, convergence: float, start: Step | None, ambient: bool) -> Iterator[Step]:
        """Shoot until the share ``convergence`` of the light is left."""
        if start is not None and start.finished(self.name, convergence):
            return
        state = self._begin(start)
        patience = Patience(self.system, self.name, convergence, per_sweep=len(self.system.area))
        if start is None:
            yield self._step(state, ambient, np.zeros(0, np.int64))
        while True:
            chosen, amount = self._choose(state)
            self._shoot(state, chosen, amount)
            step = self._step(state, ambient, chosen)
            yield step
            if step.residual <= convergence:
                return
            patience.look(step.done, step.residual)

    def _begin(self, start: Step | None) -> _State:
        """From nothing sent, or where ``start`` was; a gathered solution is taken as sent."""
        work, size = self.work, len(self.work.area)
        turns, none = np.zeros(size, np.int64), np.zeros(len(work.lit))
        if start is None:
            return _State(work.direct.copy(), work.first.copy(), none, turns, 0.0, 0.0, 1.0, 0)
        if start.state and isinstance(start.state[0], _State):
            state = start.state[0].copy()
            if start.solver != self.name:
                state.turns, state.done = turns, 0
            return state
        everybody, sent = np.arange(size), narrow(start.exact, work.lit)
        sums = self.system.form_factors.row_sums(everybody)
        arriving = work.direct + self.system.form_factors.send(everybody, sent)
        unshot = work.emission + work.rho * arriving - sent
        escaped = work.power((1.0 - sums)[:, None] * sent)
        return _State(arriving, unshot, escaped, turns, 0.0, 0.0, float(sums.max()), 0)

    def _ambient(self, state: _State) -> Array:
        """What still arrives everywhere, (c,), if the unshot light goes round evenly.

        The mean Ū of it arrives once, reflected again, and so on: Ū s (1 + ρ̄ s + (ρ̄ s)² + ...)
        with the share s that stays in the scene at each flight.
        """
        stays = state.met / state.sent if state.sent > 0.0 else 1.0
        mean = self.work.power(state.unshot) / self.all_area
        return np.asarray(mean * stays / np.maximum(1.0 - self.mean * stays, LEAST_LOST))

    def _choose(self, state: _State) -> tuple[Ints, Array]:
        """Who shoots, brightest first, (k,), and how much light each sends, (k, c)."""
        amount = state.unshot
        if self.name == "overshooting":
            more = self.work.rho * self._ambient(state)
            amount = amount + np.where(state.turns[:, None] < OVERSHOTS, more, 0.0)
        strength = np.abs(amount).sum(axis=1)
        if self.name != "southwell":
            strength *= self.work.area[:, 0]
        if self.shots == 1:
            best = np.array([np.argmax(strength)])
        else:
            best = np.argpartition(strength, -self.shots)[-self.shots :]
            best = best[np.argsort(-strength[best], kind="stable")]
            best = best[strength[best] >= NEARLY * strength[best[0]]]
        return best, amount[best]

    def _shoot(self, state: _State, chosen: Ints, amount: Array) -> None:
        """Send the light, and write down where it went."""
        factors, area = self.system.form_factors, self.work.area
        arrived = factors.send(chosen, amount)
        sums = factors.row_sums(chosen)[:, None]
        state.arriving += arrived
        state.unshot += self.work.rho * arrived
        state.unshot[chosen] -= amount
        power = area[chosen] * amount
        state.escaped += (power * (1.0 - sums)).sum(axis=0)
        state.sent += float(np.abs(power).sum())
        state.met += float(np.abs(power * sums).sum())
        state.largest = max(state.largest, float(sums.max()))
        state.turns[chosen] += 1
        state.done += len(chosen)

    def _step(self, state: _State, ambient: bool, chosen: Ints) -> Step:
        return self.work.step(
            self.name,
            state.done,
            state.arriving,
            state.unshot,
            state.escaped,
            largest=state.largest,
            estimate=self.work.rho * self._ambient(state) if ambient else 0.0,
            patches=chosen,
            state=(state.copy(),),
        )
