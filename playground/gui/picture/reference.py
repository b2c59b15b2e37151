"""A picture by NumPy, drawn in the background: the float64 reference, or one by rays.

The window never waits for it: until a new picture is ready, the last one stands.
"""

from __future__ import annotations

from collections.abc import Callable
from time import perf_counter

import moderngl
import numpy as np
from numpy.typing import NDArray

from playground.errors import PlaygroundError
from playground.gui.picture import reference_pieces
from playground.gui.work.long_work import LongWork, Piece, Pieces, Progress
from playground.render.shown import shown_colour
from playground.scene.setup import Setup
from playground.shading.display import code8

Codes = NDArray[np.uint8]
CALM = 0.15  # seconds that a setup must stand still: nobody reads a picture while it moves


def coded(setup: Setup, size: tuple[int, int]) -> Pieces[Codes]:
    """The 8-bit codes (H, W, 4) of the reference picture, the only item."""
    for piece in reference_pieces.pieces(setup, size):
        if piece.item is None:
            yield Piece(piece.share)
            continue
        codes = np.full((*piece.item.shape[:2], 4), 255, dtype=np.uint8)
        codes[..., :3] = code8(shown_colour(piece.item, setup.settings))
        yield Piece(1.0, codes)


class ReferencePicture:
    """The reference picture of one place in the view, as a texture and as codes.

    Other ``codes`` make another picture in the same way.
    """

    def __init__(
        self,
        context: moderngl.Context,
        codes: Callable[[Setup, tuple[int, int]], Pieces[Codes]] = coded,
    ) -> None:
        self._context, self._made = context, codes
        self._texture: moderngl.Texture | None = None
        self._wanted: tuple[Setup, tuple[int, int]] | None = None
        self._since = 0.0
        self._work: LongWork[Codes] | None = None
        self._of: tuple[Setup, tuple[int, int]] | None = None  # what the work draws
        self._shown: tuple[Setup, tuple[int, int]] | None = None
        self._refused: tuple[Setup, tuple[int, int]] | None = None  # given up, or failed
        self.codes: Codes | None = None
        self.shows = 0  # how often there was another picture

    def texture(self, setup: Setup, size: tuple[int, int]) -> moderngl.Texture:
        """The texture of the last picture that is ready; grey where there is none yet.

        Raises
        ------
        PlaygroundError
            This setup cannot be drawn by the reference.
        """
        wanted = (setup, size)
        if self._wanted != wanted:
            self._wanted, self._since = wanted, perf_counter()
            if self._work is not None:
                self._work.stop()
        self._collect()
        calm = perf_counter() - self._since >= CALM or self._shown is None
        if self._work is None and self._shown != wanted and calm and self._refused != wanted:
            self._of = wanted
            self._work = LongWork(self._made(setup, size), aside=True)
        if self._texture is None:
            self._texture = self._context.texture((1, 1), 4, bytes((90, 90, 90, 255)))
        return self._texture

    @property
    def computing(self) -> bool:
        """Whether the picture that is wanted is not there yet."""
        return self._wanted is not None and self._wanted != self._shown

    @property
    def coming(self) -> bool:
        """Whether it will be there some time: it has not been given up."""
        return self.computing and self._wanted != self._refused

    @property
    def progress(self) -> Progress | None:
        """How far the picture is that is wanted; None where none is under way."""
        if self._work is None or self._of != self._wanted or not self.coming:
            return None
        return self._work.progress

    def give_up(self) -> None:
        """Do not compute the picture that is wanted; another one, yes."""
        if self._work is not None:
            self._work.stop()
        self._refused = self._wanted

    @property
    def stamp(self) -> tuple[Setup, tuple[int, int]] | None:
        """Setup and size of the picture that is there; None before the first."""
        return self._shown

    def rest(self) -> None:
        """Nobody looks at it: give up what is under way."""
        if self._work is not None:
            self._work.stop()
        self._work, self._wanted, self._refused = None, self._shown, None

    def _collect(self) -> None:
        """Take over the picture of a thread that has finished."""
        work, of = self._work, self._of
        if work is None or of is None:
            return
        try:
            found = work.take()
        except Exception as error:
            self._work, self._refused = None, of  # not again until something changes
            raise PlaygroundError(f"the picture by NumPy failed: {error}") from None
        if work.done:
            self._work = None
        if found and of == self._wanted and of != self._refused:
            self._show(of, found[-1])

    def _show(self, of: tuple[Setup, tuple[int, int]], codes: Codes) -> None:
        self._shown, self.codes = of, codes
        self.shows += 1
        size, data = of[1], codes.tobytes()
        if self._texture is None or self._texture.size != size:
            self.release()
            self._texture = self._context.texture(size, 4, data)
        else:
            self._texture.write(data)

    def release(self) -> None:
        """Free the GPU memory."""
        if self._texture is not None:
            self._texture.release()
            self._texture = None
