"""How long a cold process takes to its first image, and how much memory at its peak."""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path

from playground.measure.experiments.sentences import of, sentence, took
from playground.measure.record import Batch, Candidate, Experiment, Timer
from playground.measure.rows import Row, difference

OURS, FLOOR = "playground render sphere", "floor"
BASE, IMPORT = "import numpy", "import numpy, playground"
COMMANDS: dict[str, Callable[[str], list[str]]] = {
    OURS: lambda file: ["-m", "playground", "render", "sphere", "-o", file],
    FLOOR: lambda file: ["-m", "playground.measure.floor", file],
    BASE: lambda _: ["-c", BASE],
    IMPORT: lambda _: ["-c", IMPORT],
}


def groups(quick: bool) -> Iterator[list[Candidate]]:
    """Our command, the floor where there is a driver, and two imports, in turn."""
    from playground.render.gl.context import available

    del quick  # one process takes as long as it takes; only the rounds are fewer
    yield [_candidate(name) for name in COMMANDS if name != FLOOR or available()]


def _candidate(command: str) -> Candidate:
    def opened(stack: ExitStack) -> Timer:
        folder = stack.enter_context(tempfile.TemporaryDirectory())
        arguments = COMMANDS[command](str(Path(folder) / "a.png"))

        def once() -> Batch:
            seconds, megabytes = run([sys.executable, *arguments])
            return Batch([seconds], {"megabytes": [megabytes]})

        return once

    return Candidate("cold process", {"command": command}, opened)


# A process inherits the peak memory of the one that starts it, so a small one does; prints
# seconds, kilobytes and the exit status.
_STARTER = """
import json, os, sys, time
null = os.open(os.devnull, os.O_WRONLY)
quiet = [(os.POSIX_SPAWN_DUP2, null, 1), (os.POSIX_SPAWN_DUP2, null, 2)]
start = time.perf_counter()
process = os.posix_spawn(sys.argv[1], sys.argv[1:], os.environ, file_actions=quiet)
_, status, usage = os.wait4(process, 0)
seconds = time.perf_counter() - start
print(json.dumps([seconds, usage.ru_maxrss, os.waitstatus_to_exitcode(status)]))
"""


def run(command: list[str]) -> tuple[float, float]:
    """Seconds from the start of a process to its end, and megabytes at its peak.

    Raises
    ------
    RuntimeError
        It ended with another status than 0.
    """
    starter = [sys.executable, "-S", "-c", _STARTER, *command]
    done = subprocess.run(starter, capture_output=True, text=True, check=True)
    seconds, kilobytes, status = json.loads(done.stdout)
    if status:
        raise RuntimeError(f"{' '.join(command)} ended with status {status}")
    return seconds, kilobytes / 1024


def finding(rows: list[Row]) -> str:
    """The first picture, beside the floor, and the import."""
    found = {str(row.knobs["command"]): row for row in of(rows, "cold process")}
    parts = []
    if OURS in found:
        ours = found[OURS]
        parts.append(
            f"the first picture takes {took(ours, 's')} and {ours.more['megabytes']:.0f} MB"
        )
        if FLOOR in found:
            floor = found[FLOOR]
            parts.append(f"the floor {took(floor, 's')} and {floor.more['megabytes']:.0f} MB")
    if BASE in found and IMPORT in found:
        low, more, high = (1e3 * s for s in difference(found[IMPORT], found[BASE]))
        parts.append(
            f"importing the package after NumPy takes {more:+.0f} ms "
            f"(10 % to 90 % of the rounds: {low:+.0f} to {high:+.0f})"
        )
    return sentence(*parts)


EXPERIMENT = Experiment(
    "first-image",
    "First image",
    "How long does a cold process take from its start to its end, and how much memory at its peak?",
    groups,
    finding,
    "",
    time_label="s per process",
    needs_gl=False,
    show=("megabytes",),
)
