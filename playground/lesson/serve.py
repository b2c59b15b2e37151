"""A lesson in a process of its own, for a window that must not wait.

Requests come as pickles on stdin and are answered one by one on stdout; see `answer`.
A process can be ended at any moment, whatever a cell is doing, and it may use GL as it likes.
"""

from __future__ import annotations

import os
import pickle
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

from playground.errors import PlaygroundError
from playground.lesson.formula import Mask, mask
from playground.lesson.parts import Page
from playground.lesson.run import Running
from playground.lesson.script import read_lesson
from playground.scene.setup import Setup


@dataclass(frozen=True)
class RunNext:
    """Run the next step; answered by its page."""


@dataclass(frozen=True)
class Reached:
    """Say whether a goal of a step that has run is reached; answered by a bool."""

    step: int
    goal: int
    setup: Setup


@dataclass(frozen=True)
class Typeset:
    """Typeset a formula in letters so many pixels high; answered by a mask."""

    formula: str
    size: float


@dataclass(frozen=True)
class Complaint:
    """The answer to what went wrong."""

    text: str


Request = RunNext | Reached | Typeset
Answer = Page | bool | Mask | Complaint


def answer(running: Running, request: Request) -> Answer:
    """What a request is answered with."""
    try:
        if isinstance(request, RunNext):
            return running.step()
        if isinstance(request, Reached):
            return running.reached(request.step, request.goal, request.setup)
        return mask(request.formula, request.size)
    except PlaygroundError as error:
        return Complaint(str(error))


def serve(path: Path, requests: BinaryIO, answers: BinaryIO) -> None:
    """Answer requests until there are no more."""
    running: Running | None = None
    while True:
        try:
            request = pickle.load(requests)
        except EOFError:
            return
        try:
            running = running or Running(read_lesson(path), live=True)
            given = answer(running, request)
        except PlaygroundError as error:
            given = Complaint(str(error))
        pickle.dump((request, given), answers, protocol=pickle.HIGHEST_PROTOCOL)
        answers.flush()


def main(path: str) -> None:
    """What the process does; what a lesson prints goes to stderr, out of the way of answers."""
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    serve(Path(path), sys.stdin.buffer, answers)


if __name__ == "__main__":
    from playground.lesson import serve as module  # pickles name the classes of this module

    module.main(sys.argv[1])
