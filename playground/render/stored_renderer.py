"""Pictures of stored light, whatever method computed it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any, Protocol

from numpy.typing import NDArray

from playground.errors import PlaygroundError
from playground.render.image import Image
from playground.render.numpy_renderer import NumpyRenderer
from playground.render.stored import (
    StoredLight,
    shown_background,
    shown_weights,
    stored_surfaces,
)
from playground.render.surface import Surface
from playground.scene.setup import Setup


class LightSource(Protocol):
    """Where stored light comes from. Keeps it until something changes that it depends on."""

    warnings: tuple[str, ...]  # what the last light leaves out

    def prepare(self, setup: Setup) -> Iterator[float]:
        """Compute what is stored for ``setup``; yields the share done, nothing if it is there."""
        ...

    def stored(self, setup: Setup) -> Sequence[StoredLight | None]:
        """The light of each object of the scene; None for one that is shrunk to nothing."""
        ...

    def note(self) -> str:
        """A line about the last light: how good it is."""
        ...

    def close(self) -> None:
        """Free what is held."""
        ...


class StoredDrawing:
    """What the renderers of stored light share, in NumPy and on the GPU."""

    light: LightSource

    def prepare(self, setup: Setup) -> Iterator[float]:
        """Compute the light before it is drawn; see `LightSource.prepare`."""
        return self.light.prepare(setup)

    def _surfaces_of(self, setup: Setup) -> tuple[Surface, ...]:
        if setup.settings.bugs:
            raise PlaygroundError(
                "stored light makes no mistakes",
                got=f"bugs = {', '.join(setup.settings.bugs)}",
                fix="Use --method raster, or --set bugs= for none.",
            )
        for _ in self.light.prepare(setup):
            pass
        weights = shown_weights(setup.settings)
        return stored_surfaces(setup.scene, weights, self.light.stored(setup))

    def _background_of(self, setup: Setup) -> tuple[float, float, float]:
        return shown_background(setup)

    def _told(self, image: Image | NDArray[Any]) -> Image | NDArray[Any]:
        """The picture, if it is one that can say so, with what is known of its light."""
        if not isinstance(image, Image):
            return image
        notes = {**image.notes, "light": self.light.note()}
        return replace(image, warnings=self.light.warnings, notes=notes)


class NumpyStored(StoredDrawing, NumpyRenderer):
    """Draws stored light in float64, or the precision of the setup."""

    def __init__(self, size: tuple[int, int], light: LightSource) -> None:
        super().__init__(size)
        self.light = light

    def render(self, setup: Setup, out: NDArray[Any] | None = None) -> Image | NDArray[Any]:
        """Draw ``setup``; see `playground.render.renderer.Renderer.render`."""
        return self._told(super().render(setup, out))

    def close(self) -> None:
        """Free what the light holds."""
        self.light.close()
