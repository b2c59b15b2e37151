"""What is drawn into, and read back from: 8-bit codes or linear floats, row 0 on top."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from numpy.typing import NDArray

from playground.errors import PlaygroundError
from playground.render.gl.context import rest

if TYPE_CHECKING:
    import moderngl


class Target:
    """A colour and a depth buffer of one size, multisampled if ``samples`` > 1.

    ``dtype`` is ``"f1"`` (RGBA, 8-bit codes) or ``"f4"`` (RGBA, linear; A is the share
    of the pixel that some surface covers). Pictures are drawn upside down, so that the
    rows arrive in the order in which images store them.
    """

    def __init__(
        self, context: moderngl.Context, size: tuple[int, int], dtype: str, samples: int = 1
    ) -> None:
        largest = int(context.info["GL_MAX_RENDERBUFFER_SIZE"])
        if max(size) > largest:
            raise _too_large(size, f"up to {largest} pixels a side")
        self._context = context
        self.size, self.dtype = size, dtype
        self.samples = min(samples, context.max_samples) if samples > 1 else 1
        try:
            self._resolved = self._framebuffer(context, 0)
            self._drawn = (
                self._framebuffer(context, self.samples) if self.samples > 1 else self._resolved
            )
        except Exception as error:  # moderngl has one kind for all
            raise _too_large(size, "what fits into the memory of the driver") from error

    def _framebuffer(self, context: moderngl.Context, samples: int) -> moderngl.Framebuffer:
        colour = context.renderbuffer(self.size, 4, samples=samples, dtype=self.dtype)
        depth = context.depth_renderbuffer(self.size, samples=samples)
        return context.framebuffer([colour], depth)

    def begin(self, background: tuple[float, float, float]) -> None:
        """Bind and clear."""
        self._drawn.use()
        alpha = 1.0 if self.dtype == "f1" else 0.0
        self._drawn.clear(*background, alpha)

    def read(self, out: NDArray[Any]) -> None:
        """Resolve the samples and copy the picture into ``out``, shape (H, W, 4)."""
        if self._drawn is not self._resolved:
            self._context.copy_framebuffer(self._resolved, self._drawn)
        self._resolved.read_into(out, components=4, alignment=1, dtype=self.dtype)

    def release(self) -> None:
        """Free the GPU memory."""
        rest(self._context)
        for framebuffer in {id(f): f for f in (self._drawn, self._resolved)}.values():
            for attachment in (*framebuffer.color_attachments, framebuffer.depth_attachment):
                attachment.release()
            framebuffer.release()


def _too_large(size: tuple[int, int], allowed: str) -> PlaygroundError:
    return PlaygroundError(
        "the picture is too large for this driver",
        got=f"{size[0]}x{size[1]}",
        allowed=allowed,
        fix="Choose a smaller --size, or --renderer numpy.",
    )
