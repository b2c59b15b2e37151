"""Lines of a shader file, for a lesson to show: the code that runs, not a copy of it."""

from __future__ import annotations

from playground import locate
from playground.errors import PlaygroundError
from playground.files import read_bytes


def shader_lines(file: str, first: str, last: str, plain: bool = False) -> str:
    """The lines from the one that begins with ``first`` to the next that begins with ``last``.

    With ``plain``, those alone that are left where no feature is on.

    Raises
    ------
    PlaygroundError
        There is no such file, or no such line in it.
    """
    lines = read_bytes(locate.shader(file)).decode("utf-8").splitlines()
    lines = _without_features(lines) if plain else lines
    start = _next(lines, first, 0, file) if first else _behind_comments(lines)
    end = _next(lines, last, start, file) if last else len(lines) - 1
    return "\n".join(lines[start : end + 1])


def _without_features(lines: list[str]) -> list[str]:
    """The lines that are left if every condition of an ``#if`` is 0."""
    kept, off = list[str](), [False]  # of each condition that is open, whether it is off here
    for line in lines:
        word = line.partition(" ")[0]
        if word in ("#if", "#ifdef", "#ifndef"):
            off.append(word != "#ifndef")
        elif word == "#else":
            off[-1] = not off[-1]
        elif word == "#endif":
            off.pop()
        elif not any(off):
            kept.append(line)
    return kept


def _behind_comments(lines: list[str]) -> int:
    return next((i for i, line in enumerate(lines) if not line.startswith("//")), 0)


def _next(lines: list[str], begin: str, start: int, file: str) -> int:
    """The number of the first line from ``start`` on that begins so."""
    for number, line in enumerate(lines[start:], start):
        if line.startswith(begin):
            return number
    raise PlaygroundError(f"no line of shaders/{file} begins so", got=begin)
