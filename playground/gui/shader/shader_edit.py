"""Shader files in the window: what runs, what the user made of it, what stands on disk.

Pure functions from state to state; `Watch` alone looks at the disk.
"""

from __future__ import annotations

import re
from dataclasses import replace
from functools import lru_cache
from time import monotonic

from playground import locate
from playground.gui.shader.live_files import live_files
from playground.gui.state import State, Texts
from playground.render.gl.program import STAGES, sources_for
from playground.render.gl.source import shader_text
from playground.render.needs import Needs, needs
from playground.render.surface import surfaces
from playground.render.view import view_of
from playground.scene.camera import Camera
from playground.scene.scene import Scene
from playground.scene.settings import Settings

PAUSE = 1.0  # seconds between two looks at the files
FEW = 3  # more changed files than this are counted, not named
_PLACE = re.compile(r"shaders/([\w./]+):(\d+): (.*)")
_CALL = re.compile(r"^(?!\s*//)(?!\s*void\b).*\b(?:emit_colours|shade)\s*\(")
_INCLUDE = re.compile(r'^\s*#include\s+"([^"]+)"')


def overrides(state: State) -> dict[str, str]:
    """What takes the place of the shader files as they were when the window opened."""
    return {**dict(state.on_disk), **dict(state.edits)}


def original(state: State, file: str) -> str:
    """The text of a file as it stands on disk."""
    return dict(state.on_disk).get(file) or _at_first(file)


@lru_cache(maxsize=64)
def _at_first(file: str) -> str:
    return shader_text(file, {})


def text_of(state: State, file: str) -> str:
    """The text of a file with the user's edits."""
    return dict(state.edits).get(file, original(state, file))


def edited(state: State, file: str, text: str) -> State:
    """The state with another text in ``file``; nothing is written to disk."""
    edits = {**dict(state.edits), file: text}
    if text == original(state, file):
        del edits[file]
    return replace(state, edits=tuple(sorted(edits.items())))


def reverted(state: State, file: str | None = None) -> State:
    """The state without the edits of ``file``, or without any."""
    edits = tuple((f, t) for f, t in state.edits if file is not None and f != file)
    return replace(state, edits=edits).say(f"{file or 'every shader'} as it stands on disk")


def reloaded(state: State, files: Texts) -> State:
    """The state after files have changed on disk; the user's edits of them stay."""
    names = [file for file, _ in files]
    kept = [file for file in names if file in dict(state.edits)]
    told = ", ".join(names) if len(names) <= FEW else f"{len(names)} shader files"
    message = f"{told} changed on disk" + (
        f"; your edits of {', '.join(kept)} stay until you revert them" if kept else ": reloaded"
    )
    on_disk = tuple(sorted({**dict(state.on_disk), **dict(files)}.items()))
    return replace(state, on_disk=on_disk).say(message)


def errors_in(message: str, file: str) -> list[tuple[int, str]]:
    """The lines (from 1) of ``file`` that a compiler's message names, and what it says."""
    found = _PLACE.finditer(message)
    return [(int(hit.group(2)), hit.group(3)) for hit in found if hit.group(1) == file]


def first_place(message: str) -> str | None:
    """The file that the message names first."""
    found = _PLACE.search(message)
    return found.group(1) if found else None


@lru_cache(maxsize=32)
def includes(text: str) -> list[tuple[int, str]]:
    """The lines (from 1) with an include, and the file that is meant."""
    found = ((i, _INCLUDE.match(line)) for i, line in enumerate(text.splitlines(), 1))
    return [(i, hit.group(1)) for i, hit in found if hit]


@lru_cache(maxsize=32)
def calls(text: str) -> list[int]:
    """The lines (from 1) that call the lighting."""
    return [i for i, line in enumerate(text.splitlines(), 1) if _CALL.match(line)]


def running(state: State) -> tuple[str, ...]:
    """The files of which the chosen object's program consists, in the order of reading."""
    wanted = needs_of(state)
    return _files(wanted) if wanted else ()


def needs_of(state: State) -> Needs | None:
    """What the program of the chosen object needs; None where there is no object."""
    setup = state.setup
    return _needs(setup.scene, setup.camera, setup.settings, state.chosen)


@lru_cache(maxsize=4)
def _needs(scene: Scene, camera: Camera, settings: Settings, chosen: int) -> Needs | None:
    everything = surfaces(scene, settings.weights)
    if not everything:
        return None
    surface = everything[min(chosen, len(everything) - 1)]
    return needs(surface, view_of(camera, everything, (4, 3)), settings, True)


@lru_cache(maxsize=8)
def _files(wanted: Needs) -> tuple[str, ...]:
    """The files that the preprocessor keeps, the two stages first."""
    found: dict[str, None] = {}
    for source in sources_for(wanted):
        found |= live_files(source)
    stages = STAGES[wanted.shading]
    return tuple(sorted(found, key=lambda file: file not in stages))


class Watch:
    """Notices changes of the shader files on disk, at most once a second."""

    def __init__(self) -> None:
        self._stamps = self._look()
        self._next = monotonic() + PAUSE

    def changed(self) -> Texts:
        """The files that have changed since the last call, with what stands in them now."""
        if monotonic() < self._next:
            return ()
        self._next = monotonic() + PAUSE
        before, self._stamps = self._stamps, self._look()
        files = [file for file, stamp in self._stamps.items() if before.get(file) != stamp]
        return tuple((file, text) for file in files if (text := _read(file)) is not None)

    def due(self) -> bool:
        """Whether `changed` would find something."""
        return monotonic() >= self._next and self._look() != self._stamps

    @staticmethod
    def _look() -> dict[str, tuple[int, int]]:
        folder = locate.shader("")
        stamps = {}
        for kind in ("*.vert", "*.frag", "*.glsl"):
            for path in folder.rglob(kind):
                try:
                    state = path.stat()
                except OSError:
                    continue
                stamps[path.relative_to(folder).as_posix()] = (state.st_mtime_ns, state.st_size)
        return stamps


def _read(file: str) -> str | None:
    try:
        return locate.shader(file).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError):  # being written just now: the next look finds it
        return None
