"""Bakes beside the window; as soon as the file is there, the setup uses it."""

from __future__ import annotations

from dataclasses import replace

from playground.errors import PlaygroundError
from playground.gui.lightmap import bake_log
from playground.gui.lightmap.bake_job import BakeJob
from playground.gui.state import State
from playground.gui.work.process_work import ProcessWork
from playground.scene.setup import Setup


class BakeRun:
    """Bakes what the state asks for; `advance` is called once a frame."""

    def __init__(self) -> None:
        self._of: Setup | None = None
        self._work: ProcessWork[str] | None = None

    def advance(self, state: State) -> State:
        """The state with what is known by now; at the end with a setup that uses the lightmap."""
        log = state.bake
        if log.of is None or log.file is None:
            self.close()
            return state
        if self._work is None or log.of is not self._of:
            self.close()
            job = BakeJob(log.of, log.file, log.size, log.rays)
            self._of, self._work = log.of, ProcessWork(job)
        try:
            told = self._work.take()
        except PlaygroundError as error:
            self.close()
            return replace(state, bake=replace(log, of=None, error=str(error)))
        if told:
            return bake_log.finished(state, told[-1])
        return replace(state, bake=replace(log, progress=self._work.progress))

    def close(self) -> None:
        """Let go of the process."""
        if self._work is not None:
            self._work.close()
        self._of = self._work = None
