"""A tunable quantity, declared once: default, range, unit, scale, help, lecture symbol.

A dataclass field made by `number`, `integer`, `switch`, `choice`, `colour` or
`vector` carries its `Knob`. Validation, the file format, the command line's
``--set`` and the sliders of the window all read it from there; nothing about the
quantity is written a second time.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from typing import Any

from playground.errors import PlaygroundError, shown, unknown_name

UNBOUNDED = 1e30  # beyond this a float32 square overflows; no knob reaches further


@dataclasses.dataclass(frozen=True)
class Knob:
    """The declaration of one quantity.

    ``kind`` is ``number``, ``integer``, ``switch``, ``choice``, ``colour``,
    ``vector``, ``vertices`` (points, as many as ``count`` allows), ``text`` or ``names`` (a
    subset of ``choices``). ``low`` and ``high`` are inclusive and in ``unit``; for a colour,
    vector or point they bound each component. ``scale`` is how a slider moves: ``linear`` or
    ``log``.
    """

    kind: str
    default: Any
    low: float = -UNBOUNDED
    high: float = UNBOUNDED
    unit: str = ""
    scale: str = "linear"
    help: str = ""
    symbol: str = ""
    choices: tuple[str, ...] = ()
    count: tuple[int, int] = (0, 0)

    @property
    def allowed(self) -> str:
        """The range in words, for messages and documentation."""
        if self.kind == "switch":
            return "true or false"
        if self.kind == "choice":
            return ", ".join(self.choices)
        if self.kind == "names":
            return "a list of " + ", ".join(self.choices)
        if self.kind == "text":
            return "text without null characters"
        if self.kind == "vertices":
            return f"{self.count[0]} to {self.count[1]} points of three numbers each"
        what = {"integer": "a whole number", "number": "a number"}.get(self.kind, "three numbers")
        unit = f" {self.unit}" if self.unit else ""
        if self.low <= -UNBOUNDED and self.high >= UNBOUNDED:
            return f"{what}, finite{unit and ', in' + unit}"
        return f"{what} from {self.low:g} to {self.high:g}{unit}"

    def check(self, value: Any, where: str) -> Any:
        """Return ``value`` in its canonical type, or raise a `PlaygroundError` naming ``where``."""
        checker = _CHECKERS[self.kind]
        return checker(self, value, where)

    def _refuse(self, value: Any, where: str) -> PlaygroundError:
        symbol = f" ({self.symbol})" if self.symbol else ""
        return PlaygroundError(
            f"{where}{symbol} is not valid", got=shown(value), allowed=self.allowed
        )


def _check_number(knob: Knob, value: Any, where: str) -> float:
    plain = value.item() if getattr(value, "size", 0) == 1 else value  # a NumPy number
    if isinstance(plain, bool) or not isinstance(plain, (int, float)):
        raise knob._refuse(value, where)
    try:
        number = float(plain)
    except OverflowError:
        raise knob._refuse(value, where) from None
    if not (math.isfinite(number) and knob.low <= number <= knob.high):
        raise knob._refuse(value, where)
    return number


def _check_integer(knob: Knob, value: Any, where: str) -> int:
    number = _check_number(knob, value, where)
    if number != int(number):
        raise knob._refuse(value, where)
    return int(number)


def _check_switch(knob: Knob, value: Any, where: str) -> bool:
    if not isinstance(value, bool):
        raise knob._refuse(value, where)
    return value


def _check_choice(knob: Knob, value: Any, where: str) -> str:
    value = getattr(value, "value", value)
    if not isinstance(value, str):
        raise knob._refuse(value, where)
    if value not in knob.choices:
        raise unknown_name(where, value, knob.choices)
    return str(value)


def _check_names(knob: Knob, value: Any, where: str) -> tuple[str, ...]:
    if isinstance(value, str):
        value = [part.strip() for part in value.split(",") if part.strip()]
    if not isinstance(value, (list, tuple, set, frozenset)):
        raise knob._refuse(value, where)
    for name in value:
        if not isinstance(name, str) or name not in knob.choices:
            raise unknown_name(where, name, knob.choices)
    return tuple(name for name in knob.choices if name in value)


def _check_triple(knob: Knob, value: Any, where: str) -> tuple[float, float, float]:
    if hasattr(value, "tolist"):
        value = value.tolist()
    if not isinstance(value, (list, tuple)) or len(value) != 3:
        raise knob._refuse(value, where)
    x, y, z = value
    return (
        _check_number(knob, x, where),
        _check_number(knob, y, where),
        _check_number(knob, z, where),
    )


def _check_vertices(knob: Knob, value: Any, where: str) -> tuple[tuple[float, float, float], ...]:
    if hasattr(value, "tolist"):
        value = value.tolist()
    fewest, most = knob.count
    if not isinstance(value, (list, tuple)) or not fewest <= len(value) <= most:
        raise knob._refuse(value, where)
    return tuple(_check_triple(knob, point, where) for point in value)


def _check_text(knob: Knob, value: Any, where: str) -> str:
    if not isinstance(value, str) or "\0" in value:
        raise knob._refuse(value, where)
    return value


_CHECKERS = {
    "number": _check_number,
    "integer": _check_integer,
    "switch": _check_switch,
    "choice": _check_choice,
    "names": _check_names,
    "colour": _check_triple,
    "vector": _check_triple,
    "vertices": _check_vertices,
    "text": _check_text,
}


def _field(knob: Knob) -> Any:
    return dataclasses.field(default=knob.default, metadata={"knob": knob})


def number(default: float, low: float = -UNBOUNDED, high: float = UNBOUNDED, **more: Any) -> Any:
    """Declare a real number; ``more`` gives unit, scale, help and symbol."""
    return _field(Knob("number", float(default), low, high, **more))


def integer(default: int, low: int, high: int, **more: Any) -> Any:
    """Declare a whole number."""
    return _field(Knob("integer", default, low, high, **more))


def switch(default: bool, **more: Any) -> Any:
    """Declare something that is on or off."""
    return _field(Knob("switch", default, **more))


def choice(default: str, choices: Sequence[str], **more: Any) -> Any:
    """Declare one of several names."""
    return _field(Knob("choice", default, choices=tuple(choices), **more))


def names(default: Sequence[str], choices: Sequence[str], **more: Any) -> Any:
    """Declare a subset of several names."""
    return _field(Knob("names", tuple(default), choices=tuple(choices), **more))


def colour(red: float, green: float, blue: float, **more: Any) -> Any:
    """Declare a linear RGB colour; components may exceed 1, never fall below 0."""
    return _field(Knob("colour", (float(red), float(green), float(blue)), 0.0, 1e6, **more))


def vector(x: float, y: float, z: float, **more: Any) -> Any:
    """Declare a point or direction."""
    return _field(Knob("vector", (float(x), float(y), float(z)), **more))


def vertices(points: Sequence[Sequence[float]], fewest: int, most: int, **more: Any) -> Any:
    """Declare the corners of an outline."""
    default = tuple(tuple(float(x) for x in point) for point in points)
    return _field(Knob("vertices", default, count=(fewest, most), **more))


def text(default: str = "", **more: Any) -> Any:
    """Declare free text."""
    return _field(Knob("text", default, **more))


_KNOBS: dict[type, dict[str, Knob]] = {}


def knobs(declared: type) -> dict[str, Knob]:
    """All knobs of a dataclass, by field name, in the order of declaration."""
    if declared not in _KNOBS:
        fields = dataclasses.fields(declared)
        _KNOBS[declared] = {f.name: f.metadata["knob"] for f in fields if "knob" in f.metadata}
    return _KNOBS[declared]


class Declared:
    """Base of every value of a scene: each knob is checked when the value is made."""

    label = "value"

    def __post_init__(self) -> None:
        for name, knob in knobs(type(self)).items():
            value = getattr(self, name)
            checked = knob.check(value, f"{self.label}.{name}")
            if checked is not value:
                object.__setattr__(self, name, checked)
