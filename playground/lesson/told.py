"""A lesson in a terminal: its text, and the lists of lessons and slides."""

from __future__ import annotations

from textwrap import fill

from playground.lesson.library import slide_titles, steps_by_slide
from playground.lesson.parts import Figure, Goal, Item, Lesson, Page, Question, Text
from playground.lesson.prose import Block

WIDTH = 88


def told(page: Page, first: bool) -> str:
    """A step as text."""
    heading = page.step.heading
    parts = [] if first else [f"{heading}\n{'-' * len(heading)}"]
    parts += [text for item in page.items if (text := _item(item))]
    return "\n\n".join(parts)


def _item(item: Item) -> str:
    if isinstance(item, Text):
        return "\n\n".join(_block(block) for block in item.blocks)
    if isinstance(item, Figure):
        return _lines("[figure] ", item.caption)
    if isinstance(item, Question):
        choices = [_lines(f"  {'abcdefgh'[i]}) ", choice) for i, choice in enumerate(item.choices)]
        return "\n".join([_lines("Predict: ", item.question), *choices])
    if isinstance(item, Goal):
        return _lines("Goal, in the window: ", item.text)
    return ""


def _block(block: Block) -> str:
    if block.kind in ("code", "formula"):
        return "\n".join(f"    {row}" for row in block.text.split("\n"))
    return _lines("- " if block.kind == "item" else "", (block,))


def _lines(head: str, blocks: tuple[Block, ...]) -> str:
    text = head + " ".join(block.text for block in blocks)
    return fill(text, WIDTH, subsequent_indent=" " * len(head) if head.strip() == "-" else "")


def listed(lessons: list[Lesson]) -> str:
    """Number, title, minutes and slides of each lesson."""
    rows = [
        f"{lesson.number or 0:3}  {lesson.title:44}  {lesson.minutes:3g} min  "
        f"{len(lesson.steps)} steps  slides {', '.join(map(str, lesson.slides)) or '-'}"
        for lesson in lessons
    ]
    total = sum(lesson.minutes for lesson in lessons)
    return "\n".join([*rows, f"     {len(lessons)} lessons, {total:g} minutes"])


def by_slide(lessons: list[Lesson]) -> str:
    """For each slide, the steps that treat it: lesson.step, counted from 1."""
    titles = slide_titles(lessons[0].path.parent) if lessons else []
    rows = []
    for slide, steps in steps_by_slide(lessons).items():
        words = [f"{lesson.name}.{i} {lesson.steps[i - 1].heading}" for lesson, i in steps]
        title = titles[slide - 1] if slide <= len(titles) else ""
        rows.append(f"{slide:3}  {title:44}  {'; '.join(words) or '(no lesson yet)'}")
    return "\n".join(rows)
