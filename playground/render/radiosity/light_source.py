"""Radiosity as a source of stored light: solved once, drawn from everywhere."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from playground.render.radiosity.depends import Depends, depends
from playground.render.radiosity.not_modelled import not_modelled
from playground.render.radiosity.result import Radiosity
from playground.render.stored import StoredLight
from playground.scene.settings import Shading
from playground.scene.setup import Setup

if TYPE_CHECKING:
    import moderngl


class RadiosityLight:
    """Holds the solution of the last setup; ``result`` is None before the first."""

    def __init__(self, renderer: str = "auto", context: moderngl.Context | None = None) -> None:
        self.result: Radiosity | None = None
        self.warnings: tuple[str, ...] = ()
        self._renderer, self._context = renderer, context
        self._depends: Depends | None = None

    def prepare(self, setup: Setup) -> Iterator[float]:
        """Solve ``setup`` unless that is done; yields the share done. Continues if dropped."""
        wanted = depends(setup)
        if self.result is None or wanted != self._depends:
            self.result = Radiosity(setup, self._renderer, self._context, self.result)
            self._depends = wanted
        yield from self.result.solving()

    def stored(self, setup: Setup) -> tuple[StoredLight | None, ...]:
        """The light arriving at the patches: smooth, or one for each if the shading is flat."""
        assert self.result is not None
        settings = setup.settings
        self.warnings = (*not_modelled(setup), *self.result.patches.warnings)
        return self.result.stored(settings.shading == Shading.FLAT, settings.light_shown)

    def note(self) -> str:
        """Patches, solver, row sums: a line."""
        return self.result.brief() if self.result is not None else ""

    def close(self) -> None:
        """Free what the solution holds on the GPU."""
        if self.result is not None:
            self.result.close()
