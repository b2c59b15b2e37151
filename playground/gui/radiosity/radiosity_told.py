"""What a panel tells of radiosity: how far it is, who shoots, whether the laws are kept."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

from playground.percent import percent
from playground.render.radiosity.factor.matrix_report import MatrixReport
from playground.render.radiosity.result import Radiosity

if TYPE_CHECKING:
    from playground.gui.radiosity.radiosity_run import RadiosityRun
    from playground.gui.radiosity.stored_slots import StoredSlots


@dataclass(frozen=True)
class RadiosityTold:
    """``on`` says whether a picture shows radiosity, ``share`` how much of the work is done.

    Lines that are not known yet are empty. ``settled`` says that nothing changes by itself.
    """

    on: bool = False
    settled: bool = True
    done: bool = False
    share: float = 0.0
    error: str = ""
    left: str = ""  # light left, steps, patches
    shooter: str = ""
    laws: tuple[str, ...] = ()  # row sums, reciprocity, closure
    energy: str = ""
    warnings: tuple[str, ...] = ()


def told(slots: StoredSlots) -> RadiosityTold:
    """Of the radiosity of the view."""
    run = slots.radiosity
    if not slots.solves:
        return RadiosityTold()
    if run.error:
        return RadiosityTold(on=True, error=run.error)
    result, step = run.result, run.step
    if result is None or step is None or run.patches is None:
        share = result.progress if result is not None and run.patches is not None else 0.0
        return RadiosityTold(on=True, settled=not run.working, share=share, left=_beginning(run))
    ledger = step.ledger
    parts = {x: float(getattr(ledger, x).sum()) for x in ("absorbed", "unshot", "escaped")}
    whole = float(ledger.emitted.sum()) or 1.0
    return RadiosityTold(
        on=True,
        settled=not run.working,
        done=result.done,
        share=result.progress,
        left=f"{percent(step.residual)} of the light left after {step.done} {_unit(result)}, "
        f"{len(result.patches)} patches",
        shooter=_shooter(result),
        laws=_laws(result, step.done) if not run.working else _sums(result),
        energy=", ".join(f"{name} {percent(part / whole, '.1f')}" for name, part in parts.items()),
        warnings=result.warnings,
    )


def _beginning(run: RadiosityRun) -> str:
    if run.patches is None:
        return "the scene is divided into patches..."
    return f"{len(run.patches)} patches; form factors..." if run.working else "waiting"


def _unit(result: Radiosity) -> str:
    """What the steps of a solver are called."""
    solver = result.setup.settings.solver
    if solver in ("jacobi", "gauss-seidel"):
        return "sweeps"
    if solver in ("conjugate-gradients", "direct"):
        return "iterations"
    return "shots"


def _shooter(result: Radiosity) -> str:
    """Who shot in the last step."""
    step = result.step
    if step is None or step.patch is None:
        return ""
    owner, objects = int(result.patches.owner[step.patch]), result.setup.scene.objects
    if owner < len(objects):
        what = f"object {owner}, {objects[owner].mesh.rsplit('/', 1)[-1]}"
    else:
        what = "an area light"
    others = len(step.patches) - 1
    more = f", and {others} dimmer ones with it" if others else ""
    return f"patch {step.patch} of {what} shot{more}"


def _sums(result: Radiosity) -> tuple[str, ...]:
    """How many rows there are; the rest when the work rests."""
    factors = result.form_factors
    return (f"{factors.computed} of {len(factors)} rows of form factors",)


def _laws(result: Radiosity, done: int) -> tuple[str, ...]:
    return tuple(str(_report(result, result.round, done)).split("\n"))


# Reciprocity is looked at among up to a million pairs: once, not at every frame.
@lru_cache(maxsize=1)
def _report(result: Radiosity, round_: int, done: int) -> MatrixReport:
    return result.form_factors.report()
