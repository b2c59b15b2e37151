"""Plots of time against error, as SVG: one small picture per case, the Pareto front marked.

Told apart by shape as well as by colour, so that they survive a grey printer.
"""

from __future__ import annotations

import io
import re
from collections.abc import Sequence
from html import escape
from typing import Any

import numpy as np

from playground.measure.record import Experiment
from playground.measure.rows import BOUNDS, Row, cases

# Okabe & Ito, Color Universal Design, 2008: told apart by every kind of colour vision.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#7F7F7F")
MARKS = ("o", "s", "^", "D", "v", "P", "X")  # one fewer than colours: 56 pairs
STYLE = {
    "svg.fonttype": "none",
    "svg.hashsalt": "playground",
    "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans", "Arial", "Helvetica", "sans-serif"],
    "font.size": 9.0,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "path.simplify": False,
}
PER_ROW = 2
WIDTH, HEIGHT = 4.6, 3.6  # inches of one case


def figure(experiment: Experiment, rows: list[Row]) -> str:
    """The plot of an experiment as an ``<svg>`` element; times alone where there are no errors."""
    import matplotlib as mpl
    from matplotlib.figure import Figure

    judged = [row for row in rows if row.error is not None]
    shown = judged or rows
    names = cases(shown)
    across = min(len(names), PER_ROW)
    down = -(-len(names) // across)
    with mpl.rc_context(STYLE):
        size = (max(WIDTH * across, 6.5), HEIGHT * down if judged else _bars_height(rows))
        drawing = Figure(figsize=size, layout="constrained")
        grid = drawing.subplots(down, across, squeeze=False)
        for axes in grid.flat[len(names) :]:
            axes.set_axis_off()
        looks = _looks([row for row in shown if _has_errors(row.case, shown)])
        for axes, case in zip(grid.flat, names, strict=False):
            of_case = [row for row in shown if row.case == case]
            if _has_errors(case, shown):
                _scatter(axes, experiment, of_case, looks)
            else:
                _bars(axes, experiment, of_case)
            if case:
                axes.set_title(case, fontsize=9.0)
        if looks:
            _legend(drawing, looks)
        return _svg(drawing, experiment)


def _has_errors(case: str, rows: list[Row]) -> bool:
    """Whether there is an error to plot; where all are 0, bars of the times say more."""
    return any(row.error for row in rows if row.case == case)


def _looks(rows: Sequence[Row]) -> dict[str, dict[str, Any]]:
    methods = dict.fromkeys(row.method for row in rows)
    return {
        method: {"color": COLOURS[i % len(COLOURS)], "marker": MARKS[i % len(MARKS)]}
        for i, method in enumerate(methods)
    }


def _scatter(axes: Any, experiment: Experiment, rows: list[Row], looks: dict[str, Any]) -> None:
    """Time to the right, error upwards, both as logarithms; an error of 0 lies on the floor."""
    errors = [row.error for row in rows if row.error]
    floor = min([*errors, BOUNDS[-1]]) / 4.0
    for row in rows:
        height = row.error or floor
        spread = (row.errors.uncertainty if row.errors else {}).get(experiment.error, 0.0)
        axes.errorbar(
            row.median,
            height,
            xerr=[[row.median - row.low], [row.high - row.median]],
            yerr=[[min(spread, 0.9 * height)], [spread]] if spread else None,
            **looks[row.method],
            markersize=5.0,
            linestyle="none",
            elinewidth=0.7,
            alpha=1.0 if row.front else 0.75,
        )
        text = _dot_label(row) + (" (error 0)" if not row.error else "")
        if text.strip() and (row.knobs or row.front):
            place = {"xytext": (5, 4), "textcoords": "offset points", "fontsize": 7.0}
            axes.annotate(text, (row.median, height), **place)
    _front(axes, rows, floor)
    for bound in BOUNDS:
        axes.axhline(bound, color="0.6", linewidth=0.7, linestyle=":", zorder=0)
    axes.set(xscale="log", yscale="log")
    axes.set_xlabel(experiment.time_label)
    axes.set_ylabel(experiment.error_label, wrap=True)
    axes.margins(x=0.12, y=0.1)
    _plain_ticks(axes.xaxis, np.log10(np.divide(*reversed(axes.get_xlim()))))


def _plain_ticks(axis: Any, decades: float) -> None:
    """Times as plain numbers; the fewer powers of ten, the more steps between them."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    subs = (1.0,) if decades > 2.5 else (1.0, 2.0, 5.0)
    axis.set_major_locator(LogLocator(subs=subs if decades > 0.8 else (1, 1.5, 2, 3, 4, 5, 6, 8)))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_formatter(NullFormatter())


def _front(axes: Any, rows: list[Row], floor: float) -> None:
    front = sorted((row for row in rows if row.front), key=lambda row: row.median)
    x, y = [row.median for row in front], [row.error or floor for row in front]
    axes.plot(x, y, color="0.25", linewidth=1.0, drawstyle="steps-post", zorder=0)
    axes.plot(
        x, y, linestyle="none", marker="o", markersize=10.0, fillstyle="none", color="0.25", mew=1.0
    )


def _dot_label(row: Row) -> str:
    return ", ".join(str(value) for value in row.knobs.values()) or row.method


def _legend(drawing: Any, looks: dict[str, dict[str, Any]]) -> None:
    from matplotlib.lines import Line2D

    entries = [Line2D([], [], linestyle="none", label=name, **look) for name, look in looks.items()]
    ring = {"marker": "o", "fillstyle": "none", "color": "0.25", "markersize": 9.0}
    entries.append(Line2D([], [], label="Pareto front", linewidth=1.0, **ring))  # type: ignore[arg-type]
    columns = min(len(entries), 4)
    drawing.legend(
        handles=entries, loc="outside lower center", ncols=columns, frameon=False, fontsize=8.0
    )


def _bars_height(rows: list[Row]) -> float:
    return 1.2 + 0.3 * len(rows)


def _bars(axes: Any, experiment: Experiment, rows: list[Row]) -> None:
    """Times alone, the first on top."""
    places = range(len(rows), 0, -1)
    spread = [[row.median - row.low for row in rows], [row.high - row.median for row in rows]]
    axes.barh(places, [row.median for row in rows], xerr=spread, color=COLOURS[0], height=0.6)
    axes.set_yticks(list(places), [row.label for row in rows], fontsize=8.0)
    axes.set_xlabel(experiment.time_label)


def _svg(drawing: Any, experiment: Experiment) -> str:
    """The picture as an element that can stand in a page, with its own ids and a name."""
    file = io.StringIO()
    drawing.savefig(file, format="svg", metadata={"Date": None, "Creator": None})
    text = file.getvalue()
    text = text[text.index("<svg") :]
    text = re.sub(r"<metadata>.*?</metadata>", "", text, flags=re.DOTALL)
    prefix = f"{experiment.name}-"
    text = re.sub(r'\bid="', f'id="{prefix}', text)
    text = re.sub(r'(xlink:href="#|url\(#)', rf"\g<1>{prefix}", text)
    label = escape(f"{experiment.title}: {experiment.error_label}, {experiment.time_label}")
    return text.replace("<svg ", f'<svg role="img" aria-label="{label}" ', 1)
