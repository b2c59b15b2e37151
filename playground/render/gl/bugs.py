"""The bug zoo: classic mistakes of shader writers, as edits of our shader files.

Nothing of them stands in the shaders themselves, and the NumPy reference knows none:
a picture with a bug is compared with the right one.
"""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from functools import cache

from playground import locate


@dataclass(frozen=True)
class Edit:
    """Text of a shader file that a bug replaces; ``find`` stands there exactly once."""

    file: str
    find: str
    replace: str


@dataclass(frozen=True)
class Bug:
    """A classic mistake: what it is called, what it breaks, where it shows, how it is made."""

    name: str
    title: str
    breaks: str
    look: str
    edits: tuple[Edit, ...]
    set: tuple[str, ...] = ()  # assignments to the setup `look`


@cache
def zoo() -> dict[str, Bug]:
    """Every bug of ``shaders/bugs.toml`` by its name."""
    table = tomllib.loads(locate.shader("bugs.toml").read_text(encoding="utf-8"))
    bugs = {}
    for name, entry in table.items():
        edits = tuple(Edit(**edit) for edit in entry.pop("edits"))
        changes = tuple(entry.pop("set", ()))
        bugs[name] = Bug(name, edits=edits, set=changes, **entry)
    return bugs


def with_bugs(file: str, text: str, bugs: tuple[str, ...]) -> str:
    """The text of a shader file with the edits that the named bugs make in it.

    Raises
    ------
    ValueError
        An edit does not find its text exactly once: shader and zoo have drifted apart.
    """
    for bug in (zoo()[name] for name in bugs):
        for edit in bug.edits:
            if edit.file == file:
                if text.count(edit.find) != 1:
                    raise ValueError(
                        f"shaders/{file}: bug '{bug.name}' does not find {edit.find!r}"
                    )
                text = text.replace(edit.find, edit.replace)
    return text
