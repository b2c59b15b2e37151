"""Speed and error as a value: one dot for every mode and tessellation that was tried."""

from __future__ import annotations

import csv
import io
from dataclasses import astuple, dataclass, fields, replace
from typing import TYPE_CHECKING

from playground.gui.guess import played
from playground.gui.measure.scope_path import Texts, shaders
from playground.gui.work.long_work import Progress
from playground.scene.knob import Declared, switch
from playground.scene.scene import Object
from playground.scene.setup import Setup
from playground.scene.shapes import SHAPES

if TYPE_CHECKING:
    from playground.gui.state import State


EDITED = " (edited)"  # behind the name of a setup that was drawn with other shaders


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
    shaders: Texts = ()  # with these texts in place of shader files
    edited: Texts = ()  # the texts that the dots called edited were measured with
    progress: Progress = Progress()
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
    """Measure the setup as it is, with the shaders as they are; dots of other edits go."""
    of = replace(played(state, state.setup))  # a new object, noticed by identity
    log, texts = state.speed, shaders(state)
    if texts and texts != log.edited:
        kept = tuple(dot for dot in log.dots if not dot.setup.endswith(EDITED))
        log = replace(log, dots=kept, edited=texts)
    log = replace(log, of=of, shaders=texts, progress=Progress(), error="")
    return replace(state, speed=log)


def cancelled(state: State) -> State:
    """Stop measuring, and measure no more by itself."""
    return replace(state, speed=replace(state.speed, of=None, automatic=False))


def untried(state: State) -> bool:
    """Whether this mode and tessellation of this setup have no dot yet, with these shaders."""
    if state.shader_error:  # what is seen is not what would be measured
        return False
    return present(state) is None


def present(state: State) -> Dot | None:
    """The dot of what is shown now."""
    texts = shaders(state)
    if texts and texts != state.speed.edited:
        return None
    key = key_of(state.setup, texts)
    return next((dot for dot in state.speed.dots if dot.key == key), None)


def key_of(setup: Setup, texts: Texts = ()) -> tuple[str, str, int, int]:
    """What a dot of ``setup`` is a measurement of, with ``texts`` in place of shader files."""
    objects = setup.scene.objects
    triangles = sum(len(item.geometry().mesh.faces) for item in objects)
    name = setup.name + (EDITED if texts else "")
    return name, setup.settings.shading, _tessellation(objects), triangles


def _tessellation(objects: tuple[Object, ...]) -> int:
    if not objects or objects[0].mesh not in SHAPES or objects[0].arrays is not None:
        return 0
    return objects[0].tessellation or SHAPES[objects[0].mesh].default_tessellation
