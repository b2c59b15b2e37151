"""Setup files (TOML): read, written, and written again without losing comments."""

from __future__ import annotations

import os.path
import tomllib
from pathlib import Path
from typing import Any

from playground.errors import PlaygroundError, shown, why_unread
from playground.files import read_bytes, write_whole
from playground.scene.setup import Setup
from playground.scene.table import Table, from_table, to_table


def read_setup(path: Path) -> Setup:
    """The setup in a TOML file.

    Raises
    ------
    PlaygroundError
        The file is missing or no TOML (with line and column), or a value in it is wrong.
    """
    try:
        return parse_setup(read_bytes(path).decode("utf-8"), path.stem, path.parent)
    except UnicodeDecodeError as error:
        raise PlaygroundError(
            f"{path} is not text", got=str(error.reason), allowed="UTF-8", fix="Save it as UTF-8."
        ) from None
    except PlaygroundError as error:
        raise _in_file(error, path) from None


def parse_setup(text: str, name: str, folder: Path | None = None) -> Setup:
    """The setup in TOML text; relative files are looked up in ``folder``."""
    try:
        table = tomllib.loads(text)
    except (ValueError, RecursionError) as error:  # beyond its own: endless digits, deep nesting
        raise PlaygroundError(
            "not valid TOML",
            got=why_unread(error),
            fix="See the setup files in assets/scenes for the form.",
        ) from None
    return from_table(table, name, folder)


def format_setup(setup: Setup, folder: Path | None = None, before: str = "") -> str:
    """The setup as TOML text; comments and order of the text ``before`` survive."""
    import tomlkit

    document = tomlkit.parse(before)
    _merge(document, to_table(setup, folder))
    return tomlkit.dumps(document)


def save(setup: Setup, path: str | Path) -> None:
    """Write a setup file; where ``path`` already is one, its comments stay."""
    if not isinstance(path, (str, Path)) or not isinstance(setup, Setup):
        raise PlaygroundError(
            "save takes a setup and a path", got=f"{type(setup).__name__}, {shown(path)}"
        )
    path = Path(path)
    if path.suffix.lower() != ".toml":
        raise PlaygroundError(
            "a setup is saved as .toml", got=str(path), fix=f"Call it {path.stem}.toml."
        )
    before = ""
    if os.path.exists(path):  # unlike Path.exists, no error for a name that is too long
        before = read_bytes(path).decode("utf-8", "replace")
        try:
            tomllib.loads(before)
        except (ValueError, RecursionError):
            before = ""
    write_whole(path, format_setup(setup, path.parent, before).encode("utf-8"))


def _merge(old: Any, new: Table) -> None:
    """Make the TOML table ``old`` say what ``new`` says, touching only what differs."""
    import tomlkit

    for key in [key for key in old if key not in new]:
        del old[key]
    for key, value in new.items():
        if key in old and isinstance(value, dict) and isinstance(old[key], dict):
            _merge(old[key], value)
        elif key in old and _tables(value) and _tables(old[key]):
            _merge_list(old[key], value)
        elif key in ("light", "object") and not value:
            old[key] = tomlkit.array()
        elif _tables(value):
            old[key] = tomlkit.aot()
            _merge_list(old[key], value)
        elif key not in old or old[key] != value:
            old[key] = value


def _merge_list(old: Any, new: list[Table]) -> None:
    import tomlkit

    while len(old) > len(new):
        del old[len(old) - 1]
    for i, entry in enumerate(new):
        if i == len(old):
            old.append(tomlkit.table())
        _merge(old[i], entry)


def _tables(value: Any) -> bool:
    return isinstance(value, list) and bool(value) and all(isinstance(v, dict) for v in value)


def _in_file(error: PlaygroundError, path: Path) -> PlaygroundError:
    if str(path) in error.what:
        return error
    return PlaygroundError(
        f"{path}: {error.what}", got=error.got, allowed=error.allowed, fix=error.fix
    )
