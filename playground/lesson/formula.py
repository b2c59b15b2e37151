"""Formulas, typeset by matplotlib's mathtext: as outlines for a page, as pixels for the window.

What it knows of LaTeX: https://matplotlib.org/stable/users/explain/text/mathtext.html
"""

from __future__ import annotations

import re
from functools import lru_cache
from html import escape
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from playground.errors import PlaygroundError

FAMILY = "cm"  # Computer Modern, the letters of LaTeX
UNITS = 100.0  # per em, in which matplotlib gives outlines
LARGER = 1.18  # its letters are smaller than those of the text around them
DEGREES = re.compile(r"°|\^\\circ\b")
DEGREE = r"^{\circ}"  # without the braces it would have the room of an operator around it
CLOSE = re.compile(r"(?<=[0-9A-Za-z})])\s*(?=\\(?:sin|cos|tan|max)\b)")  # no room before a function
LETTERS = {1: "M", 2: "L", 3: "Q", 4: "C", 79: "Z"}  # of SVG for matplotlib's path codes
POINTS = {1: 1, 2: 1, 3: 2, 4: 3, 79: 1}  # that belong to a code


class Mask(NamedTuple):
    """How much of each pixel a formula covers, 0 to 255; ``depth`` rows are below the line."""

    pixels: NDArray[np.uint8]
    depth: float


@lru_cache(maxsize=512)
def svg(formula: str) -> str:
    """The formula as an ``<svg>`` element that stands in a line of text, in its colour.

    Raises
    ------
    PlaygroundError
        It cannot be typeset.
    """
    _check(formula)
    from matplotlib.textpath import text_to_path

    font, text, em = _font(UNITS), _source(formula), LARGER / UNITS
    width, height, depth = text_to_path.get_text_width_height_descent(text, font, ismath=True)
    vertices, codes = text_to_path.get_text_path(font, text, ismath=True)
    right = np.reshape(vertices, (-1, 2))[:, 0].max(initial=0.0)
    width = max(width, right)  # a slanted letter leans out of its box
    box = f"0 {-(height - depth):.1f} {width:.1f} {height:.1f}"
    style = (
        f"width:{width * em:.3f}em;height:{height * em:.3f}em;vertical-align:{-depth * em:.3f}em"
    )
    return (
        f'<svg role="img" aria-label="{escape(formula)}" viewBox="{box}" style="{style}">'
        f'<path fill="currentColor" d="{_path(vertices, codes)}"/></svg>'
    )


def mask(formula: str, size: float) -> Mask:
    """The formula in letters ``size`` pixels high.

    Raises
    ------
    PlaygroundError
        It cannot be typeset.
    """
    _check(formula)
    from matplotlib.mathtext import MathTextParser

    made = MathTextParser("agg").parse(_source(formula), dpi=72, prop=_font(LARGER * size))
    return Mask(np.asarray(made.image, dtype=np.uint8), float(made.depth))


def _source(formula: str) -> str:
    """As mathtext reads it: no sign for a degree, and no room before the name of a function."""
    return "$" + DEGREES.sub(lambda _: DEGREE, CLOSE.sub(r"\\,", formula)) + "$"


@lru_cache(maxsize=512)
def _check(formula: str) -> None:
    from matplotlib.mathtext import MathTextParser

    try:
        MathTextParser("path").parse(_source(formula))
    except ValueError as error:
        reason = str(error).strip().splitlines()[-1]
        raise PlaygroundError("a formula cannot be typeset", got=formula, fix=reason) from None


def _font(size: float) -> Any:
    from matplotlib.font_manager import FontProperties

    return FontProperties(size=size, math_fontfamily=FAMILY)


def _path(vertices: Any, codes: Any) -> str:
    """The outlines in SVG, whose y goes down."""
    words, i = [], 0
    while i < len(codes):
        code = int(codes[i])
        points = vertices[i : i + POINTS[code]]
        at = "" if code == 79 else " ".join(f"{x:.1f} {-y:.1f}" for x, y in points)
        words.append(f"{LETTERS[code]}{at}")
        i += POINTS[code]
    return "".join(words)
