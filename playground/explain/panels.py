"""Pictures side by side with captions under them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from playground import locate
from playground.scene.setup import Setup

if TYPE_CHECKING:
    from PIL.ImageFont import FreeTypeFont

MARGIN, PAPER, INK = 12, (255, 255, 255), (20, 20, 24)
SMALLEST = 7  # pixels of text; below, nobody could read it


@dataclass(frozen=True, eq=False)
class Panel:
    """One picture, 8-bit codes (H, W, 3), and the line under it."""

    codes: NDArray[np.uint8]
    caption: str


@dataclass(frozen=True, eq=False)
class Sheet:
    """A laid-out figure: 8-bit codes (H, W, 3), what it shows, and what was checked.

    ``error`` is the largest difference between the sum of the four terms' pictures and
    the picture of their sum (sheet "terms" only, else None).
    """

    codes: NDArray[np.uint8]
    setup: Setup
    message: str
    error: float | None = None


def lay_out(
    rows: Sequence[Sequence[Panel]], heading: str = "", footer: str = "", letters: int = 13
) -> NDArray[np.uint8]:
    """The panels in rows on white paper, with a heading above and a footer below; (H, W, 3).

    Their lines are ``letters`` pixels high at least, where there is room.
    """
    from PIL import Image, ImageDraw

    height, width = rows[0][0].codes.shape[:2]
    columns = max(len(row) for row in rows)
    across = columns * (width + MARGIN) - MARGIN
    text = max(letters, round(height / 17))
    font = _fitting(text, [panel.caption for row in rows for panel in row], width)
    title, small = _fitting(text, [heading], across), typeface(max(11, round(0.8 * text)))
    line, notes = round(1.7 * text), _wrapped(footer, small, across)
    above = line + MARGIN if heading else MARGIN
    below = round(1.4 * small.size) * len(notes) + MARGIN
    size = (across + 2 * MARGIN, above + len(rows) * (height + line) + below)
    paper = Image.new("RGB", size, PAPER)
    draw = ImageDraw.Draw(paper)
    draw.text((MARGIN, (line + MARGIN) / 2), heading, INK, title, "lm")
    for i, row in enumerate(rows):
        for j, panel in enumerate(row):
            x, y = MARGIN + j * (width + MARGIN), above + i * (height + line)
            paper.paste(Image.fromarray(panel.codes), (x, y))
            draw.text((x + width / 2, y + height + line / 2), panel.caption, INK, font, "mm")
    for i, note in enumerate(notes):
        y = size[1] - below + round(1.4 * small.size) * (i + 0.5)
        draw.text((MARGIN, y), note, INK, small, "lm")
    return np.asarray(paper)


def typeface(size: float) -> FreeTypeFont:
    """The typeface of all figures, in pixels."""
    from PIL import ImageFont

    return ImageFont.truetype(str(locate.asset("fonts/DejaVuSans.ttf")), size)


def _fitting(size: float, texts: Sequence[str], width: float) -> FreeTypeFont:
    """A font of at most ``size`` pixels in which every text is at most ``width`` wide."""
    longest = max(typeface(size).getlength(text) for text in texts)
    return typeface(max(SMALLEST, size * min(1.0, width / longest)) if longest else size)


def _wrapped(text: str, font: FreeTypeFont, width: float) -> list[str]:
    """The words of ``text`` in lines of at most ``width`` pixels."""
    lines: list[str] = []
    for word in text.split():
        longer = f"{lines[-1]} {word}" if lines else word
        if lines and font.getlength(longer) <= width:
            lines[-1] = longer
        else:
            lines.append(word)
    return lines
