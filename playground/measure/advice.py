"""What the advisor has found, as a value: findings, a proposal, and both in words."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import asdict, dataclass, field
from math import inf, nan
from typing import Any

import numpy as np

from playground.measure import metrics
from playground.measure.candidates import Candidate
from playground.measure.paired import Saving
from playground.render.image import Image
from playground.scene.setup import Setup

METRICS = ("rmse", "flip", "max")


@dataclass(frozen=True)
class Errors:
    """How far a picture is from the full one, both as shown on a screen, in [0, 1].

    ``off`` is the share of 8-bit codes that differ by more than 1; ``flip`` is None where it
    was not asked for: it takes far longer than all others.
    """

    rmse: float
    max: float
    flip: float | None
    off: float

    def of(self, metric: str) -> float:
        """The one that a budget is about; NaN for a FLIP that was not asked for."""
        error = getattr(self, metric)
        return nan if error is None else float(error)


NO_ERRORS = Errors(0.0, 0.0, 0.0, 0.0)


def error_of(metric: str, full: Image, other: Image) -> float:
    """One measure of how far ``other`` is from ``full``, as shown."""
    a, b = full.shown(), other.shown()
    if metric == "flip":
        return float(np.mean(metrics.flip_map(a, b)))
    return (metrics.rmse if metric == "rmse" else metrics.largest)(a, b)


def errors_of(full: Image, other: Image, flip: bool = True) -> Errors:
    """All measures of how far ``other`` is from ``full``, as shown; FLIP if wanted."""
    apart = np.abs(full.codes().astype(int) - other.codes())
    rmse, largest = (error_of(metric, full, other) for metric in ("rmse", "max"))
    noticed = error_of("flip", full, other) if flip else None
    return Errors(rmse, largest, noticed, float(np.mean(apart > 1)))


@dataclass(frozen=True)
class Finding:
    """What one candidate contributes to the picture, and what it costs."""

    candidate: Candidate
    errors: Errors
    saving: Saving

    def worth(self, metric: str) -> float:
        """Milliseconds saved per error; infinite for what saves time and changes nothing."""
        error = self.errors.of(metric)
        return self.saving.saved / error if error > 0.0 else inf


@dataclass(frozen=True)
class Advice:
    """The result of `playground.measure.advisor.advise`.

    ``chosen`` are the findings to drop, in the order in which they were taken; ``proposed``
    is the setup without them, ``errors`` and ``saving`` are measured on it as a whole.
    ``refuted`` are findings that seemed to save time one by one, but save none together:
    they are not proposed.
    """

    setup: Setup
    proposed: Setup
    size: tuple[int, int]
    renderer: str
    metric: str
    budget: float
    findings: tuple[Finding, ...] = ()
    chosen: tuple[Finding, ...] = ()
    errors: Errors = NO_ERRORS
    saving: Saving | None = field(default=None)
    refuted: tuple[Finding, ...] = ()

    def to_dict(self) -> dict[str, Any]:
        """Everything but the setups, as JSON takes it; times in milliseconds."""
        return {
            "setup": self.setup.name,
            "size": list(self.size),
            "renderer": self.renderer,
            "metric": self.metric,
            "budget": self.budget,
            "findings": [self._row(finding) for finding in self.findings],
            "proposal": {
                "drop": [finding.candidate.name for finding in self.chosen],
                "errors": asdict(self.errors),
                "saving": _saving(self.saving) if self.saving is not None else None,
                "refuted": [finding.candidate.name for finding in self.refuted],
            },
            "sentence": self.sentence(),
        }

    def _row(self, finding: Finding) -> dict[str, Any]:
        candidate = finding.candidate
        return {
            "kind": candidate.kind,
            "part": candidate.part,
            "name": candidate.name,
            "errors": asdict(finding.errors),
            "saving": _saving(finding.saving),
            "proposed": finding in self.chosen,
        }

    def rows(self) -> list[dict[str, object]]:
        """The findings as flat rows, for a table in a file."""
        rows = []
        for finding in self.findings:
            row = self._row(finding)
            errors, saving = row.pop("errors"), row.pop("saving")
            rows.append({**row, **errors, **{f"{name}_ms": ms for name, ms in saving.items()}})
        return rows

    def table(self) -> str:
        """One line per candidate: what its loss does to the picture, and what it saves."""
        if not self.findings:
            return ""
        wide = max(len(finding.candidate.name) for finding in self.findings)
        width, height = self.size
        lines = [
            f"{self.setup.name} at {width}x{height}, {self.renderer}: each of these dropped alone;",
            "errors as shown in [0, 1]; ms saved with the interval that holds the median (99 %);",
            f"none: no more than the noise, {self.findings[0].saving.floor:.2g} ms",
            f"  {'without':<{wide}}{'RMSE':>9}{'max':>8}{'FLIP':>9}{'codes off':>11}   ms saved",
        ]
        for finding in self.findings:
            errors, mark = finding.errors, "*" if finding in self.chosen else " "
            lines.append(
                f"{mark} {finding.candidate.name:<{wide}}{errors.rmse:>9.2g}{errors.max:>8.2g}"
                f"{errors.of('flip'):>9.2g}{100 * errors.off:>9.2f} %   {finding.saving}"
            )
        return "\n".join(lines)

    def sentence(self) -> str:
        """What to do, in one sentence, with what it costs and what it brings."""
        if not self.findings:
            return f"{self.setup.name} has nothing that could be dropped."
        if self.refuted:
            names = _listed(finding.candidate.name for finding in self.refuted)
            return f"Dropping {names} saves no time when measured again: nothing is proposed."
        if self.saving is None:
            idle = [f.candidate.name for f in self.findings if f.errors.max == 0.0]
            more = f"; without effect on the picture: {_listed(idle)}" if idle else ""
            noise = self.findings[0].saving.floor
            return (
                f"Nothing that saves more than {noise:.2g} ms, the noise, can be dropped from "
                f"{self.setup.name} within {self.metric.upper()} {self.budget:g}{more}."
            )
        names = _listed(finding.candidate.name for finding in self.chosen)
        saved, full = self.saving.saved, self.saving.full
        error = self.errors.of(self.metric)
        return (
            f"Dropping {names} saves {saved:.3g} of {full:.3g} ms a picture, "
            f"{100 * saved / full:.0f} % "
            f"({self.metric.upper()} {error:.2g}, budget {self.budget:g})."
        )


def _saving(saving: Saving) -> dict[str, float]:
    return {**asdict(saving), "saved": saving.saved}


def _listed(names: Iterable[str]) -> str:
    *most, last = names
    return f"{', '.join(most)} and {last}" if most else last
