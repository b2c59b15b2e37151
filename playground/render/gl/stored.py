"""Pictures of stored light on the GPU: as fast as drawing a texture."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from numpy.typing import NDArray

from playground.render.gl.renderer import GLRenderer
from playground.render.image import Image
from playground.render.stored_renderer import LightSource, StoredDrawing
from playground.scene.setup import Setup

if TYPE_CHECKING:
    import moderngl


class GLStored(StoredDrawing, GLRenderer):
    """Draws stored light; the light is asked for anew when the scene or the settings change."""

    def __init__(
        self, size: tuple[int, int], light: LightSource, context: moderngl.Context | None = None
    ) -> None:
        super().__init__(size, context)
        self.light = light

    def render(self, setup: Setup, out: NDArray[Any] | None = None) -> Image | NDArray[Any]:
        """Draw ``setup``; see `playground.render.renderer.Renderer.render`."""
        return self._told(super().render(setup, out))

    def ask_again(self) -> None:
        """The light has become another one while scene and settings stay: ask for it anew."""
        self._drawn = (None, None)

    def close(self) -> None:
        """Free the GPU memory, and what the light holds."""
        super().close()
        self.light.close()
