"""Results kept for arguments that cannot be hashed, or only slowly: told apart by identity.

Texts and whole numbers, of which Python makes equal ones anew, are told apart by value.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import ParamSpec, TypeVar

Arguments = ParamSpec("Arguments")
Result = TypeVar("Result")


def kept_for_same(
    count: int,
) -> Callable[[Callable[Arguments, Result]], Callable[Arguments, Result]]:
    """As `functools.lru_cache`, where an argument is known again if it is the same object.

    For values that never change. The last ``count`` arguments are kept with their results,
    so that no new object can stand where a forgotten one stood in memory.
    """

    def decorated(function: Callable[Arguments, Result]) -> Callable[Arguments, Result]:
        kept: list[tuple[tuple[object, ...], Result]] = []

        @wraps(function)
        def remembered(*args: Arguments.args, **more: Arguments.kwargs) -> Result:
            given = (*args, *more.values())
            for known, result in kept:
                if len(known) == len(given) and all(map(_same, known, given)):
                    return result
            made = function(*args, **more)
            kept.insert(0, (given, made))
            del kept[count:]
            return made

        return remembered

    return decorated


def _same(known: object, given: object) -> bool:
    return known is given or (isinstance(given, (int, str)) and known == given)
