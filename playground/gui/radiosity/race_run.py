"""The race of the solvers, beside the window."""

from __future__ import annotations

from dataclasses import dataclass, replace

from playground.errors import PlaygroundError
from playground.gui.radiosity.race_log import RaceLog
from playground.gui.work.long_work import Piece, Pieces
from playground.gui.work.process_work import ProcessWork
from playground.measure.solver_race import News, racing
from playground.scene.setup import Setup


@dataclass(frozen=True)
class RaceJob:
    """What the other process is asked for."""

    setup: Setup
    solvers: tuple[str, ...]
    goal: float

    def pieces(self) -> Pieces[News]:
        """The race, news by news."""
        for news in racing(self.setup, self.solvers, self.goal):
            yield Piece(news.share, news)


class RaceRun:
    """Runs the race that a `RaceLog` asks for; `advance` is called once a frame."""

    def __init__(self) -> None:
        self._of: Setup | None = None
        self._work: ProcessWork[News] | None = None

    def advance(self, log: RaceLog) -> RaceLog:
        """The log with what has come in since the last frame."""
        if not log.running or log.of is None:
            self.close()
            return log
        if self._work is None or log.of is not self._of:
            self.close()
            solvers = tuple(lane.solver for lane in log.lanes)
            self._of, self._work = log.of, ProcessWork(RaceJob(log.of, solvers, float(log.goal)))
        try:
            told = self._work.take()
        except PlaygroundError as error:
            self.close()
            return replace(log, running=False, error=str(error))
        for news in told:
            log = log.with_news(news)
        return replace(log, progress=self._work.progress, running=not self._work.done)

    def close(self) -> None:
        """Let go of the process."""
        if self._work is not None:
            self._work.close()
        self._of = self._work = None
