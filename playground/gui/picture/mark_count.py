"""How many pixels of the first picture carry each mark: the numbers beside the legend.

The window's pictures are 8-bit codes, in which a mark is a colour like any other. So the
picture is drawn once more in float32, when it has stood still for a moment.
"""

from __future__ import annotations

from dataclasses import replace
from time import perf_counter
from typing import TYPE_CHECKING, Any

from playground.errors import PlaygroundError
from playground.gui.picture.comparison import pictures
from playground.gui.picture.mark_log import MarkLog, Size, Texts
from playground.gui.shader.shader_edit import overrides
from playground.render.gl.program import ShaderError
from playground.render.gl.renderer import GLRenderer
from playground.render.image import Image
from playground.scene.settings import MARKS
from playground.scene.setup import Setup

if TYPE_CHECKING:
    from playground.gui.state import State

REST = 0.3  # seconds without a change, before the pixels are counted


def asked(state: State, view: Size) -> State:
    """The state that asks for the numbers of the first picture in a view of this size."""
    picture = pictures(state, *view)[0]
    wanted = (picture.setup, picture.box[2:], tuple(overrides(state).items()))
    if wanted == state.mark_log.wanted:
        return state
    return replace(state, mark_log=replace(state.mark_log, wanted=wanted))


class MarkCount:
    """Counts what a `MarkLog` asks for; `advance` is called once a frame."""

    def __init__(self, context: Any) -> None:
        self._context = context
        self._renderer: GLRenderer | None = None
        self._seen: object = None
        self._since = 0.0

    def advance(self, log: MarkLog) -> MarkLog:
        """The log with the numbers, if they have become due."""
        if log.wanted is None or log.wanted == log.counted:
            return log
        now = perf_counter()
        if log.wanted is not self._seen:
            self._seen, self._since = log.wanted, now
        if now < self._since + REST:
            return log
        return replace(log, counted=log.wanted, counts=self._counts(*log.wanted))

    def _counts(self, setup: Setup, size: Size, texts: Texts) -> tuple[int, ...]:
        """No numbers where the picture cannot be drawn."""
        if self._renderer is None:
            self._renderer = GLRenderer(size, self._context)
        self._renderer.size, self._renderer.overrides = size, dict(texts)
        try:
            image = self._renderer.render(setup)
        except (PlaygroundError, ShaderError):
            return ()
        assert isinstance(image, Image)
        found = image.marks()
        return tuple(found[kind] for kind in MARKS)

    def close(self) -> None:
        """Free the GPU memory."""
        if self._renderer is not None:
            self._renderer.close()
