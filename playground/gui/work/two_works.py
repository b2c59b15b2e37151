"""What both measurements of the window hold: pictures drawn in frames, the reference aside."""

from __future__ import annotations

from typing import Any, Generic, TypeVar

from playground.gui.work.long_work import LongWork
from playground.scene.setup import Setup

Drawn = TypeVar("Drawn")
Exact = TypeVar("Exact")


class TwoWorks(Generic[Drawn, Exact]):
    """One work on the GPU, in the window's own thread, and one of the float64 reference."""

    def __init__(self, context: Any) -> None:
        self._context = context
        self._of: Setup | None = None
        self._drawn: LongWork[Drawn] | None = None
        self._exact: LongWork[Exact] | None = None

    def stop(self) -> None:
        """Let go of what was being measured."""
        if self._drawn is not None:
            self._drawn.stop()
        if self._exact is not None:
            self._exact.stop()
        self._of = self._drawn = self._exact = None

    def close(self) -> None:
        """Stop and free the GPU memory, while the context is still there."""
        exact = self._exact
        self.stop()
        if exact is not None:
            exact.close()
