"""What ``playground lesson`` does: lists, runs, writes handouts, checks a student's file."""

from __future__ import annotations

import sys
from itertools import chain
from pathlib import Path
from time import perf_counter

from playground.errors import PlaygroundError
from playground.files import make_folder, write_whole
from playground.lesson.formula import svg
from playground.lesson.index import file_name, index
from playground.lesson.library import find, lessons, read_all
from playground.lesson.mistake import LessonError
from playground.lesson.page import page, png
from playground.lesson.parts import Figure, Lesson, Page, Text
from playground.lesson.prose import formulas
from playground.lesson.run import Running
from playground.lesson.script import read_lesson
from playground.lesson.told import by_slide, listed, told

INDEX = "index.html"


def run_lesson(
    which: str,
    output: Path | None = None,
    slides: bool = False,
    notes: bool = False,
    check: Path | None = None,
) -> int:
    """List, run or check; returns the exit status, 1 where a student's file is not right.

    ``which`` is ``"list"``, ``"all"``, a number or a path. With ``output``, a folder, each
    lesson leaves a handout and its figures there, and all of them a page that leads to each;
    without, its text is printed.

    Raises
    ------
    PlaygroundError
        No such lesson, a mistake in it, or a place that cannot be written.
    """
    if check is not None:
        from playground.lesson.assignment import run_check

        if which in ("list", "all"):
            fix = f"For example: playground lesson 7 --check {check}"
            raise PlaygroundError("--check needs the number of a lesson", fix=fix)
        return run_check(find(which), check, output)
    if which == "list":
        chosen = read_all()
        print(by_slide(chosen) if slides else listed(chosen))
        return 0
    paths = lessons() if which == "all" else [find(which)]
    if slides:
        print(by_slide([read_lesson(path) for path in paths]))
        return 0
    if output is not None:
        make_folder(output)
    ran = [_run(path, output, notes) for path in paths]
    if output is not None and which == "all":
        file = output / INDEX
        write_whole(file, index(ran, notes).encode())
        print(file)
    return 0


def _run(path: Path, output: Path | None, notes: bool) -> Lesson:
    began = perf_counter()
    lesson = read_lesson(path)
    running = Running(lesson)
    if output is None:
        print(f"{lesson.title}\n{'=' * len(lesson.title)}\n")
    for i in range(len(lesson.steps)):
        made = running.step()
        if output is None:
            print(told(made, i == 0), end="\n\n")
    if output is not None:
        for file in write_lesson(lesson, running.pages, output, notes):
            print(file)
    print(f"{path.name}  {perf_counter() - began:.1f} s", file=sys.stderr)
    return lesson


def write_lesson(
    lesson: Lesson, pages: list[Page], folder: Path, notes: bool = False
) -> list[Path]:
    """Write the handout of a lesson and its figures; returns the files, the handout first.

    Raises
    ------
    PlaygroundError
        A file cannot be written, or a formula not be typeset.
    """
    for each in pages:
        _typeset(lesson, each)
    text = page(lesson, pages, notes)
    made = [folder / file_name(lesson, notes)]
    write_whole(made[0], text.encode())
    figures = [item for each in pages for item in each.items if isinstance(item, Figure)]
    for i, figure in enumerate(figures, 1):
        made.append(folder / f"{lesson.path.stem}-{i}.png")
        write_whole(made[-1], png(figure.codes))
    return made


def _typeset(lesson: Lesson, made: Page) -> None:
    """Try the formulas of the prose, where the line of a mistake is known."""
    texts = [item.blocks for item in made.items if isinstance(item, Text)]
    for block in chain(made.step.notes, *texts):
        for formula in formulas((block,)):
            try:
                svg(formula)
            except PlaygroundError as error:
                raise LessonError(lesson.path, block.line, str(error)) from None
