"""Speed and error as a value: one dot for every mode and tessellation that was tried."""

from __future__ import annotations

import csv
import io
from dataclasses import astuple, dataclass, fields, replace
from typing import TYPE_CHECKING

from playground.gui.guess import played
from playground.scene.knob import Declared, switch
from playground.scene.scene import Object
from playground.scene.setup import Setup
from playground.scene.shapes import SHAPES

if TYPE_CHECKING:
    from playground.gui.state import State


@dataclass(frozen=True)
class Dot:
    """One measurement: what was drawn, how long a frame takes, how far it is off.

    Times are medians in milliseconds; ``rmse`` and ``largest`` are of linear light, against
    per-fragment shading in float64.
    """

    setup: str
    mode: str
    tessellation: int  # of the first object; 0 for a mesh from a file
    triangles: int
    gpu_ms: float | None  # None where a software driver has no clock for it
    wall_ms: float
    rmse: float
    largest: float

    @property
    def key(self) -> tuple[str, str, int, int]:
        """What it is a measurement of."""
        return self.setup, self.mode, self.tessellation, self.triangles

    @property
    def milliseconds(self) -> float:
        """Of a frame: by the GPU's clock if there is one."""
        return self.wall_ms if self.gpu_ms is None else self.gpu_ms

    @property
    def label(self) -> str:
        """The tessellation, or the number of triangles where a mesh has none."""
        return str(self.tessellation) if self.tessellation else f"{self.triangles:,} triangles"


@dataclass(frozen=True)
class SpeedLog(Declared):
    """The dots so far, and the setup that is being measured."""

    label = "speed"

    dots: tuple[Dot, ...] = ()
    of: Setup | None = None  # what is being measured
    error: str = ""
    gpu_ms: float = 0.0  # of the window's own frames
    wall_ms: float = 0.0
    automatic: bool = switch(True, help="measure every mode and tessellation as you try it")

    def with_dot(self, dot: Dot) -> SpeedLog:
        """The log with one more dot; an older one of the same thing goes."""
        others = tuple(old for old in self.dots if old.key != dot.key)
        return replace(self, dots=(*others, dot), of=None, error="")

    def to_csv(self) -> str:
        """A table with one row per dot."""
        text = io.StringIO()
        table = csv.writer(text, lineterminator="\n")
        table.writerow(field.name for field in fields(Dot))
        table.writerows(astuple(dot) for dot in self.dots)
        return text.getvalue()


def asked(state: State) -> State:
    """Measure the setup as it is."""
    of = replace(played(state, state.setup))  # a new object, noticed by identity
    return replace(state, speed=replace(state.speed, of=of, error=""))


def cancelled(state: State) -> State:
    """Stop measuring, and measure no more by itself."""
    return replace(state, speed=replace(state.speed, of=None, automatic=False))


def untried(state: State) -> bool:
    """Whether this mode and tessellation of this setup have no dot yet."""
    return key_of(state.setup) not in {dot.key for dot in state.speed.dots}


def key_of(setup: Setup) -> tuple[str, str, int, int]:
    """What a dot of ``setup`` is a measurement of."""
    objects = setup.scene.objects
    triangles = sum(len(item.geometry().mesh.faces) for item in objects)
    return setup.name, setup.settings.shading, _tessellation(objects), triangles


def _tessellation(objects: tuple[Object, ...]) -> int:
    if not objects or objects[0].mesh not in SHAPES or objects[0].arrays is not None:
        return 0
    return objects[0].tessellation or SHAPES[objects[0].mesh].default_tessellation
