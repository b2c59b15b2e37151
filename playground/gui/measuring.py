"""All measuring that goes on beside the drawing of the window."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from playground.gui.scope_run import ScopeRun
from playground.gui.speed_run import SpeedRun

if TYPE_CHECKING:
    from playground.gui.state import State


class Measuring:
    """The popping scope and the speed log; `advance` is called once a frame."""

    def __init__(self, context: Any) -> None:
        self._scope, self._speed = ScopeRun(context), SpeedRun(context)

    def advance(self, state: State, gpu_ms: float, wall_ms: float) -> State:
        """The state with what this frame has added.

        ``gpu_ms`` and ``wall_ms`` are the times of the window's own frames.
        """
        scope = self._scope.advance(state.scope)
        speed = self._speed.advance(state.speed)
        if (speed.gpu_ms, speed.wall_ms) != (gpu_ms, wall_ms):
            speed = replace(speed, gpu_ms=gpu_ms, wall_ms=wall_ms)
        if scope is state.scope and speed is state.speed:
            return state
        return replace(state, scope=scope, speed=speed)

    def close(self) -> None:
        """Stop everything and free the GPU memory."""
        self._scope.close()
        self._speed.close()


def under_way(state: State) -> bool:
    """Whether the next frame must come without an event: something is measured or moves."""
    return state.scope.running or state.scope.playing or state.speed.of is not None
