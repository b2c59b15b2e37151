"""Large mesh files, read by a process of its own.

Python reads a long text in calls that let no other thread run: a window beside them
would freeze for seconds. A process takes nobody's time, and can be ended at any moment.
"""

from __future__ import annotations

import os
import pickle
import subprocess
import sys
import tempfile
from collections.abc import Generator
from pathlib import Path
from time import sleep

import playground
from playground.errors import PlaygroundError
from playground.files import stamp
from playground.scene.mesh import Mesh
from playground.scene.scene import Geometry, Object, give

LOOK = 0.02  # seconds between two looks at whether the process is done


def read_apart(mesh: str) -> Generator[None, None, None]:
    """Read a mesh file; yields while it waits. Objects then have the mesh without reading it.

    Closing the generator ends the process.

    Raises
    ------
    PlaygroundError
        What is wrong with the file, or that the process did not come to its end.
    """
    with tempfile.TemporaryDirectory(prefix="playground-") as folder:
        result, complaint = Path(folder, "mesh"), Path(folder, "errors")
        with complaint.open("wb") as errors:
            process = subprocess.Popen(
                [sys.executable, "-m", __name__, mesh, str(result)],
                stdin=subprocess.DEVNULL,
                stderr=errors,
                env=os.environ | {"PYTHONPATH": _search_path()},
            )
        try:
            while process.poll() is None:
                yield
                sleep(LOOK)
        finally:
            process.kill()
            process.wait()
        if process.returncode:
            lines = complaint.read_text(errors="replace").strip().splitlines()
            raise PlaygroundError(f"reading {mesh} failed", got=lines[-1] if lines else "nothing")
        _take(mesh, pickle.loads(result.read_bytes()))


def _search_path() -> str:
    """Where the process finds this package, wherever it was started."""
    here = str(Path(playground.__file__).parent.parent)
    return os.pathsep.join(filter(None, (here, os.environ.get("PYTHONPATH", ""))))


def _take(mesh: str, found: dict[str, object]) -> None:
    if "what" in found:
        raise PlaygroundError(**found)  # type: ignore[arg-type]
    geometry = Geometry(Mesh(**found["mesh"]), found["offset"])  # type: ignore[arg-type]
    give(mesh, found["state"], geometry)  # type: ignore[arg-type]


def main(mesh: str, result: str) -> None:
    """What the process does: read, and write the arrays or the complaint to ``result``."""
    found: dict[str, object] = {"state": stamp(Path(mesh))}
    try:
        geometry = Object(mesh=mesh).geometry()
    except PlaygroundError as error:
        found = {key: getattr(error, key) for key in ("what", "got", "allowed", "fix")}
        found["got"] = None if error.got is None else str(error.got)
    else:
        names = ("positions", "normals", "faces", "texcoords", "name")
        found["mesh"] = {name: getattr(geometry.mesh, name) for name in names}
        found["offset"] = geometry.offset
    Path(result).write_bytes(pickle.dumps(found, protocol=pickle.HIGHEST_PROTOCOL))


if __name__ == "__main__":
    main(*sys.argv[1:])
