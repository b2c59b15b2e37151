"""When an answer passes: the rule of the case files.

For each expected output: a tolerance of ``exact`` asks for equality; any other asks of
every component that |got − expected| <= abs + rel · ‖expected‖, with the Euclidean norm
of the whole output. NaN and infinity never pass; outputs nobody asked for are ignored.
"""

from __future__ import annotations

import math
from typing import Any, Literal, TypeAlias

EXACT = "exact"
Tolerance: TypeAlias = dict[str, float] | Literal["exact"]


def flat(value: Any) -> list[Any]:
    """The components of a number, a (nested) list of them, or an array, in order."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, list | tuple):
        return [component for part in value for component in flat(part)]
    return [value]


def judge(got: Any, expected: Any, tolerance: Tolerance) -> tuple[bool, float]:
    """Whether an output passes, and its worst error in units of its tolerance.

    Without a tolerance the error is 0 if equal and infinite if not.
    """
    have, want = flat(got), flat(expected)
    if tolerance == EXACT:
        equal = have == want
        return equal, 0.0 if equal else math.inf
    if len(have) != len(want):
        return False, math.inf
    assert not isinstance(tolerance, str)
    wanted = [float(x) for x in want]
    norm = math.hypot(*wanted)  # squares would leave the range of float64 long before the norm
    limit = tolerance["abs"] + tolerance["rel"] * norm
    errors = [abs(float(a) - b) for a, b in zip(have, wanted, strict=True)]
    worst = max(errors, default=0.0) if all(map(math.isfinite, errors)) else math.inf
    if limit == 0.0:
        return worst == 0.0, 0.0 if worst == 0.0 else math.inf
    return worst <= limit, worst / limit


def judge_output(
    key: str, got: Any, expected: dict[str, Any], tolerance: Tolerance
) -> tuple[bool, float]:
    """`judge` for output ``key``, where the definition of the case leaves one sign open.

    A singular matrix has no orientation: its normal may point to either side.
    """
    passed, error = judge(got, expected[key], tolerance)
    if not passed and key == "winding_normal" and expected.get("singular") is True:
        return judge([-float(x) for x in flat(got)], expected[key], tolerance)
    return passed, error
