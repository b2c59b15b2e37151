"""All measuring that goes on beside the drawing of the window."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from playground.gui.guess import masked
from playground.gui.measure.needs_run import NeedsRun
from playground.gui.measure.scope_run import ScopeRun
from playground.gui.measure.speed_run import SpeedRun
from playground.gui.picture.mark_count import MarkCount
from playground.gui.radiosity.race_run import RaceRun

if TYPE_CHECKING:
    from playground.gui.state import State


class Measuring:
    """Popping scope, speed log, advisor, marked pixels, race; `advance` is called once a frame."""

    def __init__(self, context: Any) -> None:
        self._scope, self._speed = ScopeRun(context), SpeedRun(context)
        self._needs, self._marks = NeedsRun(context), MarkCount(context)
        self._race = RaceRun()

    def advance(self, state: State, gpu_ms: float, wall_ms: float) -> State:
        """The state with what this frame has added.

        ``gpu_ms`` and ``wall_ms`` are the times of the window's own frames.
        """
        asked = state.speed
        if asked.of is not None and state.shader_error:
            asked = replace(asked, of=None, error="the edited shaders cannot be drawn with")
        scope, speed = self._scope.advance(state.scope), self._speed.advance(asked)
        if scope.error != state.scope.error:
            scope = replace(scope, error=masked(state, scope.error))
        if (speed.gpu_ms, speed.wall_ms) != (gpu_ms, wall_ms):
            speed = replace(speed, gpu_ms=gpu_ms, wall_ms=wall_ms)
        needs, marks = self._needs.advance(state.needs), self._marks.advance(state.mark_log)
        race = self._race.advance(state.race)
        same = scope is state.scope and speed is state.speed and needs is state.needs
        if same and marks is state.mark_log and race is state.race:
            return state
        return replace(state, scope=scope, speed=speed, needs=needs, mark_log=marks, race=race)

    def close(self) -> None:
        """Stop everything and free the GPU memory."""
        self._scope.close()
        self._speed.close()
        self._needs.close()
        self._marks.close()
        self._race.close()


def under_way(state: State) -> bool:
    """Whether the next frame must come without an event: something is measured or moves."""
    measured = state.scope.running or state.speed.of is not None or state.needs.running
    beside = state.race.running or state.bake.running
    return measured or beside or state.scope.playing
