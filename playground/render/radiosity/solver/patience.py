"""When to give up on a solver that gets nowhere, and what to say then."""

from __future__ import annotations

from math import inf, isfinite, log

from playground.errors import PlaygroundError
from playground.render.radiosity.solver.system import System

LOOK_FROM = 16  # sweeps; from here on each doubling is compared with the one before
DECIDE_FROM = 1024  # sweeps after which hopeless slowness ends the work
MOST_SWEEPS = 100_000  # what may still be ahead then


class Patience:
    """Watches the light that is left, and ends a solver that grows or takes for ever.

    At 16, 32, 64, ... sweeps the light left is compared with half as many sweeps before: each sweep
    has multiplied it by a factor, which tends to the spectral radius of rho F. A factor of
    1 or more will never converge; one so close to 1 that more than `MOST_SWEEPS` are ahead
    is told, with the solvers that would do.

    Parameters
    ----------
    system : System
    solver : str
    convergence : float
        The share of light left at which the solver stops.
    per_sweep : int, optional
        How many of its steps make a sweep; N for one that sends from one patch at a time.
    """

    def __init__(self, system: System, solver: str, convergence: float, per_sweep: int = 1) -> None:
        self._system, self._solver, self._convergence = system, solver, convergence
        self._per_sweep, self._next = per_sweep, LOOK_FROM
        self._before: tuple[int, float] | None = None

    def look(self, done: int, residual: float) -> None:
        """Compare, if the time has come.

        Raises
        ------
        PlaygroundError
            The light grows, or shrinks too slowly.
        """
        if not isfinite(residual):
            raise grows(self._system)
        if done < self._next * self._per_sweep:
            return
        if self._before is not None and residual > 0.0:
            since = (done - self._before[0]) / self._per_sweep
            factor = (residual / self._before[1]) ** (1.0 / since)
            if factor >= 1.0 - 1e-15:
                raise grows(self._system, factor)
            ahead = log(self._convergence / residual) / log(factor)
            if self._next >= DECIDE_FROM and ahead > MOST_SWEEPS:
                raise self._too_slow(factor, ahead)
        self._before = (done, residual)
        while done >= self._next * self._per_sweep:
            self._next *= 2

    def _too_slow(self, factor: float, ahead: float) -> PlaygroundError:
        return PlaygroundError(
            f"the solver '{self._solver}' takes too long: each sweep leaves"
            f" {factor:.8f} of the light, since the largest reflectance is"
            f" {self._system.reflectance.max():.8g}",
            got=f"{ahead:,.0f} more sweeps needed",
            allowed=f"{MOST_SWEEPS:,}",
            fix="Take the solver 'conjugate-gradients' or 'direct', or less reflectance.",
        )


def grows(system: System, factor: float = inf) -> PlaygroundError:
    """The error for a system in which every bounce leaves at least as much light as before."""
    sums = system.form_factors.raw_sums()
    known = sums[sums == sums]
    normalised = system.form_factors.normalise and system.form_factors.closed
    highest = 1.0 if normalised or len(known) == 0 else float(known.max())
    largest = float(system.reflectance.max())
    measured = f", each sweep multiplies the light by {factor:.6g}" if isfinite(factor) else ""
    fix = "Lower the reflectance."
    if highest > 1.0:
        fix = "Switch 'normalise' on for a closed scene, take finer form factors, or less white."
    return PlaygroundError(
        "the light grows without bound, or is never absorbed",
        got=f"reflectance up to {largest:.8g} and form factors that sum to up to {highest:.6g}"
        + measured,
        allowed="a product below 1 where the light goes",
        fix=fix,
    )
