"""Work beside the window: a generator that a thread of its own runs, item by item.

For what needs no GL: NumPy lets the window go on drawing while it computes.
"""

from __future__ import annotations

from collections.abc import Generator
from queue import Empty, SimpleQueue
from threading import Event, Thread
from typing import Generic, TypeVar

Item = TypeVar("Item")
PATIENCE = 2.0  # seconds that closing waits for the item that is being made


class Aside(Generic[Item]):
    """Items made on a thread; take what is ready, stop when no more are wanted."""

    def __init__(self, items: Generator[Item, None, None]) -> None:
        self._items, self._ready = items, SimpleQueue[Item]()
        self._stop = Event()
        self.error: Exception | None = None
        self._thread = Thread(target=self._make, name="measuring", daemon=True)
        self._thread.start()

    def _make(self) -> None:
        try:
            for item in self._items:
                if self._stop.is_set():
                    return
                self._ready.put(item)
        except Exception as error:  # told by the panel that asked for the items
            self.error = error
        finally:
            self._items.close()

    def take(self) -> tuple[Item, ...]:
        """The items that have become ready since the last time."""
        found = []
        try:
            while True:
                found.append(self._ready.get_nowait())
        except Empty:
            return tuple(found)

    @property
    def working(self) -> bool:
        """Whether more may come."""
        return self._thread.is_alive() or not self._ready.empty()

    def stop(self) -> None:
        """Want no more; the item that is being made is thrown away."""
        self._stop.set()

    def close(self) -> None:
        """Stop, and wait a little."""
        self.stop()
        self._thread.join(PATIENCE)
