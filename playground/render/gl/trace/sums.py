"""What rays are traced into: colours and what was left out, of one sample or summed over many."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from playground.errors import PlaygroundError
from playground.render.gl.context import rest

if TYPE_CHECKING:
    import moderngl


class Sums:
    """Two pictures on the GPU: colour with coverage, and the weights of rays not shot.

    ``dtype`` is ``"f1"`` for 8-bit codes, of which only one sample can be taken, or ``"f4"``.
    Row 0 is on top, as in all targets. Weights that are the same in red, green and blue are kept
    once, and none where nobody asks (`keep_lost`): writing four of them takes a tenth of the time
    of a picture on llvmpipe, one of them a twentieth.
    """

    def __init__(self, context: moderngl.Context, size: tuple[int, int], dtype: str) -> None:
        largest = int(context.info["GL_MAX_TEXTURE_SIZE"])
        if max(size) > largest:
            raise _too_large(size, f"up to {largest} pixels a side")
        self._context, self.size, self.dtype = context, size, dtype
        self.rows: tuple[int, int] | None = None  # from and up to which is drawn; None for all
        try:
            self.colour = context.texture(size, 4, dtype=dtype)
            self._lose_into(4)
        except Exception as error:  # moderngl has one kind for all
            raise _too_large(size, "what fits into the memory of the driver") from error

    def _lose_into(self, numbers: int) -> None:
        both = [self.colour]
        self.lost: moderngl.Texture | None = None
        if numbers:
            self.lost = self._context.texture(self.size, numbers, dtype="f4")
            both.append(self.lost)
        self._framebuffer = self._context.framebuffer(both)

    def keep_lost(self, numbers: int) -> None:
        """Make room for weights of 0, 1 or 4 numbers; what was kept in other room is gone."""
        if (self.lost.components if self.lost else 0) != numbers:
            rest(self._context)
            self._framebuffer.release()
            if self.lost:
                self.lost.release()
            self._lose_into(numbers)

    def begin(self) -> None:
        """Forget earlier samples, of ``rows`` only if some are given."""
        self.use()
        self._framebuffer.clear()

    def use(self) -> None:
        """Draw into both pictures from now on."""
        scissor = None
        if self.rows is not None:
            scissor = (0, self.rows[0], self.size[0], self.rows[1] - self.rows[0])
        self._framebuffer.scissor = scissor  # type: ignore[assignment]
        self._framebuffer.use()

    def read(self, out: NDArray[np.generic]) -> None:
        """Copy the colours into ``out``, shape (H, W, 4)."""
        self._framebuffer.read_into(out, components=4, alignment=1, dtype=self.dtype)

    def read_lost(self) -> NDArray[np.float32]:
        """The weights of the rays that were not shot, (H, W, 3); they must have been kept."""
        assert self.lost is not None
        numbers = self.lost.components
        out = np.empty((self.size[1], self.size[0], numbers), dtype=np.float32)
        self._framebuffer.read_into(out, components=numbers, attachment=1, alignment=1, dtype="f4")
        return np.ascontiguousarray(np.broadcast_to(out[..., :3], (*out.shape[:2], 3)))

    def release(self) -> None:
        """Free the GPU memory."""
        rest(self._context)
        self._framebuffer.release()
        self.colour.release()
        if self.lost:
            self.lost.release()


def _too_large(size: tuple[int, int], allowed: str) -> PlaygroundError:
    return PlaygroundError(
        "the picture is too large for this driver",
        got=f"{size[0]}x{size[1]}",
        allowed=allowed,
        fix="Choose a smaller --size, or --renderer numpy.",
    )
