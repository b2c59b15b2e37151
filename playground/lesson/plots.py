"""Curves of a lesson, as lines for the handout and as pixels for the window."""

from __future__ import annotations

import io
import re
from collections.abc import Mapping
from hashlib import sha256
from html import escape
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from playground.errors import PlaygroundError
from playground.lesson.figures import accepts
from playground.lesson.words import Check
from playground.measure.report.plots import COLOURS, STYLE

WIDTH, HEIGHT, DENSITY = 5.4, 3.0, 130  # inches, and pixels per inch
DASHES = ("-", "--", "-.", ":")  # so that a grey printer tells curves apart
LOGARITHMS = ("", "x", "y", "xy")
OWN = {
    "svg.fonttype": "path",
    "mathtext.fontset": "dejavuserif",
}  # letters as outlines: no font is needed


def plotted(
    caption: str,
    x: tuple[str, ArrayLike],
    y: str,
    curves: Mapping[str, ArrayLike],
    shows: Check,
    log: str = "",
) -> tuple[NDArray[np.uint8], str]:
    """The codes (H, W, 3) and the ``<svg>`` element of the curves.

    Raises
    ------
    PlaygroundError
        As `playground.lesson.words.plot` says.
    """
    places = np.asarray(x[1], dtype=np.float64)
    lines = {name: np.asarray(values, dtype=np.float64) for name, values in curves.items()}
    for name, values in lines.items():
        if values.shape != places.shape or values.ndim != 1:
            raise PlaygroundError("a curve has one value for each x", got=name)
    if not shows(*lines.values()):
        raise PlaygroundError("the plot does not show what its caption says", got=caption)
    if accepts(shows, [np.zeros_like(values) for values in lines.values()]):
        raise PlaygroundError(
            "what the plot shows is not checked: shows= accepts curves of zeros", got=caption
        )
    _check_logarithms(log, places, lines)
    return _drawn(caption, x[0], places, y, lines, log)


def _check_logarithms(
    log: str, places: NDArray[np.float64], lines: dict[str, NDArray[np.float64]]
) -> None:
    if log not in LOGARITHMS:
        raise PlaygroundError("unknown axes", got=log, allowed=", ".join(LOGARITHMS[1:]))
    values = [*([places] if "x" in log else []), *(lines.values() if "y" in log else [])]
    if any(not (found > 0.0).all() for found in values):
        raise PlaygroundError("a logarithmic axis has positive numbers only", got=f"log={log!r}")


def _logarithms(axes: Any, log: str) -> None:
    """Let each step of an axis be a factor, the numbers written out; x counts in twos."""
    for name in log:
        axis = getattr(axes, f"{name}axis")
        getattr(axes, f"set_{name}scale")("log", base=2 if name == "x" else 10)
        axis.set_major_formatter(lambda value, _: f"{value:g}")


def _drawn(
    caption: str, x: str, places: NDArray[np.float64], y: str, lines: dict[str, Any], log: str
) -> tuple[NDArray[np.uint8], str]:
    import matplotlib as mpl
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    with mpl.rc_context({**STYLE, **OWN}):
        drawing = Figure(figsize=(WIDTH, HEIGHT), dpi=DENSITY, layout="constrained")
        canvas = FigureCanvasAgg(drawing)
        axes = drawing.subplots()
        for i, (name, values) in enumerate(lines.items()):
            look: dict[str, Any] = {
                "color": COLOURS[i % len(COLOURS)],
                "linestyle": DASHES[i % len(DASHES)],
            }
            axes.plot(places, values, label=name, linewidth=1.8, **look)
        axes.set(xlabel=x, ylabel=y)
        _logarithms(axes, log)
        axes.grid(color="0.9")
        axes.margins(x=0.0)
        if len(lines) > 1:
            axes.legend(edgecolor="none", framealpha=0.85)  # a curve below does not cross it
        canvas.draw()
        codes = np.asarray(canvas.buffer_rgba())[..., :3].copy()
        file = io.StringIO()
        drawing.savefig(file, format="svg", metadata={"Date": None, "Creator": None})
    return codes, _element(file.getvalue(), caption)


def _element(text: str, caption: str) -> str:
    """The picture as an element with ids of its own, so that several stand in one page."""
    prefix = "p" + sha256(text.encode()).hexdigest()[:8] + "-"
    text = text[text.index("<svg") :]
    text = re.sub(r"<metadata>.*?</metadata>", "", text, flags=re.DOTALL)
    text = re.sub(r'\bid="', f'id="{prefix}', text)
    text = re.sub(r'(xlink:href="#|url\(#)', rf"\g<1>{prefix}", text)
    return text.replace("<svg ", f'<svg role="img" aria-label="{escape(caption)}" ', 1)
