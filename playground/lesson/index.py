"""The page that leads to the handouts of a folder: the lessons, and which slide is where."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

from playground.lesson.library import SlideStep, slide_titles, steps_by_slide
from playground.lesson.page import MORE, PAGE, listed, plural
from playground.lesson.parts import Lesson
from playground.measure.report.page import STYLE

TABLE = "td, th { text-align: left; white-space: normal; }"


def index(lessons: Sequence[Lesson], notes: bool = False) -> str:
    """The page for lessons whose handouts lie beside it; with ``notes``, the lecturer's."""
    minutes = sum(lesson.minutes for lesson in lessons)
    about = f"{len(lessons)} {plural('lesson', len(lessons))}, {minutes:g} minutes"
    heads = "<tr><th></th><th>lesson</th><th>minutes</th><th>slides</th></tr>"
    rows = "\n".join(_lesson(lesson, notes) for lesson in lessons)
    titles = slide_titles(lessons[0].path.parent) if lessons else []
    slides = "\n".join(
        _slide(number, titles[number - 1] if number <= len(titles) else "", steps, notes)
        for number, steps in steps_by_slide(lessons).items()
    )
    body = f"<table>{heads}\n{rows}</table>"
    if slides:
        body += (
            f"\n<h2>Slides</h2>\n<table><tr><th></th><th>slide</th><th>steps</th></tr>"
            f"\n{slides}</table>"
        )
    return PAGE.substitute(
        title="Lighting Playground: lessons",
        style=STYLE + MORE + TABLE,
        heading="Lighting Playground: lessons",
        about=escape(f"{about} · for the lecturer" if notes else about),
        body=body,
    )


def file_name(lesson: Lesson, notes: bool) -> str:
    """The name of a handout."""
    return f"{lesson.path.stem}{'-notes' if notes else ''}.html"


def _lesson(lesson: Lesson, notes: bool) -> str:
    number = "" if lesson.number is None else str(lesson.number)
    link = f'<a href="{file_name(lesson, notes)}">{escape(lesson.title)}</a>'
    cells = [number, link, f"{lesson.minutes:g}", listed(lesson.slides)]
    return "<tr>" + "".join(f"<td>{cell}</td>" for cell in cells) + "</tr>"


def _slide(number: int, title: str, steps: Sequence[SlideStep], notes: bool) -> str:
    links = "<br>".join(
        f'<a href="{file_name(lesson, notes)}#step-{i}">{escape(lesson.name)}.{i}</a> '
        f"{escape(lesson.steps[i - 1].heading)}"
        for lesson, i in steps
    )
    return f"<tr><td>{number}</td><td>{escape(title)}</td><td>{links}</td></tr>"
