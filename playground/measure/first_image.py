"""How long a cold process takes to its first image, and how much memory at its peak."""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np


@dataclass(frozen=True)
class FirstImage:
    """Seconds from the start of the process to its end, and megabytes at the peak."""

    command: str
    median: float
    low: float
    high: float
    megabytes: float


def measure_first_image(rounds: int = 9) -> list[FirstImage]:
    """Our command, the floor, and an empty import of NumPy beside one of the package, in turn.

    The floor is left out where there is no GL driver.
    """
    from playground.render.gl.context import available

    with tempfile.TemporaryDirectory() as folder:
        file = str(Path(folder) / "a.png")
        commands = {
            "playground render sphere": ["-m", "playground", "render", "sphere", "-o", file],
            "floor": ["-m", "playground.measure.floor", file],
            "import numpy": ["-c", "import numpy"],
            "import numpy, playground": ["-c", "import numpy, playground"],
        }
        if not available():
            del commands["floor"]
        runs: dict[str, list[tuple[float, float]]] = {name: [] for name in commands}
        for _ in range(rounds):
            for name, arguments in commands.items():
                runs[name].append(_run([sys.executable, *arguments]))
    rows = []
    for name, measured in runs.items():
        seconds, megabytes = zip(*measured, strict=True)
        low, median, high = np.percentile(seconds, [10, 50, 90])
        rows.append(FirstImage(name, median, low, high, float(np.median(megabytes))))
    return rows


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


def _run(command: list[str]) -> tuple[float, float]:
    starter = [sys.executable, "-S", "-c", _STARTER, *command]
    done = subprocess.run(starter, capture_output=True, text=True, check=True)
    seconds, kilobytes, status = json.loads(done.stdout)
    if status:
        raise RuntimeError(f"{' '.join(command)} ended with status {status}")
    return seconds, kilobytes / 1024
