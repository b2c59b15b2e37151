"""What radiosity solves, and what every solver yields at each step.

C_i = E_i + rho_i (D_i + Σ_j F_ij C_j): the light C that leaves a patch is what it emits and what
it reflects of what arrives straight from lamps (D) and from all other patches. All of it
is in the unit of colours, which is radiance.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from playground.errors import PlaygroundError
from playground.render.radiosity.factor.matrix import FormFactors
from playground.render.radiosity.solver.ledger import Ledger
from playground.shading.floats import Array

Ints = NDArray[np.int64]
NOBODY: Ints = np.zeros(0, np.int64)


@dataclass(frozen=True, eq=False)
class System:
    """The radiosity equation of N patches in three channels.

    Parameters
    ----------
    form_factors : FormFactors
        F, computed row by row as a solver asks.
    area : (N,) array
    reflectance : (N, 3) array
        rho, from 0 to 1; 1 is allowed where the light finds something else that absorbs it.
    emission : (N, 3) array
    direct : (N, 3) array, optional
        D; zero without it.

    Raises
    ------
    PlaygroundError
        A shape is wrong, a number is NaN or out of its range, or there is no light at all.
    """

    form_factors: FormFactors
    area: Array
    reflectance: Array
    emission: Array
    direct: ArrayLike = 0.0

    def __post_init__(self) -> None:
        size = len(self.form_factors)
        shapes = {"area": (size,), **dict.fromkeys(("reflectance", "emission"), (size, 3))}
        for name, shape in shapes.items():
            value = np.asarray(getattr(self, name), np.float64)
            if value.shape != shape:
                raise PlaygroundError(f"the {name} of {size} patches", got=str(value.shape))
            object.__setattr__(self, name, value)
        direct = np.broadcast_to(np.asarray(self.direct, np.float64), (size, 3))
        object.__setattr__(self, "direct", direct)
        most = {"area": np.inf, "reflectance": 1.0, "emission": np.inf, "direct": np.inf}
        for name, highest in most.items():
            value = getattr(self, name)
            wrong = ~((value >= 0.0) & (value <= highest) & np.isfinite(value))
            if np.any(wrong):
                patch = np.argwhere(wrong)[0]
                raise PlaygroundError(
                    f"the {name} of patch {patch[0]} makes no sense",
                    got=float(value[tuple(patch)]),
                    allowed="0 to 1" if highest == 1.0 else "finite, at least 0",
                )
        if len(self.lit) == 0:
            raise PlaygroundError(
                "no light enters the scene: no patch emits any, and no lamp reaches one",
                fix="Give a material an emissive colour, or add a light.",
            )

    @cached_property
    def lit(self) -> Ints:
        """The channels with any light in them; the others cost nothing."""
        return np.flatnonzero((self.emission + np.asarray(self.direct)).any(axis=0))

    @cached_property
    def working(self) -> Working:
        """The arrays of the lit channels only."""
        area = self.area[:, None]
        rho, emission, direct = (
            narrow(np.asarray(x), self.lit) for x in (self.reflectance, self.emission, self.direct)
        )
        first = emission + rho * direct
        return Working(self.lit, area, rho, emission, direct, first, area[:, 0] @ first)


@dataclass(frozen=True)
class Step:
    """The solution so far."""

    solver: str
    light: Array  # (N, 3): C, the best estimate so far; what a picture shows
    exact: Array  # (N, 3): C of the light that has really been followed; ``light`` without estimate
    arriving: Array  # (N, 3): H = D + F C of the light that has been sent on; exact = E + rho H
    ledger: Ledger
    done: int  # sweeps, iterations or shots so far
    residual: float  # Σ A |unshot| / Σ A (E + rho D) of the channel that has most left
    bound: float  # Σ A |C − exact| / Σ A exact is at most this, for the true C; see `error_bound`
    patches: Ints = field(default_factory=lambda: NOBODY)  # who shot in this step, brightest first
    state: tuple[Any, ...] = field(default=(), repr=False)  # what its solver needs to go on

    @property
    def patch(self) -> int | None:
        """Who shot in this step; of several the brightest; None where all gather at once."""
        return int(self.patches[0]) if len(self.patches) else None

    def finished(self, solver: str, convergence: float) -> bool:
        """Whether it is the last step of this solver."""
        return self.solver == solver and self.residual <= convergence


@dataclass(frozen=True, eq=False)
class Working:
    """What solvers compute with: the c lit channels, side by side."""

    lit: Ints
    area: Array  # (N, 1)
    rho: Array  # (N, c), like the next three
    emission: Array
    direct: Array
    first: Array  # E + rho D: what the light does before any patch sees another
    total: Array  # (c,): Σ A first

    def power(self, light: Array) -> Array:
        """Σ A C of each channel, (c,)."""
        return np.asarray(self.area[:, 0] @ light)

    def share_left(self, unshot: Array) -> float:
        """Σ A |unshot| in units of the first light, of the channel that has most left."""
        left = self.power(np.abs(unshot))
        return float(np.max(left / np.where(self.total > 0.0, self.total, 1.0)))

    def error_bound(self, unshot: Array, light: Array, largest: float) -> float:
        """An upper bound on Σ A |C − light| / Σ A light, of the worst channel.

        Unshot light u adds Σ (rho F)^k u, k from 1. Each reflection leaves at most the share
        s = max rho · ``largest`` of it, where ``largest`` is the largest share of a patch's light
        that arrives anywhere; so it adds at most s / (1 − s) Σ A |u|. Infinite if s >= 1, where
        this proves nothing. One white wall in a grey room makes the bound pessimistic.
        """
        worst = 0.0
        for rho, left, all_of_it in zip(
            self.rho.max(axis=0),
            self.power(np.abs(unshot)),
            self.power(np.abs(light)),
            strict=True,
        ):
            share = float(rho) * largest
            if left > 0.0:
                bound = share / (1.0 - share) * left / all_of_it if share < 1.0 else np.inf
                worst = max(worst, float(bound))
        return worst

    def wide(self, narrow: Array) -> Array:
        """The (..., c) lit channels as (..., 3), zero elsewhere."""
        if len(self.lit) == 3:
            return narrow.copy()
        full = np.zeros((*narrow.shape[:-1], 3))
        full[..., self.lit] = narrow
        return full

    def ledger(self, arriving: Array, unshot: Array, escaped: Array) -> Ledger:
        """The books after so much has arrived (N, c), waits (N, c) and has escaped (c,)."""
        emitted = self.power(self.emission + self.direct)
        absorbed = self.power((1.0 - self.rho) * arriving)
        waiting = self.power(unshot)
        return Ledger(*(self.wide(part) for part in (emitted, absorbed, waiting, escaped)))

    def step(
        self,
        solver: str,
        done: int,
        arriving: Array,
        unshot: Array,
        escaped: Array,
        *,
        largest: float,
        estimate: Array | float = 0.0,
        patches: Ints = NOBODY,
        state: tuple[Any, ...] = (),
    ) -> Step:
        """A step of the arrays of the lit channels; ``estimate`` is further light to show."""
        exact = self.emission + self.rho * arriving
        wide = self.wide(exact)
        return Step(
            solver=solver,
            light=self.wide(exact + estimate) if np.any(estimate) else wide,
            exact=wide,
            arriving=self.wide(arriving),
            ledger=self.ledger(arriving, unshot, escaped),
            done=done,
            residual=self.share_left(unshot),
            bound=self.error_bound(unshot, exact, largest),
            patches=patches,
            state=state,
        )


def nothing_sent(system: System, solver: str) -> Step:
    """The step before the first: all light is where it came from, and no row has been asked for."""
    work = system.working
    nothing = np.zeros(len(work.lit))
    return work.step(solver, 0, work.direct, work.first, nothing, largest=1.0)


def narrow(wide: Array, lit: Ints) -> Array:
    """The lit channels (N, c) of (N, 3), row by row in memory: the order of a sum counts."""
    return np.ascontiguousarray(wide[:, lit])
