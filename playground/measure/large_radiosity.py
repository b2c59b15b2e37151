"""One large solution in a process of its own, so that its peak memory is its own too.

``python -m playground.measure.large_radiosity PATCHES METHOD`` solves the Cornell box with form
factors by METHOD and prints what it took as a line of JSON.
"""

from __future__ import annotations

import json
import subprocess
import sys
import time
from pathlib import Path

from playground.render.radiosity.result import radiosity
from playground.scene.library import load


def solved_elsewhere(patches: int, method: str) -> dict[str, float]:
    """What a process of its own says: seconds, seconds of all processors, megabytes, patches."""
    command = [sys.executable, "-m", __name__, str(patches), method]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    found: dict[str, float] = json.loads(done.stdout)
    return found


def main() -> None:
    """Solve with about as many patches as the first argument says."""
    patches, method = int(sys.argv[1]), sys.argv[2]
    setup = load("cornell-box").with_(patches=patches, form_factors=method)
    start, used = time.perf_counter(), time.process_time()
    result = radiosity(setup).solve()
    found = {
        "seconds": time.perf_counter() - start,
        "processors": time.process_time() - used,
        "megabytes": _peak(),
        "patches": len(result.patches),
    }
    result.close()
    print(json.dumps(found))


def _peak() -> float:
    """The most memory this process has held, in megabytes; 0 where the system does not say.

    Linux says it in /proc; its ``ru_maxrss`` starts with that of the process that started this one.
    """
    status = Path("/proc/self/status")
    if status.exists():
        lines = dict(line.split(":", 1) for line in status.read_text().splitlines())
        return float(lines["VmHWM"].split()[0]) / 1024.0
    try:
        import resource
    except ImportError:  # Windows
        return 0.0
    unit = 1024.0**2 if sys.platform == "darwin" else 1024.0
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / unit


if __name__ == "__main__":
    main()
