"""A setup as the command that draws it: ``playground render teapot --set ... -o teapot.png``.

The names are those of ``--set``, see `playground.scene.assign`.
"""

from __future__ import annotations

import shlex
from collections.abc import Iterator
from typing import Any

from playground.errors import PlaygroundError
from playground.gui.state import RASTER, State
from playground.scene.knob import Knob, knobs
from playground.scene.library import load
from playground.scene.light import Light
from playground.scene.setup import Setup

SAVE = "Save the setup and render the file."


def command_line(setup: Setup, source: str, base: Setup, method: str = RASTER) -> str:
    """The command that draws ``setup``, which was made from ``base``.

    Parameters
    ----------
    setup : Setup
    source : str
        What ``base`` is called on a command line: a name of the library or a file.
    base : Setup
    method : {"raster", "ray-tracing", "radiosity", "lightmap"}

    Raises
    ------
    PlaygroundError
        The command line cannot say what differs: objects have come or gone.
    """
    words = ["playground", "render", source]
    words += ["--method", method] if method != RASTER else []
    words += _lights(setup, base)
    for assignment in assignments(setup, base):
        words += ["--set", assignment]
    return shlex.join([*words, "-o", f"{setup.name}.png"])


def copied(state: State) -> tuple[State, str]:
    """The command for the clipboard, and the state that says so; empty where there is none."""
    source = state.source or state.setup.name
    try:
        words = command_line(state.setup, source, load(source), state.method)
    except PlaygroundError as error:
        return state.fail(error), ""
    return state.say(f"copied: {words}"), words


def assignments(setup: Setup, base: Setup) -> list[str]:
    """What turns ``base`` into ``setup``, apart from lights that have come, gone or turned."""
    objects, before = setup.scene.objects, base.scene.objects
    if len(objects) != len(before) or any(
        a.arrays is not b.arrays for a, b in zip(objects, before, strict=True)
    ):
        raise PlaygroundError("the command line cannot add or remove objects", fix=SAVE)
    found: list[str] = []
    for part in ("settings", "camera", "scene"):
        found += _changes(part, getattr(setup, part), getattr(base, part))
    for i, (now, was) in enumerate(zip(objects, before, strict=True)):
        found += _changes(f"object.{i}", now, was)
        found += _changes(f"object.{i}.material", now.material, was.material)
        found += _changes(f"object.{i}.transform", now.transform, was.transform)
    if _same_kinds(setup, base):
        lights = zip(setup.scene.lights, base.scene.lights, strict=True)
        for i, (light, was_light) in enumerate(lights):
            found += _changes(f"light.{i}", light, was_light)
    return found


def _lights(setup: Setup, base: Setup) -> list[str]:
    """Every light anew, where their number or their types differ."""
    if _same_kinds(setup, base):
        return []
    if not setup.scene.lights:
        raise PlaygroundError("the command line cannot remove every light", fix=SAVE)
    return [word for light in setup.scene.lights for word in ("--light", light_words(light))]


def light_words(light: Light) -> str:
    """``point position=1,2,3 ...``: the light as ``--light`` takes it."""
    plain = type(light)()
    said = (f"{name}={value}" for name, value in _values(light, plain))
    return " ".join([light.kind, *said])


def _same_kinds(a: Setup, b: Setup) -> bool:
    return [light.kind for light in a.scene.lights] == [light.kind for light in b.scene.lights]


def _changes(where: str, now: Any, was: Any) -> list[str]:
    return [f"{where}.{name}={value}" for name, value in _values(now, was)]


def _values(now: Any, was: Any) -> Iterator[tuple[str, str]]:
    """The knobs in which two values of one kind differ, as text."""
    for name, knob in knobs(type(now)).items():
        if getattr(now, name) != getattr(was, name):
            yield name, written(knob, getattr(now, name))


def written(knob: Knob, value: Any) -> str:
    """A value as ``--set`` reads it back, to the last bit."""
    if knob.kind == "switch":
        return "on" if value else "off"
    if knob.kind == "names":
        return ",".join(value)
    if knob.kind in ("colour", "vector"):
        return ",".join(_number(v) for v in value)
    if knob.kind == "vertices":
        return "/".join(",".join(_number(v) for v in point) for point in value)
    return _number(value) if knob.kind in ("number", "integer") else str(value)


def _number(value: float) -> str:
    return repr(value).removesuffix(".0")
