"""A file of numeric cases: read whole, and refused with a reason where it is none.

The file is one JSON object. ``cases`` is its list of cases; each has an ``id``, a
``system`` (what kind of problem it is), ``inputs``, the ``expected`` outputs, and for
either precision (``tolerance_f32``, ``tolerance_f64``) a tolerance for every output.
"""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeAlias, TypeGuard

from playground.errors import PlaygroundError, shown, why_unread
from playground.files import read_bytes
from playground.measure.cases.rule import EXACT, Tolerance, flat

FORMAT = 1
Table: TypeAlias = dict[str, Any]


@dataclass(frozen=True)
class Case:
    """One problem, its answer, and how far from it an answer may lie."""

    id: str
    system: str
    inputs: Table
    expected: Table
    tolerance: dict[str, Tolerance]


def read_cases(path: Path, precision: str) -> list[Case]:
    """The cases of a file with their tolerances for ``precision``, "f32" or "f64".

    Raises
    ------
    PlaygroundError
        There is no such file, it is no JSON, or its JSON is not of this format.
    """
    data = read_bytes(path)
    try:
        content = json.loads(data.decode("utf-8-sig"))
    except UnicodeDecodeError as error:
        raise PlaygroundError(f"{path} is not text", got=error.reason, allowed="UTF-8") from None
    except (ValueError, RecursionError) as error:
        raise PlaygroundError(f"{path} is not valid JSON", got=why_unread(error)) from None
    entries = content.get("cases") if isinstance(content, dict) else None
    if not isinstance(entries, list) or not entries:
        raise _no_case_file(path, "it has no list 'cases'", content)
    meta = content.get("meta", {})
    version = meta.get("format", FORMAT) if isinstance(meta, dict) else FORMAT
    if version != FORMAT:
        raise _no_case_file(path, f"its format is not {FORMAT}", version)
    return [_case(path, number, entry, precision) for number, entry in enumerate(entries)]


def _case(path: Path, number: int, entry: Any, precision: str) -> Case:
    if not isinstance(entry, dict):
        raise _no_case_file(path, f"cases[{number}] is no object", entry)
    tolerance_key = f"tolerance_{precision}"
    kinds = {"id": str, "system": str, "inputs": dict, "expected": dict, tolerance_key: dict}
    for key, kind in kinds.items():
        if not isinstance(entry.get(key), kind):
            what = f"cases[{number}].{key} must be {'text' if kind is str else 'an object'}"
            raise _no_case_file(path, what, entry.get(key, "nothing"))
    if not entry["expected"]:
        raise _no_case_file(path, f"cases[{number}].expected must name an output", {})
    for key, value in entry["expected"].items():
        allowed = entry[tolerance_key].get(key)
        if not _is_tolerance(allowed):
            what = f"cases[{number}].{tolerance_key}.{key} must be '{EXACT}' or {{abs, rel}}"
            raise _no_case_file(path, what, allowed)
        if allowed != EXACT and not all(map(_is_number, flat(value))):
            raise _no_case_file(path, f"cases[{number}].expected.{key} must be numbers", value)
    return Case(
        entry["id"], entry["system"], entry["inputs"], entry["expected"], entry[tolerance_key]
    )


def _is_tolerance(value: Any) -> bool:
    if value == EXACT:
        return True
    if not isinstance(value, dict):
        return False
    return all(_is_number(part) and part >= 0 for part in (value.get("abs"), value.get("rel")))


def _is_number(value: Any) -> TypeGuard[float]:
    """Whether it is a number that a float64 can hold."""
    try:
        return isinstance(value, int | float) and math.isfinite(float(value))
    except OverflowError:  # a whole number of hundreds of digits
        return False


def _no_case_file(path: Path, what: str, got: object) -> PlaygroundError:
    return PlaygroundError(
        f"{path} is not a file of numeric cases: {what}",
        got=got if isinstance(got, str) else shown(got),
        fix="tests/stability/open_cases.json is one.",
    )
