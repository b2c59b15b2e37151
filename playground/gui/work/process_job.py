"""What a window and a process of its own say to each other; both import it by this name."""

from __future__ import annotations

from typing import Any, NamedTuple, Protocol

from playground.gui.work.long_work import Pieces


class Job(Protocol):
    """What can be pickled, and then makes pieces."""

    def pieces(self) -> Pieces[Any]:
        """The work, piece by piece."""
        ...


class Failed(NamedTuple):
    """The last thing that a job says which has come to no good end."""

    words: str


class Finished(NamedTuple):
    """The last thing that a job says otherwise."""
