"""Runs one job for the window, in a process of its own: ``python -m`` and the name of this module.

A job comes in on stdin, pickled; its pieces go out on stdout as they are made. When stdin is
closed, the window has gone, and so does this process.
"""

from __future__ import annotations

import os
import pickle
import sys
from threading import Thread
from typing import BinaryIO

from playground.errors import PlaygroundError
from playground.gui.work.process_job import Failed, Finished, Job

LESS = 5  # steps of politeness: the window and its picture go first


def serve(asked: BinaryIO, answers: BinaryIO) -> None:
    """Do the one job that is asked for."""
    job: Job = pickle.load(asked)
    Thread(target=_leave_with, args=(asked,), daemon=True).start()
    try:
        for piece in job.pieces():
            _send(answers, piece)
    except PlaygroundError as error:
        _send(answers, Failed(str(error)))
    except MemoryError:
        _send(answers, Failed("there is not enough memory"))
    else:
        _send(answers, Finished())


def _send(answers: BinaryIO, item: object) -> None:
    pickle.dump(item, answers, protocol=pickle.HIGHEST_PROTOCOL)
    answers.flush()


def _leave_with(asked: BinaryIO) -> None:
    """End at once when the other side is gone.

    Read below Python's buffer: whoever waits in it holds its lock, and an interpreter that ends
    by itself, its job done, would miss that and complain.
    """
    os.read(asked.fileno(), 1)
    os._exit(0)


def main() -> None:
    """Serve on stdin and stdout; what anybody prints goes to stderr."""
    if hasattr(os, "nice"):
        os.nice(LESS)
    answers = os.fdopen(os.dup(sys.stdout.fileno()), "wb")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
    serve(sys.stdin.buffer, answers)


if __name__ == "__main__":
    main()
