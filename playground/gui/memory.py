"""What the window remembers from one run to the next, in the platform's settings folder.

One file, written whole; what is damaged in it is passed over with a message.
"""

from __future__ import annotations

import contextlib
import json
import os
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from playground.errors import PlaygroundError
from playground.files import make_folder, read_bytes, write_whole
from playground.gui.presentation import ended
from playground.gui.state import State
from playground.render.surface import surfaces
from playground.scene.knob import knobs
from playground.scene.library import library, load
from playground.scene.setup import Setup
from playground.scene.setup_file import format_setup, parse_setup

FOLDER = "PLAYGROUND_SETTINGS"  # the variable that names another folder
FILE = "window.json"
KEPT = ("theme", "text_size", "method", "layout", "level", "panel")  # knobs of the state
SMALLEST, LARGEST = 320, 16384  # pixels a window can be wide or high


@dataclass(frozen=True)
class Memory:
    """The window as it was left."""

    size: tuple[int, int] | None = None
    knobs: tuple[tuple[str, Any], ...] = ()
    recent: tuple[str, ...] = ()
    setup: Setup | None = None
    complaint: str = ""  # what could not be read


def place() -> Path:
    """The file; the environment variable `FOLDER` moves it elsewhere."""
    chosen = os.environ.get(FOLDER)
    if chosen:
        return Path(chosen) / FILE
    import platformdirs

    return platformdirs.user_config_path("lighting-playground", appauthor=False) / FILE


def recall(path: Path | None = None) -> Memory:
    """What was remembered; nothing, with a complaint, where the file is damaged."""
    path = place() if path is None else path
    if not path.is_file():
        return Memory()
    try:
        table = json.loads(read_bytes(path).decode("utf-8"))
        if not isinstance(table, dict):
            raise ValueError("no table")
        return _read(table)
    except (PlaygroundError, ValueError, RecursionError) as error:
        return Memory(complaint=f"{path} is damaged and was passed over: {error}")


def remember(state: State, size: tuple[int, int], path: Path | None = None) -> None:
    """Write down the window as it is.

    Raises
    ------
    PlaygroundError
        The folder cannot be made or written.
    """
    path = place() if path is None else path
    state = ended(state)
    table = {name: getattr(state, name) for name in KEPT}
    table |= {"size": list(size), "recent": list(state.recent), "name": state.setup.name}
    try:
        table["setup"] = format_setup(state.setup)
    except PlaygroundError:  # meshes made in Python have no file
        table["setup"] = ""
    make_folder(path.parent)
    write_whole(path, (json.dumps(table, indent=1, ensure_ascii=False) + "\n").encode("utf-8"))


def keep(state: State, size: tuple[int, int]) -> None:
    """As `remember`; a folder that takes no files is no reason to end with an error."""
    with contextlib.suppress(PlaygroundError):
        remember(state, size)


def recalled(state: State, memory: Memory) -> State:
    """The state of a new window with what was remembered; reset leads to the library."""
    state = replace(state, recent=memory.recent, **dict(memory.knobs))
    if state.setup.name in library():
        ours = load(state.setup.name).with_(samples=state.setup.settings.samples)
        state = replace(state, loaded=ours)
    return state.fail(memory.complaint) if memory.complaint else state


def _read(table: dict[str, Any]) -> Memory:
    """Each entry by itself: one that is wrong does not spoil the others."""
    wrong: list[str] = []
    known, kept = knobs(State), []
    for name in KEPT:
        if name in table:
            try:
                kept.append((name, known[name].check(table[name], name)))
            except PlaygroundError:
                wrong.append(name)
    size, recent = table.get("size"), table.get("recent", [])
    if not (isinstance(size, list) and len(size) == 2 and all(_pixels(v) for v in size)):
        wrong += ["size"] if size is not None else []
        size = None
    if not (isinstance(recent, list) and all(isinstance(name, str) for name in recent)):
        wrong, recent = [*wrong, "recent"], []
    setup: Setup | None = None
    called = table.get("name")
    if table.get("setup"):
        try:
            setup = parse_setup(str(table["setup"]), called if isinstance(called, str) else "last")
            surfaces(setup.scene, setup.settings.weights)  # reads meshes and textures, or refuses
        except PlaygroundError as error:
            setup = None
            wrong.append(f"setup ({error})")
    complaint = f"not remembered, as it was damaged: {', '.join(wrong)}" if wrong else ""
    return Memory(
        (size[0], size[1]) if size else None, tuple(kept), tuple(recent), setup, complaint
    )


def _pixels(value: object) -> bool:
    return isinstance(value, int) and SMALLEST <= value <= LARGEST
