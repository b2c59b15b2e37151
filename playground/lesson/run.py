"""Runs a lesson step by step; what goes wrong in a cell is told with file and line."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from playground.lesson.mistake import LessonError
from playground.lesson.parts import Lesson, Page, Text
from playground.lesson.percent import Cell
from playground.lesson.record import Recorder
from playground.lesson.script import blocks_of
from playground.lesson.words import recording
from playground.scene.setup import Setup


class Running:
    """A lesson under way: its steps run one after the other, in one namespace."""

    def __init__(self, lesson: Lesson, live: bool = False) -> None:
        self.lesson = lesson
        self.pages: list[Page] = []
        self._recorder = Recorder(lesson.path, live)
        self._names: dict[str, Any] = {"__name__": "__main__", "__file__": str(lesson.path)}
        self._goals: list[tuple[Callable[[Setup], object], ...]] = []

    def step(self) -> Page:
        """Run the next step.

        Raises
        ------
        LessonError
            A cell fails, or the prose names a number that is not known.
        """
        step = self.lesson.steps[len(self.pages)]
        self._recorder.begin()
        line = step.line
        try:
            with recording(self._recorder):
                for cell in step.cells:
                    line = cell.line
                    if cell.prose:
                        self._recorder.say(Text(blocks_of(cell, self.lesson.path)))
                    else:
                        self._execute(cell)
            line = step.line
            page = self._recorder.page(step)
        except LessonError:
            raise
        except (Exception, SystemExit) as error:
            raise mistake(error, self.lesson.path, line) from error
        self.pages.append(page)
        self._goals.append(tuple(self._recorder.goals))
        return page

    def reached(self, step: int, goal: int, setup: Setup) -> bool:
        """Whether a goal of a step that has run is reached by ``setup``.

        Raises
        ------
        LessonError
            The lesson's own function fails.
        """
        try:
            return bool(self._goals[step][goal](setup))
        except (Exception, SystemExit) as error:
            raise mistake(error, self.lesson.path, self.lesson.steps[step].line) from error

    def _execute(self, cell: Cell) -> None:
        path = str(self.lesson.path)
        source = "\n" * (cell.line - 1) + cell.text  # so that Python counts lines as the file does
        exec(compile(source, path, "exec", dont_inherit=True), self._names)


def mistake(error: BaseException, path: Path, line: int) -> LessonError:
    """The error with the line of the lesson in which it arose."""
    if isinstance(error, SyntaxError) and error.filename == str(path):
        return LessonError(path, error.lineno or line, f"syntax error: {error.msg}")
    said = str(error) or "no reason given"
    if type(error).__module__.partition(".")[0] != "playground":
        said = f"{type(error).__name__}: {said}"
    return LessonError(path, line_in(error, path, line), said)


def line_in(error: BaseException, path: Path, line: int = 1) -> int:
    """The innermost line of a file that an error went through; ``line`` if it went through none."""
    trace = error.__traceback__
    while trace is not None:
        if trace.tb_frame.f_code.co_filename == str(path):
            line = trace.tb_lineno
        trace = trace.tb_next
    return line
