"""The advisor beside the window: a picture or two in every frame, in the window's context."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from playground.gui.measure.needs_log import NeedsLog
from playground.gui.work.long_work import LongWork, Piece, Pieces
from playground.measure.advice import Advice
from playground.measure.advisor import Progress, advising
from playground.scene.setup import Setup
from playground.steps import retold

SIZE = (320, 240)  # of the pictures: small enough that no frame waits for one


class NeedsRun:
    """Measures what a `NeedsLog` asks for; `advance` is called once a frame."""

    def __init__(self, context: Any) -> None:
        self._context = context
        self._of: Setup | None = None
        self._work: LongWork[Progress | Advice] | None = None

    def advance(self, log: NeedsLog) -> NeedsLog:
        """The log with what this frame has added."""
        if not log.running or log.of is None:
            self.stop()
            return log
        if self._work is None or log.of is not self._of:
            self.stop()
            self._of, self._work = log.of, LongWork(pieces(log, self._context))
        try:
            told = self._work.take()
        except Exception as error:  # a mesh that is gone, a texture too large
            self.stop()
            return replace(log, running=False, error=str(error))
        log = replace(log, progress=self._work.progress)
        for item in told[-1:]:
            if isinstance(item, Advice):
                return replace(log, running=False, findings=item.findings, advice=item)
            log = replace(log, doing=item.doing, findings=item.findings)
        return log

    def stop(self) -> None:
        """Let go of what was being measured, and of its GPU memory."""
        if self._work is not None:
            self._work.close()
        self._of = self._work = None

    def close(self) -> None:
        """Stop while the context is still there."""
        self.stop()


def pieces(log: NeedsLog, context: Any) -> Pieces[Progress | Advice]:
    """The advisor's steps; the last item is its advice."""
    assert log.of is not None
    # FLIP holds up the whole window: only for who asks for it.
    steps = advising(
        log.of, log.budget, log.metric, SIZE, "gl", context, flip=False, method=log.method
    )
    advice = yield from retold(steps, _piece)
    yield Piece(1.0, advice)


def _piece(told: Progress) -> Piece[Progress | Advice]:
    return Piece(told.share, told)
