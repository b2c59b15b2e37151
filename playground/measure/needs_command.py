"""``playground measure needs``: the advisor with a bar, its table, and its files."""

from __future__ import annotations

import csv
import io
import json
import sys
from pathlib import Path
from time import perf_counter
from typing import Any

from playground.errors import PlaygroundError
from playground.files import make_folder, write_whole
from playground.measure.advice import Advice
from playground.measure.advisor import Progress, advise
from playground.percent import percent
from playground.scene.setup import Setup
from playground.scene.setup_file import save

WIDE = 16  # characters of the bar
LINE = 79  # characters of a line of a terminal


def run_needs(setup: Setup, output: Path | None, as_json: bool, **asked: Any) -> int:
    """Advise on ``setup``, print what was found, write the proposal; the exit status.

    ``output`` is a .toml for the proposed setup, or a folder for everything: the setup, the
    table, the JSON document and the two pictures. ``asked`` goes to `advise`.

    Raises
    ------
    PlaygroundError
        What `advise` refuses, and a place that cannot be written: before it is measured.
    """
    if output is not None:
        _check_place(output)
    advice = _measured(setup, asked)
    if output is not None:
        _write(advice, output, asked.get("method", "raster"))
    if as_json:
        print(json.dumps(advice.to_dict()))
    else:
        print("\n".join(text for text in (advice.table(), advice.sentence()) if text))
    return 0


def _measured(setup: Setup, asked: dict[str, Any]) -> Advice:
    """Run the advisor to its end, with a bar where a person looks on."""
    if sys.stderr is None or not sys.stderr.isatty():
        return advise(setup, **asked)
    began = perf_counter()

    def show(progress: Progress) -> None:
        print(f"\r{bar(progress, perf_counter() - began):<{LINE}}", end="", file=sys.stderr)

    try:
        return advise(setup, watch=show, **asked)
    finally:  # also when it is stopped or fails
        print(f"\r{'':<{LINE}}\r", end="", file=sys.stderr, flush=True)


def bar(progress: Progress, seconds: float) -> str:
    """How far it is, how long it will still take, and what is being measured."""
    full = round(WIDE * progress.share)
    left = ""
    if progress.share > 0.0:
        left = f"{seconds * (1.0 - progress.share) / progress.share:.0f} s left  "
    done = f"[{'#' * full}{'.' * (WIDE - full)}] {percent(progress.share, '3.0f')}"
    text = f"{done}  {left}{progress.doing}"
    return text[:LINE]


def _check_place(output: Path) -> None:
    """Make the folder, or see that the file has one, before minutes are spent on measuring."""
    if output.suffix == "":
        make_folder(output)
    elif output.suffix.lower() != ".toml":
        raise PlaygroundError(
            "the proposal is a setup file or a folder",
            got=str(output),
            allowed="a name that ends in .toml, or one without an ending",
        )
    elif not output.parent.is_dir():
        raise PlaygroundError(
            f"cannot write {output}",
            got="no such folder",
            fix=f"Make the folder {output.parent} first, or choose another place.",
        )


def _write(advice: Advice, output: Path, method: str) -> None:
    if output.suffix:
        save(advice.proposed, output)
        return
    from playground.render.renderer import open_renderer

    save(advice.proposed, output / "proposed.toml")
    write_whole(output / "needs.json", json.dumps(advice.to_dict(), indent=1).encode())
    write_whole(output / "needs.csv", _csv(advice).encode())
    with open_renderer(advice.size, advice.renderer, method=method) as renderer:
        for name, setup in (("full", advice.setup), ("proposed", advice.proposed)):
            image: Any = renderer.render(setup)
            image.save(output / f"{name}.png")


def _csv(advice: Advice) -> str:
    text, rows = io.StringIO(), advice.rows()
    table = csv.DictWriter(text, list(rows[0]) if rows else ["name"], lineterminator="\n")
    table.writeheader()
    table.writerows(rows)
    return text.getvalue()
