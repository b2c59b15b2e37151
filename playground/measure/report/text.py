"""Tables for a terminal; the page shows the same cells."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from playground.measure.record import Errors, Experiment
from playground.measure.rows import BOUNDS, Row, cases, fastest

FRONT = "*"
NONE = "–"
_ERRORS = {
    "rmse": "RMSE",
    "max": "maximum",
    "mean": "mean",
    "flip": "FLIP",
    "off": "off by > 1 code",
    "left_out": "pixels left out",
}


def heading(experiment: Experiment) -> str:
    """What is asked, and what the numbers are."""
    text = f"{experiment.name}: {experiment.question}\n"
    text += f"{experiment.time_label}: median (10 %, 90 %)"
    if experiment.reference:
        text += f"; error: {experiment.error_label}, against {experiment.reference}"
    return text


def columns(experiment: Experiment, rows: list[Row]) -> dict[str, Callable[[Row], str]]:
    """The columns that hold anything: name and what stands in each row."""
    found: dict[str, Callable[[Row], str]] = {}
    if any(row.case for row in rows):
        found["case"] = lambda row: row.case
    found["method"] = lambda row: row.method
    for knob in dict.fromkeys(name for row in rows for name in row.knobs):
        found[knob] = lambda row, k=knob: str(row.knobs.get(k, ""))  # type: ignore[misc]
    found[experiment.time_label] = _time
    if any(row.ratio is not None for row in rows):
        found[f"ratio to {experiment.ratio_to}"] = lambda row: _number(row.ratio)
    for name in experiment.show:
        if any(_shown(row, name) != NONE for row in rows):
            found[_ERRORS.get(name, name)] = lambda row, n=name: _shown(row, n)  # type: ignore[misc]
    if any(row.error is not None for row in rows):
        found["front"] = lambda row: FRONT if row.front else ""
    return found


def table(experiment: Experiment, rows: list[Row]) -> str:
    """The rows as aligned text."""
    chosen = columns(experiment, rows)
    cells = [list(chosen), *([cell(row) for cell in chosen.values()] for row in rows)]
    widths = [max(len(line[i]) for line in cells) for i in range(len(chosen))]
    return "\n".join(
        "  ".join(text.rjust(width) for text, width in zip(line, widths, strict=True)).rstrip()
        for line in cells
    )


def winners(rows: Iterable[Row]) -> list[tuple[str, list[list[Row]]]]:
    """For each case with errors, the fastest rows at each of `BOUNDS`."""
    rows = list(rows)
    found = []
    for case in cases(rows):
        judged = [row for row in rows if row.case == case and row.error is not None]
        if judged:
            found.append((case, [fastest(judged, bound) for bound in BOUNDS]))
    return found


def winner(experiment: Experiment, found: list[Row]) -> str:
    """The fastest row in words, and which others are as fast within its spread."""
    if not found:
        return "none"
    unit = experiment.time_label.split()[0]
    text = f"{found[0].label} ({_digits(found[0].median)} {unit})"
    others = [row.label for row in found[1:]]
    if len(others) > 3:
        others[2:] = [f"{len(others) - 2} more"]
    return f"{text}; as fast within its spread: {'; '.join(others)}" if others else text


def _time(row: Row) -> str:
    return f"{_digits(row.median)} ({_digits(row.low)}, {_digits(row.high)})"


def _shown(row: Row, name: str) -> str:
    """A number of the errors, or of what was counted with the times."""
    if name in row.more:
        return _number(row.more[name])
    if row.errors is None:
        return NONE
    value = row.errors.more.get(name) if name not in _ERRORS else getattr(row.errors, name)
    if value is None:
        return NONE
    text = f"{100.0 * value:.3g} %" if name == "off" else _number(value)
    return text + _spread(row.errors, name)


def _spread(errors: Errors, name: str) -> str:
    return f" ± {errors.uncertainty[name]:.1g}" if name in errors.uncertainty else ""


def _digits(value: float) -> str:
    """Three digits, and never a power of ten where the number is large."""
    return f"{value:.3g}" if value < 1000.0 else f"{value:.0f}"


def _number(value: float | None) -> str:
    if value is None:
        return NONE
    return f"{value:.0f}" if value == round(value) and abs(value) < 1e6 else f"{value:.3g}"
