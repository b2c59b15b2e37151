"""Words for findings: every one follows from rows."""

from __future__ import annotations

from collections.abc import Iterable

from playground.measure.rows import Row

NOTHING = "Nothing has been compared yet."


def signed(share: float) -> str:
    """``0.01`` as ``+1 %``."""
    return f"{100.0 * share:+.2g} %"


def took(row: Row, unit: str = "ms") -> str:
    """The median time."""
    return f"{row.median:.3g} {unit}" if row.median < 1000.0 else f"{row.median:.0f} {unit}"


def times(factor: float) -> str:
    """``2.13`` as ``2.1 times``."""
    return f"{factor:.2g} times" if factor < 99.5 else f"{factor:.0f} times"


def listed(words: Iterable[str]) -> str:
    """``a, b and c``."""
    *first, last = words
    return f"{', '.join(first)} and {last}" if first else last


def reach(rows: Iterable[Row], bound: float) -> Row | None:
    """The fastest row with an error up to ``bound``, if there is one."""
    good = [row for row in rows if row.error is not None and row.error <= bound]
    return min(good, key=lambda row: row.median, default=None)


def of(rows: Iterable[Row], method: str, **knobs: object) -> list[Row]:
    """The rows of a method, and of these knobs."""
    return [
        row
        for row in rows
        if row.method == method and all(row.knobs.get(k) == v for k, v in knobs.items())
    ]


def sentence(*parts: str) -> str:
    """Parts joined by semicolons, with a capital and a full stop; empty ones left out."""
    text = "; ".join(filter(None, parts))
    return f"{text[0].upper()}{text[1:]}." if text else NOTHING
