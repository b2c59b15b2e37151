"""The rows as JSON and CSV."""

from __future__ import annotations

import csv
import io
from typing import TYPE_CHECKING, Any

from playground.measure.report.text import winners
from playground.measure.rows import BOUNDS, Row

if TYPE_CHECKING:
    from playground.measure.session import Result


def as_data(results: list[Result], machine: dict[str, Any], quick: bool) -> dict[str, Any]:
    """The machine, the rows of every experiment by its name, findings, the fastest, the skipped."""
    data: dict[str, Any] = {"machine": machine, "quick": quick}
    data |= {r.experiment.name: [row.to_dict() for row in r.rows] for r in results}
    data["findings"] = {r.experiment.name: r.finding() for r in results if r.rows}
    data["fastest"] = {r.experiment.name: _fastest(r.rows) for r in results if r.rows}
    data["skipped"] = {r.experiment.name: r.skipped for r in results if r.skipped}
    data["unfinished"] = [r.experiment.name for r in results if not r.complete and not r.skipped]
    return data


def _fastest(rows: list[Row]) -> list[dict[str, Any]]:
    """The fastest at each bound, and what is as fast within its spread."""
    return [
        {
            "case": case,
            "error": bound,
            "fastest": found[0].label if found else None,
            "median": found[0].median if found else None,
            "as_fast": [row.label for row in found[1:]],
        }
        for case, all_found in winners(rows)
        for bound, found in zip(BOUNDS, all_found, strict=True)
    ]


def as_csv(rows: list[Row]) -> str:
    """One line per row under the names of `Row.to_dict`."""
    text = io.StringIO()
    records = [row.to_dict() for row in rows]
    names = list(dict.fromkeys(name for record in records for name in record))
    writer = csv.DictWriter(text, names, lineterminator="\n")
    writer.writeheader()
    writer.writerows(records)
    return text.getvalue()
