"""All solvers of radiosity by their names; each is a generator of steps.

``SOLVERS[name](system, convergence, start=None)`` yields a `Step` before anything is sent, and
one after every sweep, iteration or batch of shots, until the share of light left
(`Step.residual`, of the worst channel) is at most ``convergence``. `Step.bound` says how far
from the solution its light is at most. A solver may be dropped at any step; given a step as
``start``, the same solver goes on as if it had never stopped, another one starts from its light.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Protocol

from playground.errors import unknown_name
from playground.render.radiosity.solver.gathering import gauss_seidel, jacobi
from playground.render.radiosity.solver.ledger import Ledger
from playground.render.radiosity.solver.shooting import overshooting, progressive, southwell
from playground.render.radiosity.solver.system import Step, System
from playground.render.radiosity.solver.whole import conjugate_gradients, direct

__all__ = ["SOLVERS", "Ledger", "Solver", "Step", "System", "solution"]


class Solver(Protocol):
    """How every solver is called."""

    def __call__(
        self, system: System, convergence: float, start: Step | None = None
    ) -> Iterator[Step]:
        """Steps towards the solution."""


SOLVERS: dict[str, Solver] = {
    "jacobi": jacobi,
    "gauss-seidel": gauss_seidel,
    "progressive": progressive,
    "southwell": southwell,
    "overshooting": overshooting,
    "conjugate-gradients": conjugate_gradients,
    "direct": direct,
}


def solution(
    system: System,
    solver: str = "progressive",
    convergence: float = 1e-4,
    start: Step | None = None,
) -> Step:
    """The last step of a solver.

    Raises
    ------
    PlaygroundError
        No such solver; the light grows, or a method needs too many sweeps or too much memory.
    """
    if solver not in SOLVERS:
        raise unknown_name("solver", solver, SOLVERS)
    steps = SOLVERS[solver](system, convergence, start)
    last = next(steps)
    for step in steps:
        last = step
    return last
