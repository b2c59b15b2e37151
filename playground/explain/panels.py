"""Pictures side by side with captions under them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from playground import locate

MARGIN, PAPER, INK = 12, (255, 255, 255), (20, 20, 24)


@dataclass(frozen=True, eq=False)
class Panel:
    """One picture, 8-bit codes (H, W, 3), and the line under it."""

    codes: NDArray[np.uint8]
    caption: str


def lay_out(
    rows: Sequence[Sequence[Panel]], heading: str = "", footer: str = ""
) -> NDArray[np.uint8]:
    """The panels in rows on white paper, with a heading above and a footer below; (H, W, 3)."""
    from PIL import Image, ImageDraw, ImageFont

    height, width = rows[0][0].codes.shape[:2]
    text = max(13, round(height / 17))
    font = ImageFont.truetype(str(locate.asset("fonts/DejaVuSans.ttf")), text)
    small = ImageFont.truetype(
        str(locate.asset("fonts/DejaVuSans.ttf")), max(11, round(0.8 * text))
    )
    line = round(1.7 * text)
    columns = max(len(row) for row in rows)
    above, below = (line + MARGIN if heading else MARGIN), (line if footer else MARGIN)
    paper = Image.new(
        "RGB",
        (columns * (width + MARGIN) + MARGIN, above + len(rows) * (height + line) + below),
        PAPER,
    )
    draw = ImageDraw.Draw(paper)
    if heading:
        draw.text((MARGIN, (line + MARGIN) / 2), heading, INK, font, "lm")
    for i, row in enumerate(rows):
        for j, panel in enumerate(row):
            x, y = MARGIN + j * (width + MARGIN), above + i * (height + line)
            paper.paste(Image.fromarray(panel.codes), (x, y))
            draw.text((x + width / 2, y + height + line / 2), panel.caption, INK, font, "mm")
    if footer:
        draw.text((MARGIN, paper.height - line / 2), footer, INK, small, "lm")
    return np.asarray(paper)
