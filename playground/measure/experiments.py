"""The experiments of ``playground measure`` and where their tables go."""

from __future__ import annotations

import csv
import io
import json
import os
import platform
import sys
from collections.abc import Callable, Iterable
from dataclasses import asdict, fields
from pathlib import Path
from typing import Any

from playground.errors import PlaygroundError, unknown_name
from playground.files import make_folder, write_whole

Rows = list[Any]


def run_experiments(names: Iterable[str], folder: Path | None, rounds: int, as_json: bool) -> int:
    """Run the named experiments (all if none), print their tables, write CSV and JSON.

    Raises
    ------
    PlaygroundError
        No experiment of that name, no positive number of rounds, no place for the tables,
        or no GL driver for an experiment that needs one.
    """
    names = list(names) or list(EXPERIMENTS)
    for name in names:
        if name not in EXPERIMENTS:
            raise unknown_name("experiment", name, EXPERIMENTS)
    if rounds < 1:
        raise PlaygroundError("too few rounds", got=rounds, allowed="1 or more")
    if folder is not None:
        make_folder(folder)
    if NEEDS_GL & set(names):
        from playground.render.gl.context import headless

        headless()
    results: dict[str, Any] = {"machine": machine()}
    for name in names:
        rows = EXPERIMENTS[name](rounds, not as_json)
        results[name] = [asdict(row) for row in rows]
        if folder is not None:
            write_whole(folder / f"{name}.csv", _csv(rows).encode())
    if folder is not None:
        write_whole(folder / "report.json", json.dumps(results, indent=1).encode())
    if as_json:
        print(json.dumps(results))
    return 0


def machine() -> dict[str, Any]:
    """What the figures were measured on; no GL where there is no driver."""
    from playground.render.gl.context import available, headless

    return {
        "gl": headless().info["GL_RENDERER"] if available() else None,
        "cores": os.cpu_count(),
        "python": platform.python_version(),
        "system": platform.platform(terse=True),
    }


def _frames(rounds: int, show: bool) -> Rows:
    from playground.measure.frames import measure_frames
    from playground.measure.frames_scene import SIZE

    if show:
        print(f"ms per frame at {SIZE[0]}x{SIZE[1]}, 8-bit RGBA read into an array, moving camera,")
        print(f"on {machine()['gl']}: median (10 %, 90 %), ratio to the floor of the same round")
        print(f"{'triangles':>9} {'samples':>7}  {'candidate':<13}{'ms':>22}{'ratio':>8}   error")
    rows = []
    for row in measure_frames(rounds):
        rows.append(row)
        if show:
            times = f"{row.median:.2f} ({row.low:.2f}, {row.high:.2f})"
            error = ""
            if row.worst is not None and row.off is not None:
                error = f"{row.worst:.0f} codes at most, {100 * row.off:.4f} % off by more than 1"
            print(
                f"{row.triangles:>9} {row.samples:>7}  {row.candidate:<13}{times:>22}"
                f"{row.ratio:>8.2f}   {error}"
            )
            sys.stdout.flush()
    return rows


def _first_image(rounds: int, show: bool) -> Rows:
    from playground.measure.first_image import measure_first_image

    rows = measure_first_image(rounds)
    if show:
        print("a cold process, from its start to its end: median (10 %, 90 %), peak memory")
        for row in rows:
            times = f"{row.median:.3f} s ({row.low:.3f}, {row.high:.3f})"
            print(f"  {row.command:<26}{times:>26}{row.megabytes:>8.0f} MB")
    return rows


def _csv(rows: Rows) -> str:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    names = [f.name for f in fields(rows[0])] if rows else []
    writer.writerow(names)
    writer.writerows([getattr(row, name) for name in names] for row in rows)
    return text.getvalue()


EXPERIMENTS: dict[str, Callable[[int, bool], Rows]] = {
    "frames": _frames,
    "first-image": _first_image,
}
NEEDS_GL = {"frames"}
