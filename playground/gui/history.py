"""Undo and redo as a value: moments of the past and of the future.

A moment is any value; equal ones are the same. A drag changes it at every frame and is one
step: while something is *held*, changes join the step that the first of them opened.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Generic, TypeVar

Moment = TypeVar("Moment")

LIMIT = 200  # steps; a setup shares all that did not change with its neighbours


@dataclass(frozen=True)
class History(Generic[Moment]):
    """What undo and redo lead to; the present is not part of it."""

    past: tuple[Moment, ...] = ()
    future: tuple[Moment, ...] = ()
    held: bool = False  # a drag is under way, and its step is already in ``past``

    def record(self, before: Moment, after: Moment, held: bool) -> History[Moment]:
        """The history after a frame that turned ``before`` into ``after``.

        Parameters
        ----------
        before, after : Moment
        held : bool
            Whether the hand has not let go yet: later changes belong to the same step.
        """
        if before is after or before == after:
            return self if held or not self.held else replace(self, held=False)
        if self.held:
            return replace(self, future=(), held=held)
        return History((*self.past, before)[-LIMIT:], (), held)

    def undo(self, present: Moment) -> tuple[History[Moment], Moment]:
        """One step back: the new history and the moment; unchanged where there is no past."""
        if not self.past:
            return self, present
        return History(self.past[:-1], (present, *self.future)), self.past[-1]

    def redo(self, present: Moment) -> tuple[History[Moment], Moment]:
        """One step forward again; unchanged where there is no future."""
        if not self.future:
            return self, present
        return History((*self.past, present), self.future[1:]), self.future[0]
