"""Writes the report: ``report.html`` with everything in it, and the data beside it."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

from playground.files import write_whole
from playground.measure.journal import Journal
from playground.measure.report.data import as_csv, as_data
from playground.measure.report.page import page

if TYPE_CHECKING:
    from playground.measure.session import Result


def write_report(
    results: list[Result],
    journal: Journal,
    machine: dict[str, Any],
    folder: Path,
    quick: bool,
    stopped: bool,
) -> Path:
    """Write page, JSON with every raw sample, and one CSV per experiment; returns the page.

    Raises
    ------
    PlaygroundError
        A file cannot be written; a former one stays as it was.
    """
    names = {result.experiment.name for result in results}
    data = as_data(results, machine, quick)
    data["samples"] = [
        {key: value for key, value in line.items() if key != "stamp"}
        for line in journal.lines
        if line["experiment"] in names
    ]
    files = {"report.json": json.dumps(data, indent=1)}
    files |= {f"{r.experiment.name}.csv": as_csv(r.rows) for r in results if r.rows}
    for name, text in files.items():
        write_whole(folder / name, text.encode())
    place = folder / "report.html"
    write_whole(place, page(results, machine, files, quick, stopped).encode())
    return place
