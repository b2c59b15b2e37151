"""Holds a student's functions against the right ones, and names the likely mistake.

An assignment has tasks: functions of rows of arguments, what is right, and how people get
it wrong. A student's answer that equals a wrong one on all cases was probably made the same way.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Protocol

import numpy as np

from playground.errors import PlaygroundError
from playground.files import make_folder, write_whole
from playground.lesson.assignments import ASSIGNMENTS
from playground.lesson.figures import side_by_side
from playground.lesson.page import png
from playground.render.image import Image
from playground.shading.vector import Array

Arrays = tuple[Array, ...]  # one per argument, each with a row per case
Answer = Callable[..., Array]


class Student(Protocol):
    """Someone's functions, in whatever language; ``tolerance`` is what their arithmetic may err.

    Where a function is not there or not written yet, `missing` says so and `call` gives zeros.
    """

    tolerance: float

    def missing(self, name: str) -> str:
        """Why there is no such function, or nothing."""

    def call(self, name: str, arguments: Arrays) -> Array:
        """The results (N, width) for N rows of arguments."""


@dataclass(frozen=True)
class Task:
    """A function to write: its arguments, what is right, named mistakes, and cases (N, k).

    ``width`` is how many numbers it returns: three, a colour or vector, or one.
    """

    name: str
    arguments: tuple[str, ...]
    right: Answer
    wrong: Mapping[str, Answer]
    cases: Arrays
    width: int = 3


@dataclass(frozen=True)
class Assignment:
    """Tasks, and a ``picture`` that is made with all of them."""

    title: str
    tasks: tuple[Task, ...]
    picture: Callable[[Student], Image]


@dataclass(frozen=True)
class Verdict:
    """What was found of one task."""

    task: Task
    wrong: int  # cases
    likely: str  # the mistake, if one is known
    example: str  # the first wrong case


class Right:
    """The student who makes no mistakes."""

    tolerance = 0.0

    def __init__(self, assignment: Assignment) -> None:
        self._tasks = {task.name: task for task in assignment.tasks}

    def missing(self, name: str) -> str:
        """Nothing is."""
        return ""

    def call(self, name: str, arguments: Arrays) -> Array:
        """What is right."""
        return self._tasks[name].right(*arguments)


def assignment_of(lesson: Path) -> Assignment:
    """The assignment of a lesson.

    Raises
    ------
    PlaygroundError
        It has none.
    """
    head = lesson.stem.partition("_")[0]
    if not head.isdigit() or int(head) not in ASSIGNMENTS:
        known = ", ".join(map(str, ASSIGNMENTS))
        raise PlaygroundError(
            "this lesson has no assignment", got=lesson.name, allowed=f"lesson {known}"
        )
    found = import_module(ASSIGNMENTS[int(head)]).ASSIGNMENT
    assert isinstance(found, Assignment)
    return found


def judge(task: Task, student: Student) -> Verdict:
    """Hold one function of the student against the right one."""
    missing = student.missing(task.name)
    if missing:
        return Verdict(task, len(task.cases[0]), missing, "")
    with np.errstate(all="ignore"):  # a mistake may divide by zero
        right, got = task.right(*task.cases), student.call(task.name, task.cases)
        off = np.asarray(~_equal(got, right, student.tolerance).all(axis=1))
        if not off.any():
            return Verdict(task, 0, "", "")
        likely = (
            text
            for text, answer in task.wrong.items()
            if _equal(got, answer(*task.cases), student.tolerance).all()
        )
        return Verdict(task, int(off.sum()), next(likely, ""), _example(task, off, got, right))


def run_check(lesson: Path, file: Path, output: Path | None) -> int:
    """Check a student's file and print what is right; returns 0 if all is, else 1.

    The picture "right, yours, difference" goes into the folder ``output``, or beside the file.

    Raises
    ------
    PlaygroundError
        The lesson has no assignment, or the file cannot be read or run.
    """
    from playground.lesson.student import open_student

    assignment = assignment_of(lesson)
    if output is not None:
        make_folder(output)
    student = open_student(file, assignment)
    verdicts = [judge(task, student) for task in assignment.tasks]
    print(f"{assignment.title}: {file}")
    for verdict in verdicts:
        print(_told(verdict))
    place = (output or file.parent) / f"{file.stem}-check.png"
    print(f"picture: {place}: right, yours, difference; {_compared(assignment, student, place)}")
    return int(any(verdict.wrong for verdict in verdicts))


def _compared(assignment: Assignment, student: Student, place: Path) -> str:
    from playground.measure.compare import compare

    with np.errstate(all="ignore"):
        right, yours = assignment.picture(Right(assignment)), assignment.picture(student)
    difference = compare(right, yours)
    row = [right, yours, difference.heatmap(1.0)]
    write_whole(place, png(side_by_side(row, ["right", "yours", "difference"])))
    return f"they differ by at most {difference.max:.2g}"


def _equal(a: Array, b: Array, tolerance: float) -> Array:
    """Where the numbers agree, NaN with NaN; relative to the larger of the number and 1."""
    return np.isclose(a, b, rtol=tolerance, atol=tolerance, equal_nan=True)


def _example(task: Task, off: Array, got: Array, right: Array) -> str:
    i = int(np.argmax(off))
    rows = [(name, column[i]) for name, column in zip(task.arguments, task.cases, strict=True)]
    rows += [("expected", right[i]), ("got", got[i])]
    return "\n".join(f"    {name:10} {_written(value)}" for name, value in rows)


def _written(value: Array) -> str:
    numbers = ", ".join(f"{x:.4g}" for x in np.atleast_1d(value))
    return f"({numbers})" if np.ndim(value) else numbers


def _told(verdict: Verdict) -> str:
    total = len(verdict.task.cases[0])
    if not verdict.wrong:
        return f"{verdict.task.name}: right in all {total} cases"
    if not verdict.example:
        return f"{verdict.task.name}: {verdict.likely}"
    lines = [f"{verdict.task.name}: wrong in {verdict.wrong} of {total} cases; the first is"]
    lines.append(verdict.example)
    lines.append(f"    likely: {verdict.likely or 'none of the mistakes that are known here'}")
    return "\n".join(lines)
