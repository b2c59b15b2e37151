"""``key=value`` from a command line or a text box: one quantity of a setup, by its path.

``shininess=20`` sets a knob by its name, as `Setup.with_` does; ``light.0.diffuse=1,0,0``,
``object.1.material.shininess=5``, ``object.0.transform.scale=1,2,1``, ``camera.eye=0,0,4``
say exactly which.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from playground.errors import PlaygroundError, shortened, unknown_name
from playground.scene.knob import Knob, knobs
from playground.scene.light import LIGHTS, Light
from playground.scene.setup import Setup, owner_of

SECTIONS = ("scene", "camera", "settings", "light", "object")
WHOLE = {  # what is no single quantity, and how to write one of it
    "scene": "scene.background=0,0,0",
    "camera": "camera.eye=0,0,4",
    "settings": "settings.gate=on",
    "lights": "light.0.diffuse=1,0,0",
    "objects": "object.0.mesh=box",
    "light": "light.0.diffuse=1,0,0",
    "object": "object.0.mesh=box",
    "material": "object.0.material.shininess=20",
    "transform": "object.0.transform.size=2",
}
_TRUE, _FALSE = ("true", "on", "yes", "1"), ("false", "off", "no", "0")


def assign(setup: Setup, assignment: str) -> Setup:
    """``setup`` with the quantity that ``assignment`` names set to its value.

    Raises
    ------
    PlaygroundError
        No ``=``, a path that leads nowhere, or a value out of range.
    """
    path, equals, value = assignment.partition("=")
    path = path.strip()
    if not equals or not path:
        raise PlaygroundError(
            "cannot set this", got=assignment, allowed="key=value", fix="Write shininess=20."
        )
    parts = path.split(".")
    if len(parts) == 1:
        if path in WHOLE:
            raise PlaygroundError(
                f"'{path}' is no single quantity",
                got=assignment,
                allowed="key=value, with the whole path as the key",
                fix=f"Write {WHOLE[path]}.",
            )
        knob = knobs(owner_of(path)[1])[path]
        return setup.with_(**{path: read(knob, value, path)})
    section, rest = parts[0], parts[1:]
    if section in ("light", "object"):
        name = f"{section}s"
        items = list(getattr(setup.scene, name))
        index = _index(rest[0], len(items), section)
        items[index] = _changed(items[index], rest[1:], value, f"{section}.{index}")
        return setup.with_(**{name: tuple(items)})
    if section not in SECTIONS:
        raise unknown_name("section", section, SECTIONS)
    return replace(setup, **{section: _changed(getattr(setup, section), rest, value, section)})


def read(knob: Knob, text: str, where: str) -> Any:
    """The value that ``text`` means for ``knob``: ``1,0,0`` is a colour, ``on`` a switch.

    Points of an outline stand between slashes: ``0,2,0/1,2,0/0,2,1``.
    """
    text = text.strip()
    if knob.kind in ("text", "choice", "names"):
        return knob.check(text, where)
    if knob.kind == "switch":
        if text.lower() not in (*_TRUE, *_FALSE):
            return knob.check(text, where)
        return text.lower() in _TRUE
    if knob.kind == "vertices":
        points = [[_number(x) for x in point.split(",")] for point in text.strip("[]()").split("/")]
        return knob.check(points, where)
    numbers = [_number(part) for part in text.strip("[]()").split(",")]
    triple = knob.kind in ("colour", "vector")
    return knob.check(numbers if triple else numbers[0] if len(numbers) == 1 else text, where)


def parse_light(text: str) -> Light:
    """A light from ``TYPE key=value ...``: ``point position=1,2,3 diffuse=1,0.5,0``."""
    words = text.replace(";", " ").split()
    if not words:
        raise PlaygroundError("a light needs a type", allowed=", ".join(LIGHTS))
    kind = words[0].removeprefix("type=")
    if kind not in LIGHTS:
        raise unknown_name("light", kind, LIGHTS)
    known, values = knobs(LIGHTS[kind]), {}
    for word in words[1:]:
        key, equals, value = word.partition("=")
        if not equals or key not in known:
            raise unknown_name(f"key of a {kind} light", key, known)
        values[key] = read(known[key], value, f"light.{key}")
    return LIGHTS[kind](**values)


def _changed(item: Any, path: list[str], value: str, where: str) -> Any:
    known = knobs(type(item))
    inner = [name for name in ("material", "transform") if hasattr(item, name)]
    if not path or (path[0] not in known and path[0] not in inner):
        raise unknown_name(f"key in {where}", ".".join(path), [*known, *inner])
    if path[0] in inner:
        changed = _changed(getattr(item, path[0]), path[1:], value, f"{where}.{path[0]}")
        return replace(item, **{path[0]: changed})
    if len(path) > 1:
        raise PlaygroundError(f"{where}.{path[0]} has no parts", got=".".join(path))
    return replace(item, **{path[0]: read(known[path[0]], value, f"{where}.{path[0]}")})


def _index(text: str, count: int, section: str) -> int:
    if not (text.isascii() and text.isdecimal() and len(text) <= 9) or int(text) >= count:
        allowed = f"0 to {count - 1}" if count else f"this setup has no {section}"
        raise PlaygroundError(f"there is no {section}.{shortened(text)}", allowed=allowed)
    return int(text)


def _number(text: str) -> float | str:
    """A number as it was written: what is wrong with it will be told in the same digits."""
    try:
        number = float(text)
    except ValueError:
        return text.strip()
    return int(number) if text.strip().lstrip("+-").isdecimal() and abs(number) < 1e15 else number
