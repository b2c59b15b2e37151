"""One run of ``playground measure``: what is missing is measured, what is known is shown."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterable, Iterator
from contextlib import ExitStack
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from playground.errors import PlaygroundError
from playground.files import make_folder
from playground.measure.experiments import EXPERIMENTS, find
from playground.measure.journal import Journal
from playground.measure.machine import load, machine, stamp
from playground.measure.record import Candidate, Experiment
from playground.measure.rows import Row, rows_of

ROUNDS, QUICK_ROUNDS = 9, 3


@dataclass
class Result:
    """What is known of one experiment; ``skipped`` says why there is nothing."""

    experiment: Experiment
    rows: list[Row] = field(default_factory=list)
    skipped: str = ""
    complete: bool = False

    def finding(self) -> str:
        """One sentence that follows from the rows."""
        if self.skipped or not self.rows:
            return ""
        return self.experiment.finding(self.rows)


@dataclass(frozen=True)
class Options:
    """How to measure: the names of the experiments, and what `run_experiments` is told."""

    rounds: int
    quick: bool
    as_json: bool


def run_experiments(
    names: Iterable[str],
    folder: Path | None,
    rounds: int | None = None,
    as_json: bool = False,
    quick: bool = False,
    fresh: bool = False,
) -> int:
    """Run the named experiments (all if none), print their tables, write the report.

    Returns the exit status: 0, or 130 if it was stopped by Ctrl-C; what had been measured by
    then is in the report, and the same call with the same folder goes on from there.

    Raises
    ------
    PlaygroundError
        No experiment of that name, no positive number of rounds, no place for the report,
        or no GL driver where every experiment that is asked for needs one. What an experiment
        itself raises comes after the others have been measured and the report is written.
    """
    experiments = [find(name) for name in list(names) or EXPERIMENTS]
    if rounds is not None and rounds < 1:
        raise PlaygroundError("too few rounds", got=rounds, allowed="1 or more")
    options = Options(rounds or (QUICK_ROUNDS if quick else ROUNDS), quick, as_json)
    reason = _without_gl(experiments)
    if folder is not None:
        make_folder(folder)
    found = machine()
    journal = Journal(folder, stamp(found, quick), fresh)
    found = {**found, "load": load()}
    if journal.found:
        _say(f"{journal.found} samples of an earlier run are there; going on (--fresh: anew)")

    results = [Result(e, skipped=reason if e.needs_gl else "") for e in experiments]
    stopped, failed = False, []
    try:
        for result in results:
            try:
                _measure_one(result, journal, options)
            except PlaygroundError as error:  # the other experiments may well go on
                failed.append(error)
    except KeyboardInterrupt:
        stopped = True
    except Exception:  # what has been measured is not to be lost
        _write(results, journal, found, folder, options, stopped=True)
        raise
    _write(results, journal, found, folder, options, stopped or bool(failed))
    if failed:
        raise failed[0]
    if stopped:
        _tell_stopped(journal, folder)
    return 130 if stopped else 0


def _without_gl(experiments: list[Experiment]) -> str:
    """Why experiments that need GL cannot run, or ""; an error if none is left."""
    if not any(experiment.needs_gl for experiment in experiments):
        return ""
    from playground.render.gl.context import NoDriverError, headless

    try:
        headless()
    except NoDriverError as error:
        if all(experiment.needs_gl for experiment in experiments):
            raise
        return str(error)
    return ""


def _measure_one(result: Result, journal: Journal, options: Options) -> None:
    """Fill in one result, printing its table; it is filled also where Ctrl-C ends it."""
    from playground.measure.report.text import heading, table

    experiment = result.experiment
    if not options.as_json:
        print(heading(experiment))
    if result.skipped:
        if not options.as_json:
            print(f"skipped: {result.skipped}\n")
        return
    groups = [list(group) for group in experiment.groups(options.quick)]
    every = [candidate for group in groups for candidate in group]
    try:
        with _bar(experiment, groups, options) as bar:
            for group in groups:
                for doing in measure_group(experiment, group, options.rounds, journal):
                    bar.set_postfix_str(doing)
                    bar.update()
        result.complete = True
    finally:
        result.rows = rows_of(experiment, every, journal)
        if not options.as_json and result.rows:
            print(table(experiment, result.rows))
            print(f"=> {result.finding()}\n" if result.complete else "(not finished)\n")
            sys.stdout.flush()


def measure_group(
    experiment: Experiment, group: list[Candidate], rounds: int, journal: Journal
) -> Iterator[str]:
    """Measure what of a group the journal does not hold, yielding what is done after each step.

    The errors come first; then the candidates take turns, one round of each at a time, so that a
    machine that slows down slows all of them.
    """
    name = experiment.name
    for candidate in group:
        if candidate.errors is not None and journal.errors(name, candidate) is None:
            journal.add(name, candidate, candidate.errors())
        yield f"{candidate.method}: error"
    missing = [
        (number, candidate)
        for number in range(rounds)
        for candidate in group
        if number not in journal.batches(name, candidate)
    ]
    for _ in range(rounds * len(group) - len(missing)):
        yield "known"
    with ExitStack() as stack:
        open_ones = {c.key: c.open(stack) for c in group if any(c is m for _, m in missing)}
        for number, candidate in missing:
            journal.add(name, candidate, open_ones[candidate.key](), number)
            yield candidate.method


def _bar(experiment: Experiment, groups: list[list[Candidate]], options: Options) -> Any:
    """A progress bar on standard error, where that is a terminal."""
    from tqdm import tqdm

    total = sum(len(group) for group in groups) * (options.rounds + 1)
    silent = options.as_json or not sys.stderr.isatty()
    return tqdm(total=total, desc=experiment.name, leave=False, disable=silent, unit="step")


def _write(
    results: list[Result],
    journal: Journal,
    found: dict[str, Any],
    folder: Path | None,
    options: Options,
    stopped: bool,
) -> None:
    from playground.measure.report.data import as_data

    if folder is not None:
        from playground.measure.report.write import write_report

        page = write_report(results, journal, found, folder, options.quick, stopped)
        _say(f"the report: {page}")
    if options.as_json:
        print(json.dumps(as_data(results, found, options.quick)))


def _tell_stopped(journal: Journal, folder: Path | None) -> None:
    if folder is None:
        _say("stopped; without -o FOLDER nothing is kept")
    else:
        _say(f"stopped; {len(journal.lines)} samples are kept in {folder}")
        _say("to go on, give the same command again")


def _say(text: str) -> None:
    print(text, file=sys.stderr)
