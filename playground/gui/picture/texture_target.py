"""A target whose picture stays on the GPU as a texture, for the window to show."""

from __future__ import annotations

from typing import TYPE_CHECKING

from playground.render.gl.target import Target

if TYPE_CHECKING:
    import moderngl


class TextureTarget(Target):
    """8-bit codes in a texture; row 0 of the picture is row 0 of the texture."""

    def __init__(self, context: moderngl.Context, size: tuple[int, int], samples: int) -> None:
        super().__init__(context, size, "f1", samples)

    def _framebuffer(self, context: moderngl.Context, samples: int) -> moderngl.Framebuffer:
        if samples:
            return super()._framebuffer(context, samples)
        self.texture = context.texture(self.size, 4)
        depth = context.depth_renderbuffer(self.size)
        return context.framebuffer([self.texture], depth)

    def resolve(self) -> None:
        """Bring the samples together in the texture."""
        if self._drawn is not self._resolved:
            self._context.copy_framebuffer(self._resolved, self._drawn)

    def lay(self, picture: moderngl.Texture) -> None:
        """Put another picture of this size in the place of what is drawn, over its depth."""
        other = self._context.framebuffer([picture])
        self._context.copy_framebuffer(self._drawn, other)
        other.release()
        self._drawn.use()
