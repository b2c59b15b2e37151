"""Prose with formulas, laid out in lines as wide as there is room, and drawn."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import lru_cache
from typing import NamedTuple

from imgui_bundle import imgui

from playground.gui.lesson.lesson_pictures import LessonPictures, Letters
from playground.lesson.prose import Block, Span

EM = 0.86  # of the font's line height: the size of its letters
BASELINE = 0.797  # of the font's line height, from above; DejaVu Sans
LINE = 1.36  # from line to line, in heights of the text
CODE = 0.9  # height of code, in heights of the text
BULLET = 1.1  # indent of a list, in heights of the text
FIT = 0.98  # of the room, for a formula that is made smaller: its size is rounded
STRONG = 0.045  # how far strong letters are drawn twice, in heights of the text
Sizes = tuple[tuple[str, float, float, float], ...]  # formula, width, height, depth


class Piece(NamedTuple):
    """Something in a line: what it is, and its upper left corner from the start of the block."""

    kind: str
    text: str
    x: float
    y: float


def draw(blocks: tuple[Block, ...], pictures: LessonPictures, faint: bool = False) -> None:
    """Write blocks from the cursor on, as wide as the window."""
    for block in blocks:
        _block(block, pictures, faint)


def order(blocks: tuple[Block, ...], pictures: LessonPictures) -> None:
    """Ask for the formulas of blocks that are not shown yet."""
    room = imgui.get_content_region_avail().x
    for block in blocks:
        for span in block.spans:
            if span.kind == "formula":
                _letters(span.text, block, pictures, room)


def _block(block: Block, pictures: LessonPictures, faint: bool) -> None:
    size, room = imgui.get_font_size(), imgui.get_content_region_avail().x
    if block.kind == "code":
        return _code(block)
    indent = BULLET * size if block.kind == "item" else 0.0
    letters = {
        span.text: found
        for span in block.spans
        if span.kind == "formula"
        and (found := _letters(span.text, block, pictures, room)) is not None
    }
    dense = imgui.get_io().display_framebuffer_scale.x
    sizes = tuple(
        (f, m.width / dense, m.height / dense, m.depth / dense) for f, m in letters.items()
    )
    pieces, width, height = laid_out(block.spans, room - indent, size, sizes)
    start = imgui.get_cursor_screen_pos()
    left = start.x + indent
    if block.kind == "formula":
        left += max(0.0, 0.5 * (room - width))
    imgui.dummy(imgui.ImVec2(room, height))
    if not imgui.is_item_visible():
        return None
    colour = imgui.get_color_u32(imgui.Col_.text_disabled if faint else imgui.Col_.text)
    if block.kind == "item":
        imgui.get_window_draw_list().add_text(
            imgui.ImVec2(start.x + 0.3 * size, start.y + pieces[0].y), colour, "•"
        )
    strong = block.kind == "heading"
    for piece in pieces:
        _piece(piece, imgui.ImVec2(left + piece.x, start.y + piece.y), colour, letters, strong)
    return None


def _letters(formula: str, block: Block, pictures: LessonPictures, room: float) -> Letters | None:
    """The formula, in smaller letters where it would be wider than the room."""
    larger = 1.15 if block.kind == "formula" else 1.0
    dense = imgui.get_io().display_framebuffer_scale.x
    size = EM * larger * imgui.get_font_size() * dense
    found = pictures.formula(formula, size)
    if found is None or found.width <= room * dense:
        return found
    return pictures.formula(formula, FIT * size * room * dense / found.width) or found


def _piece(
    piece: Piece, at: imgui.ImVec2, colour: int, letters: dict[str, Letters], strong: bool
) -> None:
    paint, size = imgui.get_window_draw_list(), imgui.get_font_size()
    if piece.kind == "formula" and piece.text in letters:
        made, dense = letters[piece.text], imgui.get_io().display_framebuffer_scale.x
        at = imgui.ImVec2(round(at.x), round(at.y))  # whole pixels: letters stay crisp
        low = imgui.ImVec2(at.x + made.width / dense, at.y + made.height / dense)
        reference = imgui.ImTextureRef(made.texture.glo)
        paint.add_image(reference, at, low, imgui.ImVec2(0, 0), imgui.ImVec2(1, 1), colour)
        return
    font = imgui.get_font()
    if piece.kind == "code":
        font = imgui.get_io().fonts.fonts[1]
        size = round(CODE * size)  # whole pixels: thin strokes stay
    paint.add_text(font, size, at, colour, piece.text)
    if strong or piece.kind == "strong":
        paint.add_text(font, size, imgui.ImVec2(at.x + STRONG * size, at.y), colour, piece.text)


@lru_cache(maxsize=512)
def laid_out(
    spans: tuple[Span, ...], room: float, size: float, sizes: Sizes
) -> tuple[tuple[Piece, ...], float, float]:
    """Where the pieces stand, the width of the widest line, and the height of all."""
    known = {formula: measures for formula, *measures in sizes}
    lines: list[list[tuple[Piece, float]]] = [[]]
    x, space, widest = 0.0, float(imgui.calc_text_size(" ").x), 0.0
    for word in _words(spans):
        widths = [_width(piece, size, known) for piece in word]
        if x > 0.0 and x + sum(widths) > room:
            lines.append([])
            x = 0.0
        for span, width in zip(word, widths, strict=True):
            lines[-1].append((Piece(span.kind, span.text, x, 0.0), width))
            x += width
        widest = max(widest, x)
        x += space
    made, y = list[Piece](), 0.0
    for line in lines:
        above, below = _extent([piece for piece, _ in line], size, known)
        made += [_set(piece, y + above, size, known) for piece, _ in line]
        y += above + below
    return tuple(made), widest, y


def _words(spans: tuple[Span, ...]) -> Iterator[list[Span]]:
    """What is not to be torn apart: pieces without a space between them."""
    word: list[Span] = []
    for span in spans:
        if span.kind in ("formula", "code"):
            word.append(span)
            continue
        for part in re.findall(r"[ \n]+|[^ \n]+", span.text):
            if part.isspace():
                if word:
                    yield word
                word = []
            else:
                word.append(Span(span.kind, part))
    if word:
        yield word


def _width(span: Span, size: float, known: dict[str, list[float]]) -> float:
    if span.kind == "formula" and span.text in known:
        return known[span.text][0]
    if span.kind == "code":
        style = imgui.get_style()
        height = round(CODE * size) / (style.font_scale_main * style.font_scale_dpi)
        imgui.push_font(imgui.get_io().fonts.fonts[1], height)
        width = imgui.calc_text_size(span.text).x
        imgui.pop_font()
        return float(width)
    return float(imgui.calc_text_size(span.text).x) + (
        STRONG * size if span.kind == "strong" else 0
    )


def _extent(line: list[Piece], size: float, known: dict[str, list[float]]) -> tuple[float, float]:
    """How far a line goes above its baseline and below, at least as an ordinary one."""
    gap = 0.5 * (LINE - 1.0) * size
    above, below = BASELINE * size + gap, (1.0 - BASELINE) * size + gap
    for piece in line:
        if piece.kind == "formula" and piece.text in known:
            _, height, depth = known[piece.text]
            above, below = max(above, height - depth + gap / 2), max(below, depth + gap / 2)
    return above, below


def _set(piece: Piece, baseline: float, size: float, known: dict[str, list[float]]) -> Piece:
    top = BASELINE * size
    if piece.kind == "formula" and piece.text in known:
        _, height, depth = known[piece.text]
        top = height - depth
    elif piece.kind == "code":
        top *= 0.93
    return piece._replace(y=baseline - top)


def _code(block: Block) -> None:
    imgui.push_font(imgui.get_io().fonts.fonts[1], 0.85 * imgui.get_style().font_size_base)
    imgui.push_text_wrap_pos(0.0)  # at the edge of the window: a long row is not cut off
    for row in block.text.split("\n"):
        imgui.text_unformatted(row)
    imgui.pop_text_wrap_pos()
    imgui.pop_font()
