"""The measuring of the popping scope: some steps of the orbit in every frame.

The two modes of the GPU are drawn in the window's context, for a few milliseconds of
every frame; the float64 reference is computed on a thread.
"""

from __future__ import annotations

from collections.abc import Generator, Mapping
from dataclasses import replace
from typing import Any

from playground.gui.measure.scope_path import ANGLES, DRAWN, EXACT, Scope
from playground.gui.work.long_work import LongWork, counted, together
from playground.gui.work.two_works import TwoWorks
from playground.measure.popping import Step, along, scope
from playground.render.gl.program import ShaderError
from playground.render.gl.renderer import GLRenderer
from playground.scene.setup import Setup

SIZE = (160, 120)


class ScopeRun(TwoWorks[Step, Step]):
    """Measures what a `Scope` asks for; `advance` is called once a frame."""

    def advance(self, asked: Scope) -> Scope:
        """The scope with what this frame has added."""
        if not asked.running or asked.of is None:
            self.stop()
            return asked
        if asked.of is not self._of:
            self.stop()
            self._start(asked.of, dict(asked.shaders))
        assert self._drawn is not None and self._exact is not None
        try:
            drawn, exact = self._drawn.take(), self._exact.take()
        except Exception as error:  # a mesh that is gone, a shader that does not compile
            self.stop()
            return replace(asked, running=False, error=str(error))
        progress = together(self._drawn.progress, self._exact.progress)
        running = not (self._drawn.done and self._exact.done)
        if not running:
            self.stop()
        drawn, exact = asked.drawn + drawn, asked.exact + exact
        return replace(
            asked, drawn=drawn, exact=exact, progress=progress, running=running, error=""
        )

    def _start(self, setup: Setup, shaders: Mapping[str, str]) -> None:
        self._of, count = setup, len(ANGLES)
        exact = scope(setup.with_(bugs=()), ANGLES, EXACT, SIZE, "numpy")
        self._drawn = LongWork(counted(drawn(setup, shaders, self._context), count))
        self._exact = LongWork(counted(exact, count), aside=True)


def drawn(setup: Setup, shaders: Mapping[str, str], context: Any) -> Generator[Step]:
    """The modes of the GPU, with ``shaders`` in place of shader files.

    Raises
    ------
    ShaderError
        What stands in the way of drawing with them.
    """
    with GLRenderer(SIZE, context) as renderer:
        renderer.overrides = shaders
        for step in along(setup, ANGLES, dict.fromkeys(DRAWN, renderer)):
            if renderer.shader_error:
                raise ShaderError(renderer.shader_error)
            yield step
