"""Opening what takes long to read: the mesh is read apart while the window goes on."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from playground.errors import PlaygroundError
from playground.files import Stamp, resolved, stamp
from playground.gui.work.long_work import Piece, Pieces, Progress
from playground.scene.library import load
from playground.scene.read_apart import read_apart
from playground.scene.scene import MESH_FILES, Object

_known: set[Stamp] = set()  # files that have been read: the mesh is remembered
LARGE = 2**20  # bytes: what is smaller is read in about a fifth of a second


@dataclass(frozen=True)
class Reading:
    """What is being read."""

    name: str  # as it was asked for: a file
    meshes: tuple[str, ...]
    progress: Progress = Progress(None)

    @property
    def words(self) -> str:
        """What the window says meanwhile."""
        return f"reading {Path(self.name).name} ..."


def large_meshes(name: str | Path) -> tuple[str, ...]:
    """The mesh files that take long to read among those that a file needs."""
    path = Path(name)
    suffix = path.suffix.lower()
    try:
        if suffix in MESH_FILES:
            meshes = [str(resolved(path))]
        elif suffix in (".toml", ".png"):
            meshes = [item.mesh for item in load(path).scene.objects]
        else:
            return ()
    except PlaygroundError:  # whoever opens it says why
        return ()
    return tuple(dict.fromkeys(mesh for mesh in meshes if _large(Path(mesh))))


def _large(path: Path) -> bool:
    try:
        large = path.suffix.lower() in MESH_FILES and path.stat().st_size > LARGE
    except (OSError, ValueError):
        return False
    return large and stamp(path) not in _known


def pieces(meshes: tuple[str, ...]) -> Pieces[str]:
    """Read them one after the other; how long it takes nobody knows."""
    for mesh in meshes:
        for _ in read_apart(mesh):
            yield Piece()
        ready = Object(mesh=mesh).geometry().mesh
        _ = ready.radius, ready.cullable  # remembered by the mesh; the first frame asks for them
        _known.add(stamp(Path(mesh)))
        yield Piece(None, mesh)
