"""Where lessons are found: by number, by name, or as a file of one's own."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from playground import locate
from playground.errors import PlaygroundError
from playground.lesson.parts import Lesson
from playground.lesson.script import read_lesson

SlideStep = tuple[Lesson, int]  # a lesson and the number of one of its steps, counted from 1
SLIDES = "slides.txt"  # beside the lessons: the titles of the slides, one a line


def lessons() -> list[Path]:
    """The files of the lessons that come with the project, in order."""
    return sorted(locate.lesson("").glob("[0-9][0-9]_*.py"))


def following(path: Path) -> Path | None:
    """The lesson after one of those that come with the project; None behind the last."""
    every = lessons()
    place = every.index(path) + 1 if path in every else len(every)
    return every[place] if place < len(every) else None


def find(which: str) -> Path:
    """The file of a lesson: ``"7"``, ``"07_specular"``, or a path.

    Raises
    ------
    PlaygroundError
        There is none; the message lists those there are.
    """
    path = Path(which)
    if path.suffix == ".py" and (path.is_file() or len(path.parts) > 1):
        return path
    for file in lessons():
        head, _, name = file.stem.partition("_")
        if which in (file.stem, file.name, name) or (which.isdigit() and int(which) == int(head)):
            return file
    known = ", ".join(str(int(file.stem[:2])) for file in lessons())
    raise PlaygroundError(
        "there is no such lesson",
        got=which,
        allowed=f"{known}, or the path of a lesson of your own (.py)",
    )


def read_all() -> list[Lesson]:
    """Every lesson that comes with the project, read but not run."""
    return [read_lesson(path) for path in lessons()]


def steps_by_slide(lessons: Sequence[Lesson]) -> dict[int, list[SlideStep]]:
    """For each slide of their folder's lecture, in order, the steps that treat it."""
    titles = slide_titles(lessons[0].path.parent) if lessons else []
    found: dict[int, list[SlideStep]] = {number: [] for number in range(1, len(titles) + 1)}
    for lesson in lessons:
        for i, step in enumerate(lesson.steps, 1):
            for slide in step.slides:
                found.setdefault(slide, []).append((lesson, i))
    return dict(sorted(found.items()))


def slide_titles(folder: Path) -> list[str]:
    """The titles of the slides that the lessons of a folder teach; [] where none are written."""
    file = folder / SLIDES
    return file.read_text(encoding="utf-8").splitlines() if file.is_file() else []
