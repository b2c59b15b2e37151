"""Long work in a process of its own: not even for a moment does it hold the window up.

Threads of Python take turns; a solver that makes many short steps would leave few of them to
the window. A process that is not wanted any more is killed, whatever it is doing.
"""

from __future__ import annotations

import os
import pickle
import subprocess
import sys
from contextlib import suppress
from queue import Empty, SimpleQueue
from threading import Thread
from time import perf_counter
from typing import Generic, TypeVar

from playground import locate
from playground.errors import PlaygroundError
from playground.gui.work.long_work import Piece, Progress
from playground.gui.work.process_job import Failed, Finished, Job

Item = TypeVar("Item")
PATIENCE = 2.0  # seconds to wait for a thread that has nothing left to read


class ProcessWork(Generic[Item]):
    """Work under way; `take` once a frame, as of `long_work.LongWork`."""

    def __init__(self, job: Job) -> None:
        here = str(locate.PACKAGE.parent)
        found = os.pathsep.join(filter(None, (here, os.environ.get("PYTHONPATH", ""))))
        self._process = subprocess.Popen(
            [sys.executable, "-m", "playground.gui.work.process_serve"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env=os.environ | {"PYTHONPATH": found},
        )
        self._pieces = SimpleQueue[Piece[Item] | Failed | Finished]()
        self._thread = Thread(target=self._talk, args=(job,), name="process", daemon=True)
        self._thread.start()
        self._began = perf_counter()
        self._share: float | None = 0.0
        self.done = False

    def take(self) -> tuple[Item, ...]:
        """What has come of it since the last time.

        Raises
        ------
        PlaygroundError
            What has ended the work.
        """
        found: list[Item] = []
        ended = not self._thread.is_alive()  # asked before the last pieces are taken, not after
        with suppress(Empty):
            while not self.done:
                told = self._pieces.get_nowait()
                if isinstance(told, Failed):
                    raise PlaygroundError(told.words)
                if isinstance(told, Finished):
                    self.done = True
                    break
                self._share = told.share
                found += [] if told.item is None else [told.item]
        if ended and not self.done and not found:
            raise PlaygroundError(
                "the process that computed this has ended by itself",
                fix="Is there enough memory? The terminal may say more.",
            )
        return tuple(found)

    @property
    def progress(self) -> Progress:
        """How far it has come."""
        return Progress(self._share, perf_counter() - self._began)

    def stop(self) -> None:
        """End it, whatever it is doing."""
        self._process.kill()
        self._process.wait()
        self._thread.join(PATIENCE)
        for stream in (self._process.stdin, self._process.stdout):
            if stream is not None:
                with suppress(OSError):
                    stream.close()

    close = stop

    def _talk(self, job: Job) -> None:
        """Send the job and read what comes of it, until nothing does."""
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        with suppress(OSError, EOFError, ValueError, pickle.UnpicklingError):
            pickle.dump(job, self._process.stdin, protocol=pickle.HIGHEST_PROTOCOL)
            self._process.stdin.flush()
            while True:
                self._pieces.put(pickle.load(self._process.stdout))
