"""The handout: a lesson as one page of HTML that needs no other file.

With notes it is the lecturer's: notes, answers, and room to count the hands of a class.
"""

from __future__ import annotations

import io
from base64 import b64encode
from collections.abc import Sequence
from html import escape
from string import Template

import numpy as np
from numpy.typing import NDArray

from playground.lesson.formula import svg
from playground.lesson.library import slide_titles
from playground.lesson.parts import Figure, Goal, Item, Lesson, Page, Question, Text
from playground.lesson.prose import Block, Span
from playground.measure.report.page import STYLE

MORE = """
body { max-width: 46rem; } main { font-size: 1.05rem; } h2 { margin-top: 2.6rem; }
figure { margin: 1.6rem 0; } figure img, figure > svg { display: block; max-width: 100%;
height: auto; margin: 0 auto; } figcaption { color: var(--soft); margin-top: .5rem; }
p svg, li svg, summary svg, figcaption svg { overflow: visible; max-width: none; }
.formula { text-align: center; font-size: 1.15em; margin: 1.2rem 0; overflow-x: auto; }
pre { background: #f5f5f5; padding: .8rem; overflow-x: auto; font-size: .82rem; line-height: 1.4; }
code { font-family: ui-monospace, "DejaVu Sans Mono", monospace; font-size: .9em; }
.box { border: 1px solid var(--line); border-radius: 6px; padding: .4rem 1rem; margin: 1.4rem 0; }
.ask { border-left: 5px solid #E69F00; } .goal { border-left: 5px solid #009E73; }
.notes { border-left: 5px solid #7F7F7F; background: #f7f7f7; font-size: .95rem; }
summary { cursor: pointer; color: #0072B2; } ol.choices { list-style: lower-alpha; }
.count { float: right; color: var(--soft); }
@media print { pre { white-space: pre-wrap; } .box { break-inside: avoid; } }
"""
PAGE = Template(
    """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>$title</title>
<style>$style</style>
</head>
<body>
<h1 id="step-1">$heading</h1>
<p class="soft">$about</p>
<main>
$body
</main>
</body>
</html>
"""
)


def page(lesson: Lesson, pages: list[Page], notes: bool = False) -> str:
    """The handout of a lesson that has run; with ``notes``, the lecturer's."""
    number = "" if lesson.number is None else f"{lesson.number}. "
    titles = slide_titles(lesson.path.parent)
    body = [_step(made, i, notes, titles) for i, made in enumerate(pages, 1)]
    return PAGE.substitute(
        title=escape(lesson.title),
        style=STYLE + MORE,
        heading=escape(f"{number}{lesson.title}"),
        about=escape(_about(lesson, notes)),
        body="\n".join(body),
    )


def png(codes: NDArray[np.uint8]) -> bytes:
    """The bytes of a PNG with these 8-bit codes (H, W, 3)."""
    from PIL import Image

    file = io.BytesIO()
    Image.fromarray(codes).save(file, "PNG", optimize=True)
    return file.getvalue()


def _about(lesson: Lesson, notes: bool) -> str:
    words = [f"Lighting Playground, {lesson.path.name}"]
    if lesson.slides:
        words.append(f"{plural('slide', len(lesson.slides))} {listed(lesson.slides)}")
    if lesson.minutes:
        words.append(f"{lesson.minutes:g} {plural('minute', lesson.minutes)}")
    return " · ".join([*words, "for the lecturer"] if notes else words)


def plural(noun: str, count: float) -> str:
    """The noun as it stands behind a number of things."""
    return noun if count == 1 else f"{noun}s"


def listed(values: Sequence[int]) -> str:
    """Numbers with commas between them."""
    return ", ".join(map(str, values))


def _step(made: Page, number: int, notes: bool, titles: list[str]) -> str:
    step = made.step
    parts = [f'<h2 id="step-{number}">{escape(step.heading)}</h2>'] if number > 1 else []
    if notes:
        slides = [f"{n} {titles[n - 1] if n <= len(titles) else ''}".strip() for n in step.slides]
        minutes = f"{step.minutes:g} {plural('minute', step.minutes)}"
        about = [minutes, *(f"slide {slide}" for slide in slides)]
        inside = f'<p class="soft">{escape(" · ".join(about))}</p>{prose(step.notes)}'
        parts.append(f'<div class="box notes">{inside}</div>')
    parts += [_item(item, notes) for item in made.items]
    code = "\n\n".join(cell.text.strip("\n") for cell in step.cells if not cell.prose)
    if code:
        inside = f"<pre><code>{escape(code)}</code></pre>"
        parts.append(f"<details><summary>the code of this step</summary>{inside}</details>")
    return "\n".join(filter(None, parts))


def _item(item: Item, notes: bool) -> str:
    if isinstance(item, Text):
        return prose(item.blocks)
    if isinstance(item, Figure):
        return _figure(item)
    if isinstance(item, Question):
        return _question(item, notes)
    return _goal(item) if isinstance(item, Goal) else ""


def _figure(item: Figure) -> str:
    caption = inline(item.caption)
    picture = item.svg
    if not picture:
        data = b64encode(png(item.codes)).decode()
        alt = escape("".join(block.text for block in item.caption), quote=True)
        picture = f'<img src="data:image/png;base64,{data}" alt="{alt}">'
    return f"<figure>{picture}<figcaption>{caption}</figcaption></figure>"


def _question(item: Question, notes: bool) -> str:
    room = '<span class="count">____ hands</span>' if notes else ""
    choices = "".join(f"<li>{room}{inline(choice)}</li>" for choice in item.choices)
    answer = f"<strong>{'abcdefgh'[item.answer]})</strong> {inline(item.choices[item.answer])}"
    answer = f"<p>{answer}.</p>{prose(item.why)}"
    hidden = answer if notes else f"<details><summary>the answer</summary>{answer}</details>"
    asked = f"<p><strong>Predict.</strong> {inline(item.question)}</p>"
    return f'<div class="box ask">{asked}<ol class="choices">{choices}</ol>{hidden}</div>'


def _goal(item: Goal) -> str:
    hint = f"<details><summary>a hint</summary>{prose(item.hint)}</details>" if item.hint else ""
    return f'<div class="box goal"><p><strong>Goal.</strong> {inline(item.text)}</p>{hint}</div>'


def prose(blocks: tuple[Block, ...]) -> str:
    """Blocks as HTML, the items of a list gathered."""
    made, inside = [], False
    for block in blocks:
        if (block.kind == "item") != inside:
            made.append("</ul>" if inside else "<ul>")
            inside = not inside
        made.append(_block(block))
    return "\n".join([*made, "</ul>"] if inside else made)


def _block(block: Block) -> str:
    if block.kind == "code":
        return f"<pre><code>{escape(block.text)}</code></pre>"
    if block.kind == "formula":
        return f'<p class="formula">{svg(block.text)}</p>'
    tag = {"item": "li", "heading": "h3"}.get(block.kind, "p")
    return f"<{tag}>{inline((block,))}</{tag}>"


def inline(blocks: tuple[Block, ...]) -> str:
    """The words of blocks in one line."""
    return " ".join("".join(map(_span, block.spans)) for block in blocks)


def _span(span: Span) -> str:
    if span.kind == "formula":
        return svg(span.text)
    text = escape(span.text, quote=False)
    return {"strong": f"<strong>{text}</strong>", "code": f"<code>{text}</code>"}.get(
        span.kind, text
    )
