"""Solvers that see the whole matrix: conjugate gradients, and elimination."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from playground.errors import PlaygroundError
from playground.render.radiosity.solver.exchange import Exchange
from playground.render.radiosity.solver.patience import grows
from playground.render.radiosity.solver.system import Step, System, narrow, nothing_sent
from playground.shading.floats import Array

NO_BETTER = 20  # iterations without a new best end the search; rooms take about 8 in all
ROUNDING = 1e-8  # once a residual has shrunk this far, its direction may be rounding alone
SINGULAR = 0.01  # share of light left by elimination; more means equations without a solution
SMALLEST = 1e-14  # eigenvalue (one is about 1 − rho): below it is rounding
NEGATIVE = 1e-9  # light below zero, in units of the brightest, that rounding does not explain


def conjugate_gradients(
    system: System, convergence: float, start: Step | None = None
) -> Iterator[Step]:
    """Conjugate gradients on A (1/rho − F) C = A (E/rho + D), with areas A: symmetric.

    With C = E + w u and w = √(rho/A) it reads (1 − w K w) u = b, which allows rho = 0 and has
    eigenvalues around 1 but for one of about 1 − rho: a few iterations at any reflectance.
    K is made symmetric, see `exchange.Exchange`. Arguments and steps as `solve.SOLVERS` has them.
    Source: Hestenes and Stiefel, Methods of Conjugate Gradients for Solving Linear Systems,
    Journal of Research of the National Bureau of Standards 49(6), 1952.

    Raises
    ------
    PlaygroundError
        The matrix is not positive: every bounce leaves more light. Or rounding stands in the
        way of so small a convergence.
    """
    if start is None:
        yield nothing_sent(system, "conjugate-gradients")
    elif start.finished("conjugate-gradients", convergence):
        return
    search = _Search(system, start)
    best, since = np.inf, 0
    while True:
        search.improve()
        step = search.step()
        yield step
        if step.residual <= convergence:
            return
        since = since + 1 if step.residual >= best else 0
        best = min(best, step.residual)
        if since >= NO_BETTER:
            raise PlaygroundError(
                "conjugate gradients get no further: what is left is rounding",
                got=f"a share of {step.residual:.2e} of the light left",
                fix="Take a larger convergence, or less reflectance.",
            )


def direct(system: System, convergence: float, start: Step | None = None) -> Iterator[Step]:
    """Elimination: one step, exact to rounding, N³ in time; ``start`` gives it nothing.

    Channels of the same reflectance share the work. Arguments and steps as `solve.SOLVERS`
    has them; ``convergence`` is not asked for.

    Raises
    ------
    PlaygroundError
        The matrices do not fit into the memory for rows, or the system has no solution.
    """
    work, factors, size = system.working, system.form_factors, len(system.area)
    three = 3 * 8  # bytes: the matrix, the system, and the copy that becomes its factors
    factors.must_fit(three * size * size, int((factors.most_bytes / three) ** 0.5))
    if start is None:
        yield nothing_sent(system, "direct")
    elif start.solver == "direct" and start.done:
        return
    matrix = factors.matrix()
    try:
        light = elimination(matrix, work.rho, work.first)
    except np.linalg.LinAlgError:
        raise grows(system) from None
    arriving = work.direct + matrix @ light
    unshot = work.emission + work.rho * arriving - light
    arrives = (work.area.T @ matrix).T / work.area
    escaped = work.power((1.0 - arrives) * light)
    step = work.step("direct", 1, arriving, unshot, escaped, largest=float(arrives.max()))
    if light.min() < -NEGATIVE * light.max() or step.residual > SINGULAR:
        raise grows(system)
    yield step


def elimination(matrix: Array, rho: Array, first: Array) -> Array:
    """The solution C of (1 − rho F) C = first, by the factors of Gauss, with pivots of LAPACK.

    Parameters
    ----------
    matrix : (N, N) array
        F, whatever its row sums are.
    rho, first : (N, c) arrays
        Columns of equal rho share the work.

    Raises
    ------
    LinAlgError
        There is no solution, or more than one.
    """
    light = np.empty_like(first)
    for each in np.unique(rho, axis=1).T:
        alike = np.all(rho == each[:, None], axis=0)
        equations = -each[:, None] * matrix
        equations.flat[:: len(matrix) + 1] += 1.0
        light[:, alike] = np.linalg.solve(equations, first[:, alike])
    return light


class _Search:
    """Where the search is: u, its residual, the direction p, and the power K C that arrives."""

    def __init__(self, system: System, start: Step | None) -> None:
        self.system, self.work = system, system.working
        work = self.work
        self.exchange = Exchange(system.form_factors)
        self.weight = np.sqrt(work.rho / work.area)
        if start is not None and start.solver == "conjugate-gradients" and start.state:
            copies = (part.copy() for part in start.state)
            self.u, self.residual, self.p, self.power, self.first = copies
            self.done = start.done
            return
        light = work.first if start is None else narrow(start.exact, work.lit)
        bright = self.weight > 0.0
        reflected = light - work.emission
        self.u = np.divide(reflected, self.weight, out=np.zeros_like(light), where=bright)
        self.power = self.exchange(work.emission + self.weight * self.u)
        root = np.sqrt(work.rho * work.area)
        self.residual = root * (work.direct + self.power / work.area) - self.u
        self.p, self.done = self.residual.copy(), 0
        self.first = _dots(self.residual, self.residual)

    def improve(self) -> None:
        """One iteration, in each channel by itself."""
        power = self.exchange(self.weight * self.p)
        image = self.p - self.weight * power
        before = _dots(self.residual, self.residual)
        along = _dots(self.p, image)
        least = SMALLEST * _dots(self.p, self.p)
        if np.any((before > ROUNDING**2 * self.first) & (along <= least)):
            raise grows(self.system)
        length = np.divide(before, along, out=np.zeros_like(before), where=along > 0.0)
        self.u += length * self.p
        self.power += length * power
        self.residual -= length * image
        after = _dots(self.residual, self.residual)
        turn = np.divide(after, before, out=np.zeros_like(before), where=before > 0.0)
        self.p = self.residual + turn * self.p
        self.done += 1

    def step(self) -> Step:
        """What is known now."""
        work, parts = self.work, (self.u, self.residual, self.p, self.power, self.first)
        light = work.emission + self.weight * self.u
        arriving = work.direct + self.power / work.area
        unshot = work.emission + work.rho * arriving - light
        return work.step(
            "conjugate-gradients",
            self.done,
            arriving,
            unshot,
            work.power((1.0 - self.exchange.sums) * light),
            largest=float(self.exchange.sums.max()),
            state=tuple(part.copy() for part in parts),
        )


def _dots(a: Array, b: Array) -> Array:
    """a·b of each channel, (c,)."""
    return np.asarray(np.einsum("nc,nc->c", a, b))
