"""Which shader files the preprocessor keeps: an include in an ``#if`` may not count."""

from __future__ import annotations

import re

from playground.render.gl.source import Source

_DIRECTIVE = re.compile(r"^\s*#\s*(define|ifdef|ifndef|if|elif|else|endif)\b\s*(.*?)\s*(?://.*)?$")
_NAME = re.compile(r"\b[A-Za-z_]\w*\b")
_SIGNS = (("&&", " and "), ("||", " or "), ("!=", " != "))


def live_files(source: Source) -> dict[str, None]:
    """The files with a line that is compiled, in the order of reading."""
    defined = {"__VERSION__": "330"}
    # For each open #if: whether its present part counts, and whether one has counted yet.
    open_parts: list[tuple[bool, bool]] = []
    found: dict[str, None] = {}
    for line, (file, _) in zip(source.text.splitlines(), source.origin, strict=False):
        met = _DIRECTIVE.match(line)
        live = all(part for part, _ in open_parts)
        if met is None:
            if live and not file.startswith("("):
                found[file] = None
            continue
        word, rest = met.group(1), met.group(2)
        if word == "define":
            name, _, value = rest.partition(" ")
            defined |= {name: value or "1"} if live else {}
        elif word == "endif":
            open_parts.pop()
        elif word in ("elif", "else"):
            had = open_parts.pop()[1]
            now = not had and (word == "else" or holds(rest, defined))
            open_parts.append((now, had or now))
        else:
            now = rest in defined if word == "ifdef" else rest not in defined
            now = holds(rest, defined) if word == "if" else now
            open_parts.append((now, now))
    return found


def holds(condition: str, defined: dict[str, str]) -> bool:
    """Whether the condition of an ``#if`` is met: whole numbers, names, comparisons, && || !."""
    for sign, word in _SIGNS:
        condition = condition.replace(sign, word)
    condition = re.sub(r"!(?!=)", " not ", condition)
    words = {"and", "or", "not"}

    def value(name: re.Match[str]) -> str:
        return name[0] if name[0] in words else str(int(defined.get(name[0], "0")))

    return bool(eval(_NAME.sub(value, condition), {"__builtins__": {}}))
