"""The baking of a lightmap as a value: what is baked, how far it is, what came of it."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING

from playground.errors import PlaygroundError
from playground.gui.lightmap import lightmap_store
from playground.gui.work.long_work import Progress
from playground.render.lightmap.bake import SIZE
from playground.scene.knob import Declared, integer
from playground.scene.material import Material
from playground.scene.scene import Object
from playground.scene.setup import Setup

if TYPE_CHECKING:
    from playground.gui.state import State

RAYS = 64  # at first: somebody waits; the command line takes its time for more


@dataclass(frozen=True)
class BakeLog(Declared):
    """The last bake, and the knobs of the next one."""

    label = "bake"

    of: Setup | None = None  # what is being baked
    file: Path | None = None  # where it will be
    progress: Progress = field(default_factory=Progress)
    told: str = ""  # what is known of the last one
    error: str = ""
    size: int = integer(SIZE, 16, 4096, help="texels along an edge of the lightmap")
    rays: int = integer(
        RAYS, 0, 4096, help="gathered at each texel for indirect light; 0: as coarse as patches"
    )

    @property
    def running(self) -> bool:
        """Whether a lightmap is being baked."""
        return self.of is not None


def asked(state: State) -> State:
    """Bake the setup as it is."""
    try:
        file = lightmap_store.new_file(state.setup)
    except PlaygroundError as error:
        return replace(state, bake=replace(state.bake, error=str(error)))
    of = replace(state.setup)  # a new object, noticed by identity
    log = replace(state.bake, of=of, file=file, progress=Progress(), error="")
    return replace(state, bake=log)


def cancelled(state: State) -> State:
    """Stop; the lightmap stays as it was."""
    return replace(state, bake=replace(state.bake, of=None)).say("nothing was baked")


def finished(state: State, told: str) -> State:
    """The setup uses the new lightmap, unless its geometry has become another meanwhile."""
    log = replace(state.bake, of=None, told=told)
    of, scene = state.bake.of, state.setup.scene
    if of is None or state.bake.file is None:
        return state
    if scene.objects != of.scene.objects and _moved(scene.objects, of.scene.objects):
        words = "the lightmap is thrown away: the objects have changed while it was baked"
        return replace(state, bake=replace(log, error=words))
    state = state.with_setup(state.setup.with_(lightmap=str(state.bake.file)))
    return replace(state, bake=log).say("the setup has a new lightmap")


def forgotten(state: State) -> State:
    """The setup without its lightmap; undo brings it back."""
    return state.with_setup(state.setup.with_(lightmap=""))


def _moved(now: tuple[Object, ...], then: tuple[Object, ...]) -> bool:
    """Whether meshes or places differ; materials do not count."""

    def places(items: tuple[Object, ...]) -> list[Object]:
        return [replace(item, material=Material()) for item in items]

    return places(now) != places(then)
