"""The prose of a lesson: a little Markdown, with formulas, and with numbers filled in.

Blocks are headings (###), paragraphs, lines of a list (-), formulas of their own ($$...$$)
and code between lines of ```. In a line: **strong**, *strong*, `code`, $formula$, and
{name} or {name:.1f} for a number that the lesson has computed.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace

from playground.errors import PlaygroundError, unknown_name

MARKS = re.compile(r"`([^`]+)`|\$([^$]+)\$|\*\*([^*]+)\*\*|\*([^*\s][^*]*)\*")
PLACE = re.compile(r"\{([A-Za-z_]\w*)(?::([^{}]*))?\}")
KINDS = ("code", "formula", "strong", "strong")
PLAIN = ("text", "strong")  # kinds of spans that hold words
USUAL = ".3g"  # digits of a number whose place does not say how it is written
POWER = re.compile(r"(.+)e([+-]\d+)")
RAISED = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")
UNIT = re.compile(r"(?<=[\d}]) (?=%|c?m\b)")  # a number and its unit stay in one line


@dataclass(frozen=True)
class Span:
    """A piece of a line: kind ``text``, ``strong``, ``code`` or ``formula``."""

    kind: str
    text: str


@dataclass(frozen=True)
class Block:
    """Kind ``paragraph``, ``item``, ``heading``, ``formula`` or ``code``; the line it begins in."""

    kind: str
    spans: tuple[Span, ...]
    line: int = 0

    @property
    def text(self) -> str:
        """Its characters, without what is strong and what is not."""
        return "".join(span.text for span in self.spans)


def parse(text: str, line: int = 0) -> tuple[Block, ...]:
    """The blocks of a text whose first line is number ``line`` of its file.

    Raises
    ------
    PlaygroundError
        A formula or a piece of code that does not end.
    """
    made: list[Block] = []
    held: list[str] = []  # lines of the block under way
    kind, first, fenced = "paragraph", line, False

    def close() -> None:
        if held:
            made.append(_block(kind, held, first))
        held.clear()

    for number, row in enumerate(text.split("\n"), line):
        if row.startswith("```"):
            close()
            kind, first, fenced = ("paragraph" if fenced else "code"), number, not fenced
        elif fenced:
            held.append(row)
        elif not row.strip():
            close()
            kind = "paragraph"
        else:
            begins = _begins(row)
            if begins != "paragraph" or not held:
                close()
                kind, first = begins, number
            held.append(row)
    if fenced:
        raise PlaygroundError(f"line {first}: the code that begins here has no end (```)")
    close()
    return tuple(made)


def _begins(row: str) -> str:
    if row.startswith("- "):
        return "item"
    return "heading" if row.startswith("#") else "paragraph"


def _block(kind: str, rows: list[str], line: int) -> Block:
    if kind == "code":
        return Block("code", (Span("code", "\n".join(rows)),), line)
    text = " ".join(row.strip() for row in rows)
    if kind == "paragraph" and text.startswith("$$"):
        if len(text) < 5 or not text.endswith("$$") or "$" in text[2:-2]:
            raise PlaygroundError(f"line {line}: this formula does not end with $$", got=text)
        return Block("formula", (Span("formula", text[2:-2].strip()),), line)
    text = text.removeprefix("- ") if kind == "item" else text.lstrip("#").strip()
    return Block(kind, spans(text, line), line)


def spans(text: str, line: int = 0) -> tuple[Span, ...]:
    """The pieces of one line of text."""
    made, end = [], 0
    for match in MARKS.finditer(text):
        if match.start() > end:
            made.append(Span("text", text[end : match.start()]))
        number = match.lastindex or 1
        made.append(Span(KINDS[number - 1], match[number]))
        end = match.end()
    if end < len(text):
        made.append(Span("text", text[end:]))
    if any("$" in span.text or "`" in span.text for span in made if span.kind == "text"):
        raise PlaygroundError(f"line {line}: a $ or ` has no partner", got=text)
    return tuple(
        Span(span.kind, UNIT.sub("\u00a0", span.text)) if span.kind in PLAIN else span
        for span in made
    )


def written(value: float, form: str) -> str:
    """A number as ``form`` says, with a true minus, and powers of ten as one writes them.

    Raises
    ------
    ValueError
        Numbers cannot be written so.
    """
    text = format(value, form)
    power = POWER.fullmatch(text)
    if power is None:
        return text.replace("-", "−")
    exponent = int(power[2])
    if exponent == 0:
        return power[1].replace("-", "−")
    factor = "" if power[1] == "1" else f"{power[1]}·".replace("-", "−")
    return f"{factor}10{str(exponent).translate(RAISED)}"


def filled(block: Block, numbers: Mapping[str, float]) -> Block:
    """The block with its places filled; formulas and code have none, their braces are their own.

    Raises
    ------
    PlaygroundError
        No number of that name, or no such way to write one.
    """

    def in_place(match: re.Match[str]) -> str:
        name, form = match[1], match[2] or USUAL
        if name not in numbers:
            raise unknown_name("number", name, numbers)
        try:
            return written(numbers[name], form)
        except ValueError:
            raise PlaygroundError("a number cannot be written so", got=match[0]) from None

    return replace(
        block,
        spans=tuple(
            Span(span.kind, PLACE.sub(in_place, span.text)) if span.kind in PLAIN else span
            for span in block.spans
        ),
    )


def formulas(blocks: tuple[Block, ...]) -> tuple[str, ...]:
    """Every formula that stands in the blocks."""
    return tuple(span.text for block in blocks for span in block.spans if span.kind == "formula")
