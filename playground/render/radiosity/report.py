"""What can be said of a solution: whether it keeps the laws, and what it leaves out."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from playground.render.radiosity.factor.matrix_report import MatrixReport
from playground.render.radiosity.patch.flaws import Flaws
from playground.render.radiosity.solver.ledger import Ledger
from playground.render.radiosity.solver.system import Step

if TYPE_CHECKING:
    from playground.render.radiosity.result import Radiosity


@dataclass(frozen=True, eq=False)
class Report:
    """A solution as far as it has come; ``str()`` of it is for a person.

    ``residual`` is the share of the light that has not been sent on; ``bound``: the light of all
    patches is off by at most this share of it.
    """

    patches: int
    rounds: int  # refinements of the patches
    form_factors: MatrixReport
    inspection: Flaws
    solver: str
    steps: int
    residual: float
    bound: float
    ledger: Ledger
    not_modelled: tuple[str, ...]

    def __str__(self) -> str:
        ledger = self.ledger
        energy = [
            f"{name} " + " ".join(f"{x:.6g}" for x in getattr(ledger, name))
            for name in ("emitted", "absorbed", "unshot", "escaped")
        ]
        return "\n".join(
            [
                f"{self.patches} patches after {self.rounds} refinements",
                str(self.form_factors),
                f"{self.solver}: {self.steps} steps, {self.residual:.2e} of the light left, "
                f"off by at most {self.bound:.2e}",
                f"energy: {', '.join(energy)}; out of balance by {ledger.imbalance:.1e}",
                str(self.inspection),
                *(f"not modelled: {sentence}" for sentence in self.not_modelled),
            ]
        )


def brief(step: Step, factors: MatrixReport) -> str:
    """What of a solution is asked most, in a line."""
    return (
        f"{factors.patches} patches, {step.solver}: {step.done} steps, {step.residual:.1e} of the "
        f"light left; {factors.computed} rows of form factors with sums {factors.lowest:.5f} to "
        f"{factors.highest:.5f}, correction: {factors.correction}; reciprocity within "
        f"{factors.reciprocity:.1e}"
    )


def report_on(result: Radiosity) -> Report:
    """The report on a solution; without a step so far it is solved first."""
    from playground.render.radiosity.patch.inspect import inspect

    step = result.last
    return Report(
        patches=len(result.patches),
        rounds=result.round,
        form_factors=result.form_factors.report(),
        inspection=inspect(result.patches),
        solver=step.solver,
        steps=step.done,
        residual=step.residual,
        bound=step.bound,
        ledger=step.ledger,
        not_modelled=result.not_modelled,
    )
