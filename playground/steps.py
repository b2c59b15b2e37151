"""Work in steps: generators that yield how far they have come, and return what came of it."""

from __future__ import annotations

from collections.abc import Callable, Generator
from contextlib import closing
from typing import TypeVar

Step = TypeVar("Step")
Word = TypeVar("Word")
Result = TypeVar("Result")


def finished(
    steps: Generator[Step, None, Result], watch: Callable[[Step], object] | None = None
) -> Result:
    """What comes of ``steps``, taken to their end; ``watch`` is called with each."""
    with closing(steps):
        while True:
            try:
                step = next(steps)
            except StopIteration as end:
                result: Result = end.value
                return result
            if watch is not None:
                watch(step)


def retold(
    steps: Generator[Step, None, Result], tell: Callable[[Step], Word]
) -> Generator[Word, None, Result]:
    """The same steps in the words of ``tell``; dropped when these are."""
    with closing(steps):
        while True:
            try:
                step = next(steps)
            except StopIteration as end:
                result: Result = end.value
                return result
            yield tell(step)
