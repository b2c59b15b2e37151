"""The reading of large files for the window: started, stopped and taken over once a frame."""

from __future__ import annotations

from dataclasses import replace

from playground.errors import PlaygroundError
from playground.gui import reading
from playground.gui.actions import open_setup
from playground.gui.state import State
from playground.gui.work.long_work import LongWork


class ReadingRun:
    """Reads what the state asks for; `advance` is called once a frame."""

    def __init__(self) -> None:
        self._meshes: tuple[str, ...] = ()
        self._work: LongWork[str] | None = None

    def advance(self, state: State) -> State:
        """The state with what is known by now; as soon as the meshes are there, with the setup."""
        wanted = state.reading
        if wanted is None:
            self.stop()
            return state
        if self._work is None or wanted.meshes is not self._meshes:
            self.stop()
            self._meshes = wanted.meshes
            self._work = LongWork(reading.pieces(wanted.meshes), aside=True)
        try:
            self._work.take()
        except PlaygroundError as error:
            self.stop()
            return replace(state, reading=None).fail(error)
        if not self._work.done:
            return replace(state, reading=replace(wanted, progress=self._work.progress))
        self.stop()
        return open_setup(replace(state, reading=None), wanted.name)

    def stop(self) -> None:
        """Let go of what was being read."""
        if self._work is not None:
            self._work.stop()
        self._work = None

    def close(self) -> None:
        """Stop, and wait until the process is gone."""
        work, self._work = self._work, None
        if work is not None:
            work.close()
