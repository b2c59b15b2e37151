"""The percent format: a Python script in cells, which notebooks open as they are.

``# %%`` begins a cell of code and ``# %% [markdown]`` one of prose, whose lines are comments.
Behind the mark may stand options, ``slides=[6, 7] minutes=3 tags=["notes"]``, with
values as in JSON. Source: the percent format of Jupytext and Spyder.
"""

from __future__ import annotations

import json
import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from playground.lesson.mistake import LessonError

MARK = re.compile(r"#\s?%%(.*)")
OPTION = re.compile(r'\s*(\w+)=("[^"]*"|\[[^\]]*\]|[^\s\[\]"]+)')
OPTIONS = ("slides", "minutes", "tags")
HEADER = re.compile(r"\A# ---\n(?:#.*\n)*?# ---\n")  # what Jupytext writes at the top of a file


@dataclass(frozen=True)
class Cell:
    """A cell: its text (prose without the comment signs), and the line of the file it begins in."""

    prose: bool
    text: str
    line: int
    options: dict[str, Any] = field(default_factory=dict, hash=False)

    @property
    def notes(self) -> bool:
        """Whether it is for the lecturer alone."""
        return "notes" in self.options.get("tags", ())


def cells(text: str, path: Path) -> list[Cell]:
    """The cells of a script, those without content left out.

    Raises
    ------
    LessonError
        A line of prose that is no comment, or options that cannot be read.
    """
    header = HEADER.match(text)
    skipped = header[0].count("\n") if header else 0
    made: list[Cell] = []
    begun: tuple[int, str] = (skipped, "")  # line of the mark, and what stands behind it
    lines: list[str] = []
    for number, line in enumerate(text.splitlines()[skipped:], skipped + 1):
        mark = MARK.fullmatch(line.rstrip())
        if mark is None:
            lines.append(line)
            continue
        made += _cell(begun, lines, path)
        begun, lines = (number, mark[1].strip()), []
    return made + _cell(begun, lines, path)


def _cell(begun: tuple[int, str], lines: list[str], path: Path) -> list[Cell]:
    """The cell with these lines, or none if they are empty."""
    number, mark = begun
    if not "".join(lines).strip():
        return []
    prose = mark.startswith(("[markdown]", "[md]"))
    options = _options(mark.partition("]")[2] if prose else mark, path, number) if mark else {}
    if prose:
        lines = [_uncommented(line, path, number + i) for i, line in enumerate(lines, 1)]
    return [Cell(prose, "\n".join(lines), number + 1, options)]


def _uncommented(line: str, path: Path, number: int) -> str:
    if line.strip() and not line.startswith("#"):
        raise LessonError(
            path, number, "prose is written in comments", got=line.strip(), fix="Begin it with '# '"
        )
    return line[1:].removeprefix(" ").rstrip()


def _options(text: str, path: Path, line: int) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for name, value in OPTION.findall(text):
        if name not in OPTIONS:
            known = ", ".join(OPTIONS)
            raise LessonError(path, line, f"unknown option {name}", allowed=known)
        try:
            found[name] = json.loads(value)
        except ValueError:
            raise LessonError(path, line, f"cannot read {name}", got=value) from None
    _check(found, path, line)
    return found


def _check(options: dict[str, Any], path: Path, line: int) -> None:
    """Slides are whole numbers, minutes a number, tags words."""

    def every(name: str, kind: type) -> bool:
        value = options.get(name, [])
        return isinstance(value, list) and all(type(item) is kind for item in value)

    if not every("slides", int):
        raise LessonError(path, line, "slides are numbers", allowed="slides=[6, 7]")
    if not every("tags", str):
        raise LessonError(path, line, "tags are words", allowed='tags=["notes"]')
    minutes = options.get("minutes", 0)
    if type(minutes) not in (int, float) or minutes < 0:
        raise LessonError(path, line, "minutes are a number", allowed="minutes=3")
