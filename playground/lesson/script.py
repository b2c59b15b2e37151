"""Reads a lesson: title and steps with their slides, minutes and notes. Nothing is run."""

from __future__ import annotations

import re
from functools import lru_cache
from pathlib import Path

from playground.errors import PlaygroundError
from playground.files import read_bytes
from playground.lesson.mistake import LessonError
from playground.lesson.parts import Lesson, Step
from playground.lesson.percent import Cell, cells
from playground.lesson.prose import PLACE, Block, formulas, parse

TITLE, HEADING = re.compile(r"# +(\S.*)"), re.compile(r"## +(\S.*)")


def read_lesson(path: Path) -> Lesson:
    """The lesson in a file.

    Raises
    ------
    PlaygroundError
        The file cannot be read.
    LessonError
        It is no lesson; the message says why, with the line.
    """
    try:
        text = read_bytes(path).decode("utf-8")
    except UnicodeDecodeError as error:
        raise PlaygroundError(f"{path} is not UTF-8", got=str(error)) from None
    found = cells(text, path)
    title = TITLE.match(found[0].text) if found and found[0].prose else None
    if title is None:
        line = found[0].line if found else 1
        fix = "Begin with a cell '# %% [markdown]' whose first line is '# # Title'."
        raise LessonError(path, line, "a lesson begins with its title", fix=fix)
    groups: list[tuple[str, list[Cell]]] = [(title[1], [_without_heading(found[0])])]
    for cell in found[1:]:
        heading = HEADING.match(cell.text) if cell.prose else None
        if heading:
            groups.append((heading[1], [_without_heading(cell)]))
        else:
            groups[-1][1].append(cell)
    return Lesson(path, title[1], tuple(_step(name, group, path) for name, group in groups))


def blocks_of(cell: Cell, path: Path) -> tuple[Block, ...]:
    """The blocks of a cell of prose; mistakes are told with file and line."""
    try:
        return parse(cell.text, cell.line)
    except PlaygroundError as error:
        line = re.match(r"line (\d+): (.*)", str(error), re.DOTALL)
        if line is None:
            raise
        raise LessonError(path, int(line[1]), line[2]) from None


@lru_cache(maxsize=64)
def opening(lesson: Lesson, step: int) -> tuple[Block, ...]:
    """The prose of a step before its first code; nothing where that names numbers."""
    found: list[Block] = []
    for cell in lesson.steps[step].cells:
        if not cell.prose or PLACE.search(cell.text):
            break
        found += blocks_of(cell, lesson.path)
    return tuple(found)


def _without_heading(cell: Cell) -> Cell:
    rest = cell.text.partition("\n")[2]
    return Cell(True, rest, cell.line + 1, cell.options)


def _step(heading: str, group: list[Cell], path: Path) -> Step:
    notes: list[Block] = []
    slides: list[int] = []
    for cell in group:
        slides += cell.options.get("slides", [])
        if cell.prose:
            blocks = blocks_of(cell, path)
            _check_headings(blocks, cell, path)
            _check_formulas(blocks, path)
            notes += blocks if cell.notes else ()
    return Step(
        heading,
        tuple(cell for cell in group if not cell.notes),
        tuple(dict.fromkeys(slides)),
        sum(cell.options.get("minutes", 0) for cell in group),
        tuple(notes),
        group[0].line - 1,
    )


def _check_headings(blocks: tuple[Block, ...], cell: Cell, path: Path) -> None:
    for block in blocks:
        row = cell.text.split("\n")[block.line - cell.line]
        if block.kind == "heading" and not row.startswith("### "):
            raise LessonError(
                path,
                block.line,
                "a heading of a step stands at the head of a cell",
                got=row,
                fix="Write '# %% [markdown]' above it, or use ### within a step.",
            )


def _check_formulas(blocks: tuple[Block, ...], path: Path) -> None:
    for block in blocks:
        for formula in formulas((block,)):
            if formula.count("{") != formula.count("}"):
                raise LessonError(path, block.line, "braces do not match", got=formula)
