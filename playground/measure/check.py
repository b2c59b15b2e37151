"""Numeric cases against the formulas: ``playground check CASES.json``.

Every case is asked of the project's own public functions: float64 in NumPy, or float32 on
the GPU by the very GLSL that the renderer uses. A kind of case that no function answers
is listed with its reason, never left out.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from tqdm import tqdm

from playground.errors import PlaygroundError, unknown_name
from playground.measure.cases.case_file import Case, read_cases
from playground.measure.cases.formulas import FORMULAS
from playground.measure.cases.rule import flat, judge_output
from playground.measure.cases.systems import SYSTEMS

CPU_NOTE = "on the CPU for both backends"


@dataclass(frozen=True)
class Failure:
    """One output that is wrong; ``ratio`` is its error in units of its tolerance."""

    id: str
    key: str
    got: Any
    expected: Any
    ratio: float

    def to_dict(self) -> dict[str, Any]:
        """As JSON writes it: what is not finite becomes text, an infinite ratio null."""
        return {
            "id": self.id,
            "key": self.key,
            "got": _plain(self.got),
            "expected": self.expected,
            "ratio": _finite(self.ratio),
        }


@dataclass
class Tally:
    """The cases of one system, counted; ``worst`` is the largest of their ratios."""

    cases: int = 0
    passed: int = 0
    failed: int = 0
    worst: float | None = None
    unsupported: dict[str, list[str]] = field(default_factory=dict)  # reason -> ids
    note: str = ""

    def to_dict(self) -> dict[str, Any]:
        """Counts, worst error, and the reason of each unsupported case."""
        return {
            "cases": self.cases,
            "passed": self.passed,
            "failed": self.failed,
            "unsupported": sum(map(len, self.unsupported.values())),
            "worst": None if self.worst is None else _finite(self.worst),
            "reasons": self.unsupported,
            "note": self.note,
        }


@dataclass
class Report:
    """What a run over a file found, system by system in the order of the file."""

    backend: str
    systems: dict[str, Tally] = field(default_factory=dict)
    failures: list[Failure] = field(default_factory=list)

    def total(self) -> dict[str, int]:
        """The counts of all systems."""
        tables = [tally.to_dict() for tally in self.systems.values()]
        keys = ("cases", "passed", "failed", "unsupported")
        return {key: sum(table[key] for table in tables) for key in keys}

    def to_dict(self) -> dict[str, Any]:
        """The report as JSON holds it."""
        return {
            "backend": self.backend,
            "total": self.total(),
            "systems": {name: tally.to_dict() for name, tally in self.systems.items()},
            "failures": [failure.to_dict() for failure in self.failures],
        }

    def text(self) -> str:
        """The report for a person: a line per system, then every failure."""
        lines = [f"{'system':<28}{'cases':>6}{'passed':>8}{'failed':>8}{'worst':>9}"]
        for name, tally in self.systems.items():
            counts = f"{name:<28}{tally.cases:>6}{tally.passed:>8}{tally.failed:>8}"
            worst = "-" if tally.worst is None else f"{tally.worst:.2g}"
            notes = [f"{len(ids)} not checked: {why}" for why, ids in tally.unsupported.items()]
            lines.append(f"{counts}{worst:>9}   {'; '.join([*notes, tally.note])}".rstrip("; "))
        for failure in self.failures:
            off = f"{failure.ratio:.3g} tolerances off" if math.isfinite(failure.ratio) else "wrong"
            got, want = json.dumps(_plain(failure.got)), json.dumps(failure.expected)
            lines.append(f"FAILED {failure.id} {failure.key}: {off}; got {got}, expected {want}")
        total = self.total()
        counted = [f"{total[key]} {key}" for key in ("passed", "failed", "unsupported")]
        lines.append(f"{total['cases']} cases ({self.backend}): {', '.join(counted)}")
        return "\n".join(lines)


def run_check(path: Path, backend: str, systems: list[str], as_json: bool) -> int:
    """Check the cases of a file and print the report; status 1 if one failed.

    Raises
    ------
    PlaygroundError
        No such file, not a file of cases, an unknown backend or system, no GL driver.
    """
    if backend not in FORMULAS:
        raise unknown_name("backend", backend, FORMULAS)
    cases = read_cases(path, FORMULAS[backend].precision)
    chosen = _chosen(cases, systems, path)
    report = check(tqdm(chosen, "check", leave=False, disable=None), backend)
    print(json.dumps(report.to_dict()) if as_json else report.text())
    return int(bool(report.failures))


def _chosen(cases: list[Case], systems: list[str], path: Path) -> list[Case]:
    """The cases of the named systems, all if none is named."""
    for name in (*systems, *(case.system for case in cases)):
        if name not in SYSTEMS:
            raise unknown_name("system of numeric cases", name, SYSTEMS)
    present = {case.system for case in cases}
    for name in systems:
        if name not in present:
            raise PlaygroundError(
                f"{path} has no case of this system", got=name, allowed=", ".join(sorted(present))
            )
    return [case for case in cases if not systems or case.system in systems]


def check(cases: Iterable[Case], backend: str) -> Report:
    """Judge every case; ``backend`` is a key of `FORMULAS`."""
    if backend == "gl":
        from playground.render.gl.context import headless

        headless()
    formulas = FORMULAS[backend]()
    report = Report(backend)
    for case in cases:
        tally = report.systems.setdefault(case.system, Tally())
        tally.cases += 1
        system = SYSTEMS[case.system]
        if system.solve is None:
            tally.unsupported.setdefault(system.missing, []).append(case.id)
            continue
        tally.note = CPU_NOTE if system.cpu else ""
        try:
            with np.errstate(all="ignore"):  # NaN and infinity are judged, not announced
                outputs = system.solve(case.inputs, formulas)
        except (ArithmeticError, LookupError, TypeError, ValueError) as error:
            outputs = dict.fromkeys(case.expected, f"{type(error).__name__}: {error}")
        wrong, worst = _judge(case, outputs)
        report.failures += wrong
        tally.passed += not wrong
        tally.failed += bool(wrong)
        tally.worst = max(worst, tally.worst or 0.0)
    return report


def _judge(case: Case, outputs: dict[str, Any]) -> tuple[list[Failure], float]:
    """The outputs of a case that are wrong, and the largest error in units of its tolerance."""
    wrong, worst = [], 0.0
    for key, expected in case.expected.items():
        got = outputs.get(key)
        passed, ratio = False, math.inf
        if all(isinstance(x, bool | int | float) for x in flat(got)):
            passed, ratio = judge_output(key, got, case.expected, case.tolerance[key])
        worst = max(worst, ratio)
        if not passed:
            wrong.append(Failure(case.id, key, got, expected, ratio))
    return wrong, worst


def _finite(number: float) -> float | None:
    return number if math.isfinite(number) else None


def _plain(value: Any) -> Any:
    """``value`` as JSON can hold it; NaN and infinity as text."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, list | tuple):
        return [_plain(part) for part in value]
    if isinstance(value, float) and not math.isfinite(value):
        return str(value)
    return value
