"""Every raw sample, kept as it comes: in memory, and line by line in a file if there is one.

A line is one JSON object. What a run that was stopped has written is found again by
the next one, if machine, version of the source and quickness are the same.
"""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

from playground.errors import PlaygroundError
from playground.files import read_bytes
from playground.measure.record import Batch, Candidate, Errors

FILE = "samples.jsonl"


class Journal:
    """The samples of one run and of those that it continues.

    Parameters
    ----------
    folder : where the file is, or None for memory alone
    stamp : what samples must agree in to belong together, as one short text
    fresh : forget what the file holds
    """

    def __init__(self, folder: Path | None, stamp: str, fresh: bool = False) -> None:
        self.stamp = stamp
        self.lines: list[dict[str, Any]] = []
        self._times: dict[tuple[str, str], dict[int, Batch]] = {}
        self._errors: dict[tuple[str, str], Errors] = {}
        self._path = folder / FILE if folder is not None else None
        if self._path is not None:
            if self._path.is_file() and not fresh:
                self._read(self._path)
            else:
                _write(self._path, b"", os.O_TRUNC)
        self.found = len(self.lines)

    def batches(self, experiment: str, candidate: Candidate) -> dict[int, Batch]:
        """The times of a candidate by round."""
        return self._times.get((experiment, candidate.key), {})

    def errors(self, experiment: str, candidate: Candidate) -> Errors | None:
        """The errors of a candidate, if they have been measured."""
        return self._errors.get((experiment, candidate.key))

    def add(
        self, experiment: str, candidate: Candidate, sample: Batch | Errors, number: int = 0
    ) -> None:
        """Keep the times of round ``number``, or the errors."""
        line: dict[str, Any] = {
            "stamp": self.stamp,
            "experiment": experiment,
            "case": candidate.case,
            "method": candidate.method,
            "knobs": dict(candidate.knobs),
        }
        if isinstance(sample, Batch):
            line |= {"round": number, "times": sample.times, "more": sample.more}
        else:
            line["errors"] = sample.to_dict()
        self._take(line)
        if self._path is not None:
            _write(self._path, json.dumps(line).encode() + b"\n", os.O_APPEND)

    def _take(self, line: dict[str, Any]) -> None:
        key = json.dumps([line["case"], line["method"], line["knobs"]], sort_keys=True)
        place = (line["experiment"], key)
        if "errors" in line:
            self._errors[place] = Errors.from_dict(line["errors"])
        else:
            batch = Batch(line["times"], line["more"])
            self._times.setdefault(place, {})[line["round"]] = batch
        self.lines.append(line)

    def _read(self, path: Path) -> None:
        """Take what belongs to this run; a line that a power cut has torn is cut off."""
        data = read_bytes(path)
        whole = data[: data.rfind(b"\n") + 1]
        if len(whole) < len(data):
            _write(path, whole, os.O_TRUNC)
        for number, text in enumerate(whole.splitlines(), 1):
            try:
                line = json.loads(text)
                if line["stamp"] == self.stamp:
                    self._take(line)
            except (ValueError, KeyError, TypeError):
                raise PlaygroundError(
                    f"{path}:{number} is no sample",
                    got=text.decode("utf-8", "replace"),
                    fix="Use --fresh to measure anew, or another folder.",
                ) from None


def _write(path: Path, data: bytes, how: int) -> None:
    """All of ``data`` in one call, so that no other line comes between and none is half there."""
    try:
        handle = os.open(path, os.O_WRONLY | os.O_CREAT | how, 0o666)
        try:
            os.write(handle, data)
        finally:
            os.close(handle)
    except OSError as error:
        raise PlaygroundError(
            f"cannot write {path}", got=error.strerror or str(error), fix="Choose another place."
        ) from None
