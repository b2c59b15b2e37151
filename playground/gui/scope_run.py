"""The measuring of the popping scope: some steps of the orbit in every frame.

The two modes of the GPU are drawn in the window's context, for a few milliseconds of
every frame; the float64 reference is computed on a thread.
"""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import replace
from time import perf_counter
from typing import Any

from playground.gui.aside import Aside
from playground.gui.scope_path import ANGLES, DRAWN, EXACT, Scope
from playground.measure.popping import Step, scope
from playground.scene.setup import Setup

BUDGET = 0.008  # seconds of every frame; at least one step is made
SIZE = (160, 120)


class ScopeRun:
    """Measures what a `Scope` asks for; `advance` is called once a frame."""

    def __init__(self, context: Any) -> None:
        self._context = context
        self._of: Setup | None = None
        self._drawn: Generator[Step] | None = None
        self._exact: Aside[Step] | None = None
        self._began = 0.0

    def advance(self, asked: Scope) -> Scope:
        """The scope with what this frame has added."""
        if not asked.running or asked.of is None:
            self.stop()
            return asked
        if asked.of is not self._of:
            self.stop()
            self._start(asked.of)
        assert self._exact is not None
        try:
            drawn = asked.drawn + self._steps()
            if self._exact.error is not None:
                raise self._exact.error
        except Exception as error:  # a mesh that is gone, a shader that does not compile
            self.stop()
            return replace(asked, running=False, error=str(error))
        exact = asked.exact + self._exact.take()
        after = replace(asked, drawn=drawn, exact=exact, error="")
        if len(drawn) == len(exact) == len(ANGLES):
            self.stop()
            return replace(after, running=False, left=0.0)
        took = perf_counter() - self._began
        slowest = min(len(drawn), len(exact)) / len(ANGLES)
        return replace(after, left=took * (1.0 - slowest) / slowest if slowest else 0.0)

    def _start(self, setup: Setup) -> None:
        self._of, self._began = setup, perf_counter()
        self._drawn = scope(setup, ANGLES, DRAWN, SIZE, "gl", self._context)
        self._exact = Aside(scope(setup.with_(bugs=()), ANGLES, EXACT, SIZE, "numpy"))

    def _steps(self) -> tuple[Step, ...]:
        until, found = perf_counter() + BUDGET, []
        while self._drawn is not None:
            step = next(self._drawn, None)
            if step is None:
                self._drawn = None
                break
            found.append(step)
            if perf_counter() > until:
                break
        return tuple(found)

    def stop(self) -> None:
        """Let go of what was being measured."""
        if self._drawn is not None:
            self._drawn.close()
        if self._exact is not None:
            self._exact.stop()
        self._of = self._drawn = self._exact = None

    def close(self) -> None:
        """Stop and free the GPU memory, while the context is still there."""
        exact = self._exact
        self.stop()
        if exact is not None:
            exact.close()
