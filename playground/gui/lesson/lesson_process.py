"""The process that runs a lesson for the window: asked one thing at a time, never waited for."""

from __future__ import annotations

import os
import pickle
import subprocess
import sys
from contextlib import suppress
from pathlib import Path
from queue import Empty, SimpleQueue
from threading import Thread

from playground import locate
from playground.lesson.serve import Answer, Request


class LessonProcess:
    """A lesson in `playground.lesson.serve`; `ask` only while it is `idle`.

    Its temporary files go into ``scratch``: a process that is ended cannot remove them itself.
    """

    def __init__(self, path: Path, scratch: str) -> None:
        here = str(locate.PACKAGE.parent)
        found = os.pathsep.join(filter(None, (here, os.environ.get("PYTHONPATH", ""))))
        places = dict.fromkeys(("TMPDIR", "TEMP", "TMP"), scratch)
        self._process = subprocess.Popen(
            [sys.executable, "-m", "playground.lesson.serve", str(path.absolute())],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env=os.environ | {"PYTHONPATH": found} | places,
        )
        self._answers = SimpleQueue[tuple[Request, Answer]]()
        self._waiting: Request | None = None
        self._reader = Thread(target=self._read, name="lesson", daemon=True)
        self._reader.start()

    @property
    def idle(self) -> bool:
        """Whether nothing is being answered."""
        return self._waiting is None

    @property
    def dead(self) -> bool:
        """Whether it has ended by itself; nothing more comes of it."""
        return not self._reader.is_alive() and self._answers.empty()

    def ask(self, request: Request) -> None:
        """Send a request; `take` has the answer when it is there."""
        self._waiting = request
        assert self._process.stdin is not None
        with suppress(OSError):  # it has ended: `dead` says so
            pickle.dump(request, self._process.stdin, protocol=pickle.HIGHEST_PROTOCOL)
            self._process.stdin.flush()

    def take(self) -> tuple[Request, Answer] | None:
        """The request that was answered, with its answer; None while there is none."""
        try:
            found = self._answers.get_nowait()
        except Empty:
            return None
        self._waiting = None
        return found

    def close(self) -> None:
        """End it, whatever it is doing."""
        self._process.kill()
        self._process.wait()
        self._reader.join(1.0)
        for stream in (self._process.stdin, self._process.stdout):
            if stream is not None:
                with suppress(OSError):
                    stream.close()

    def _read(self) -> None:
        assert self._process.stdout is not None
        with suppress(EOFError, OSError, pickle.UnpicklingError, ValueError):
            while True:
                self._answers.put(pickle.load(self._process.stdout))
