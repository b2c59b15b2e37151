"""A student's file: functions in Python, called row by row, or in GLSL, run on the GPU."""

from __future__ import annotations

from _thread import interrupt_main
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from threading import Event, Lock, Timer
from typing import TYPE_CHECKING, Any

import numpy as np

from playground.errors import PlaygroundError
from playground.files import read_bytes
from playground.lesson.mistake import LessonError
from playground.lesson.run import line_in, mistake
from playground.shading.vector import Array

if TYPE_CHECKING:
    from playground.lesson.assignment import Arrays, Assignment, Student

UNWRITTEN = "not written yet"
PATIENCE = 60.0  # seconds for all calls of a function, which take less than one if they are right


def open_student(file: Path, assignment: Assignment) -> Student:
    """The functions in a .py or .glsl file.

    Raises
    ------
    PlaygroundError
        Another suffix; no such file; or it fails when it is read, with file and line.
    """
    if file.suffix == ".py":
        return PythonStudent(file, assignment)
    if file.suffix == ".glsl":
        return GlslStudent(file, assignment)
    raise PlaygroundError("an assignment is Python or GLSL", got=str(file), allowed=".py or .glsl")


@contextmanager
def limited(file: Path) -> Iterator[None]:
    """Stop what a student's file does, if it does not come to an end by itself.

    Raises
    ------
    LessonError
        It did not; with the line in which it was.
    """
    late, over, turn = Event(), Event(), Lock()

    def interrupt() -> None:
        with turn:
            if not over.is_set():
                late.set()
                interrupt_main()

    timer = Timer(PATIENCE, interrupt)
    timer.daemon = True
    timer.start()
    try:
        try:
            yield
        finally:
            with turn:  # an interrupt comes before this, where it is waited for, or never
                over.set()
    except KeyboardInterrupt as error:
        if not late.is_set():  # somebody pressed Ctrl+C
            raise
        raise LessonError(
            file, line_in(error, file), f"no end after {PATIENCE:g} seconds"
        ) from None
    finally:
        timer.cancel()


def text_of(file: Path) -> str:
    """The text of a file.

    Raises
    ------
    PlaygroundError
        It cannot be read, or is not UTF-8.
    """
    try:
        return read_bytes(file).decode("utf-8")
    except UnicodeDecodeError as error:
        raise PlaygroundError(f"{file} is not UTF-8", got=str(error)) from None


class PythonStudent:
    """Functions of single points, in float64."""

    tolerance = 1e-9  # of sums and powers up to 80 in float64: 1e-13 would do for ours

    def __init__(self, file: Path, assignment: Assignment) -> None:
        self._file = file
        self._widths = {task.name: task.width for task in assignment.tasks}
        self._names: dict[str, Any] = {"__name__": "student", "__file__": str(file)}
        try:
            with limited(file):
                exec(compile(text_of(file), str(file), "exec", dont_inherit=True), self._names)
        except PlaygroundError:
            raise
        except (Exception, SystemExit) as error:
            raise mistake(error, file, 1) from error

    def missing(self, name: str) -> str:
        """Whether there is a function, and more in it than the stub has."""
        function = self._names.get(name)
        if not callable(function):
            return f"there is no function {name}"
        ones = [np.ones(3)] * function.__code__.co_argcount if _plain(function) else []
        try:
            with np.errstate(all="ignore"), limited(self._file):  # ones are no directions
                function(*ones)
        except NotImplementedError:
            return UNWRITTEN
        except LessonError:
            raise
        except (Exception, SystemExit):  # told, with its line, when the cases are run
            return ""
        return ""

    def call(self, name: str, arguments: Arrays) -> Array:
        """The results for each row, (N, width); zeros where it is not written.

        Raises
        ------
        LessonError
            The function fails, or gives another number of numbers.
        """
        function: Callable[..., Any] | None = self._names.get(name)
        width = self._widths[name]
        if function is None or self.missing(name):
            return np.zeros((len(arguments[0]), width))
        try:
            with limited(self._file):
                rows = zip(*arguments, strict=True)
                made = [function(*(np.array(a) for a in row)) for row in rows]
        except LessonError:
            raise
        except (Exception, SystemExit) as error:
            raise mistake(error, self._file, 1) from error
        with suppress(TypeError, ValueError):
            results = np.array(made, dtype=np.float64)
            if results.shape == (len(made), 3)[: 1 + (width > 1)]:
                return results.reshape(-1, width)
        line = function.__code__.co_firstlineno if _plain(function) else 1
        wanted = "a colour: three numbers" if width > 1 else "one number"
        raise LessonError(self._file, line, f"{name} must return {wanted}", got=repr(made[0]))


class GlslStudent:
    """Functions of GLSL, in float32 on the GPU."""

    tolerance = 1e-4  # float32: 80 · 2^-24 in a power of 80, times about ten roundings

    def __init__(self, file: Path, assignment: Assignment) -> None:
        self._file, self._text = file, text_of(file)
        self._tasks = {task.name: task for task in assignment.tasks}

    def missing(self, name: str) -> str:
        """Whether there is a function, and more in it than the stub has."""
        if f" {name}(" not in self._text:
            return f"there is no function {name}"
        task = self._tasks[name]
        return "" if self._run(name, task.cases).any() else UNWRITTEN

    def call(self, name: str, arguments: Arrays) -> Array:
        """The results for each row, (N, width); zeros where it is not written.

        Raises
        ------
        PlaygroundError
            It does not compile, or there is no GL driver.
        """
        if f" {name}(" not in self._text:
            return np.zeros((len(arguments[0]), self._tasks[name].width))
        return self._run(name, arguments)

    def _run(self, name: str, arguments: Arrays) -> Array:
        from playground.lesson.glsl_rows import run_rows

        width = self._tasks[name].width
        return run_rows(self._text, str(self._file), name, arguments, width)


def _plain(function: Any) -> bool:
    return hasattr(function, "__code__")
