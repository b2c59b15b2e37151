"""Long work beside the window: in small pieces, with an estimate, and to be stopped at any time.

Work is a generator that yields a `Piece` now and then. What draws with GL runs in the
window's own thread, for a few milliseconds of every frame; NumPy and files go aside, on a
thread, and the window goes on drawing.
"""

from __future__ import annotations

from collections.abc import Generator, Iterator
from dataclasses import dataclass
from time import perf_counter
from typing import Generic, TypeVar

from playground.gui.work.aside import Aside

Item = TypeVar("Item")
BUDGET = 0.008  # seconds of every frame; at least one piece is made


@dataclass(frozen=True)
class Piece(Generic[Item]):
    """How much is done, from 0 to 1 (None where nobody knows), and what has come of it."""

    share: float | None = None
    item: Item | None = None


Pieces = Generator[Piece[Item], None, None]


@dataclass(frozen=True)
class Progress:
    """How far work has come: share from 0 to 1, None where nobody knows; times in seconds."""

    share: float | None = 0.0
    elapsed: float = 0.0

    @property
    def left(self) -> float | None:
        """Seconds still to go if it goes on as before; None where nobody knows."""
        if not self.share:
            return None
        return self.elapsed * (1.0 - self.share) / self.share


class LongWork(Generic[Item]):
    """Work under way; `take` once a frame.

    Parameters
    ----------
    pieces : generator of Piece
    aside : bool
        Whether a thread runs it; not for what needs GL.
    """

    def __init__(self, pieces: Pieces[Item], aside: bool = False) -> None:
        self._pieces = pieces
        self._aside = Aside(pieces) if aside else None
        self._began = perf_counter()
        self._share: float | None = 0.0
        self.done = False

    def take(self) -> tuple[Item, ...]:
        """What has come of it since the last time.

        Raises
        ------
        Exception
            What the work has raised; nothing more comes of it.
        """
        found = []
        for piece in self._steps() if self._aside is None else self._ready(self._aside):
            self._share = piece.share
            if piece.item is not None:
                found.append(piece.item)
        return tuple(found)

    @property
    def progress(self) -> Progress:
        """How far it has come."""
        return Progress(self._share, perf_counter() - self._began)

    def stop(self) -> None:
        """Want no more of it; does not wait."""
        if self._aside is not None:
            self._aside.stop()
        else:
            self._pieces.close()

    def close(self) -> None:
        """Stop, and wait a little for a thread."""
        self.stop()
        if self._aside is not None:
            self._aside.close()

    def _steps(self) -> Iterator[Piece[Item]]:
        until = perf_counter() + BUDGET
        for piece in self._pieces:
            yield piece
            if perf_counter() > until:
                return
        self.done = True

    def _ready(self, aside: Aside[Piece[Item]]) -> Iterator[Piece[Item]]:
        ended = not aside.working  # asked before the last pieces are taken, not after
        yield from aside.take()
        if ended and aside.error is not None:
            raise aside.error
        self.done = ended


def counted(items: Generator[Item, None, None], total: int) -> Pieces[Item]:
    """Work that yields ``total`` items, all about as long; it is closed with this."""
    try:
        for number, item in enumerate(items, 1):
            yield Piece(number / total, item)
    finally:
        items.close()


def part(pieces: Pieces[Item], first: float, last: float) -> Pieces[Item]:
    """Work as a part of other work, which stands at ``first`` before it and ``last`` after."""
    try:
        for piece in pieces:
            share = None if piece.share is None else first + (last - first) * piece.share
            yield Piece(share, piece.item)
    finally:
        pieces.close()


def together(*works: Progress) -> Progress:
    """Of works that go on at the same time: the slowest counts."""
    shares = [work.share for work in works]
    known = [share for share in shares if share is not None]
    slowest = min(known) if len(known) == len(shares) else None
    return Progress(slowest, max(work.elapsed for work in works))
