"""One thing that a thread computes, always for what was asked last."""

from __future__ import annotations

from collections.abc import Callable, Generator
from typing import Generic, TypeVar

from playground.errors import PlaygroundError
from playground.gui.work.aside import Aside

Item = TypeVar("Item")


class Latest(Generic[Item]):
    """The newest item of a question: each better than the one before, or the only one.

    Until there is one, the item of the question before stays.
    """

    def __init__(self) -> None:
        self.item: Item | None = None
        self.error = ""
        self._asked: object = None
        self._aside: Aside[Item] | None = None

    def ask(
        self, question: object, items: Callable[[], Generator[Item, None, None]]
    ) -> Item | None:
        """The newest item for ``question``; another question makes ``items`` anew."""
        self._take()
        if question != self._asked and self._aside is not None:
            self._aside.stop()
        if question != self._asked and not self.working:
            self._asked, self.error = question, ""
            self._aside = Aside(items())
        return self.item

    @property
    def working(self) -> bool:
        """Whether a better item may come."""
        return self._aside is not None

    def rest(self) -> None:
        """Nothing is asked for any more; what is being made is left to end by itself."""
        if self._aside is not None:
            self._aside.stop()
        self.item, self._asked, self._aside, self.error = None, None, None, ""

    def close(self) -> None:
        """Stop, and wait a little for the thread."""
        if self._aside is not None:
            self._aside.close()
        self.rest()

    def _take(self) -> None:
        aside = self._aside
        if aside is None:
            return
        ended = not aside.working  # asked before the last items are taken, not after
        for item in aside.take():
            self.item = item
        if not ended:
            return
        self._aside = None
        if isinstance(aside.error, PlaygroundError):
            self.item, self.error = None, str(aside.error)
        elif aside.error is not None:
            raise aside.error
