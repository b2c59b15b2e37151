"""Shader sources: assembled from files by ``#include``, errors traced back to file and line.

Every included file stands in an ``#ifndef`` guard made here, so that it counts once and
an include inside ``#if`` means what it says; the expanded text carries ``// from: FILE``
marks. Defines are injected from Python, so that no constant is
written twice. No ``#line`` directives: drivers disagree about them, so the table of
lines is kept here instead.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache
from math import isfinite
from typing import Any

import numpy as np
from numpy.typing import NDArray

from playground import locate

VERSION = "#version 330 core"
_INCLUDE = re.compile(r'^\s*#include\s+"([^"]+)"\s*$')
_HALF_INCLUDE = re.compile(r"^\s*#\s*include\b")
# "0:12(5): error: ..." (Mesa), "0(12) : error C1008: ..." (NVIDIA), "ERROR: 0:12: ..." (others)
_ERROR = re.compile(r"(?:ERROR:\s*)?\d+(?::(\d+)(?:\(\d+\))?|\((\d+)\))\s*:\s*(.+)")


@dataclass(frozen=True)
class Source:
    """An assembled stage: its text, and for each line the file and line it came from."""

    name: str
    text: str
    origin: tuple[tuple[str, int], ...]

    def where(self, line: int) -> str:
        """``shaders/FILE:LINE`` for a line (from 1) of the expanded text."""
        file, number = self.origin[min(max(line, 1), len(self.origin)) - 1]
        return f"shaders/{file}:{number}"

    def explain(self, log: str) -> str:
        """A driver's message with every position replaced by file and line."""
        lines = []
        for line in log.splitlines():
            found = _ERROR.search(line)
            if found:
                number = int(found.group(1) or found.group(2))
                lines.append(f"{self.where(number)}: {found.group(3)}")
        return "\n".join(lines) or log.strip()


def shader_text(name: str, overrides: Mapping[str, str]) -> str:
    """The text of a shader file, or the one that takes its place."""
    if name in overrides:
        return overrides[name]
    return locate.shader(name).read_text(encoding="utf-8")


@cache
def _read(name: str, bugs: tuple[str, ...]) -> tuple[str, ...]:
    return _lines(name, shader_text(name, {}), bugs)


def _lines(name: str, text: str, bugs: tuple[str, ...]) -> tuple[str, ...]:
    if bugs:
        from playground.render.gl.bugs import with_bugs

        text = with_bugs(name, text, bugs)
    return tuple(text.splitlines())


def assemble(
    name: str,
    defines: Mapping[str, object] | None = None,
    tail: str = "",
    bugs: tuple[str, ...] = (),
    overrides: Mapping[str, str] | None = None,
    first: tuple[str, ...] = (),
) -> Source:
    """Expand the shader file ``name`` with ``defines`` and files ``first`` on top, ``tail`` below.

    ``bugs`` are classic mistakes to make on the way, see `playground.render.gl.bugs`;
    ``overrides`` are texts that take the place of files, by the files' names.

    Raises
    ------
    FileNotFoundError
        An include names no file; the message says which file asked for it.
    ValueError
        A file includes itself, or something stands behind an include.
    """
    lines: list[str] = [VERSION]
    origin: list[tuple[str, int]] = [("(defines)", 1)]
    for key, value in (defines or {}).items():
        lines.append(f"#define {key} {int(value) if isinstance(value, bool) else value}")
        origin.append(("(defines)", len(lines)))
    for file in (*first, name):
        _expand(file, lines, origin, (), bugs, overrides or {})
    for number, line in enumerate(tail.splitlines(), 1):
        lines.append(line)
        origin.append(("(tail)", number))
    return Source(name, "\n".join(lines) + "\n", tuple(origin))


def _expand(
    name: str,
    lines: list[str],
    origin: list[tuple[str, int]],
    above: tuple[str, ...],
    bugs: tuple[str, ...],
    overrides: Mapping[str, str],
) -> None:
    text = _lines(name, overrides[name], bugs) if name in overrides else _read(name, bugs)

    def emit(text: str, number: int) -> None:
        lines.append(text)
        origin.append((name, number))

    emit(f"// from: {name}", 1)
    for number, line in enumerate(text, 1):
        found = _INCLUDE.match(line)
        if not found:
            if _HALF_INCLUDE.match(line):  # moderngl would try, and not say where it stands
                words = 'an include is #include "FILE" with nothing behind it'
                raise ValueError(f"shaders/{name}:{number}: {words}")
            emit(line, number)
            continue
        wanted = found.group(1)
        if wanted in (*above, name):
            raise ValueError(f'shaders/{name}:{number}: #include "{wanted}" includes itself')
        if not locate.shader(wanted).is_file():
            raise FileNotFoundError(f'shaders/{name}:{number}: #include "{wanted}": no such file')
        guard = "INCLUDED_" + re.sub(r"\W", "_", wanted)
        emit(f"#ifndef {guard}", number)
        emit(f"#define {guard}", number)
        _expand(wanted, lines, origin, (*above, name), bugs, overrides)
        emit("#endif", number)
        emit(f"// from: {name}", number)


_UNIFORM = re.compile(r"^uniform\s+(float|double|d?vec[23])\s+(\w+)(\[\w+\])?;$")


def bake(source: Source, constants: Mapping[str, Any]) -> Source:
    """``source`` with the named uniforms turned into constants.

    A driver folds constants into the code; llvmpipe loads every component of a uniform
    anew for every 8 pixels. Worth a compilation for a scene that stays as it is.
    """
    lines = source.text.splitlines()
    for i, line in enumerate(lines):
        found = _UNIFORM.match(line)
        if found and found.group(2) in constants:
            kind, name, array = found.groups()
            dtype = np.float64 if kind.startswith("d") else np.float32
            value = np.asarray(constants[name], dtype=dtype)
            items = [_literal(kind, item) for item in (value if array else value[None])]
            literal = f"{kind}[{len(items)}]({', '.join(items)})" if array else items[0]
            lines[i] = f"const {kind} {name}{array or ''} = {literal};"
    return replace(source, text="\n".join(lines) + "\n")


def _literal(kind: str, value: NDArray[Any]) -> str:
    """A number or vector to the bit: 9 digits tell any two float32 apart, 17 any two float64."""
    pattern = "{:.16e}lf" if kind.startswith("d") else "{:.8e}"
    digits = [pattern.format(x) if isfinite(x) else _not_finite(x) for x in value.flat]
    return digits[0] if kind in ("float", "double") else f"{kind}({', '.join(digits)})"


def _not_finite(x: float) -> str:
    """Infinity (a number beyond the range of float16) or NaN, which GLSL cannot spell."""
    return f"uintBitsToFloat({int(np.float32(x).view(np.uint32))}u)"
