"""The explanation of a pixel of stored light, by the light with which the view draws it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from playground.explain.stored_pixel import StoredPixel, explain_stored
from playground.gui.picture.comparison import Picture
from playground.gui.pixel.explained import Explainer, pixel_at
from playground.gui.radiosity.radiosity_run import RadiosityRun
from playground.gui.radiosity.solving import Solving
from playground.gui.radiosity.stored_slots import StoredSlots
from playground.gui.state import RADIOSITY, State
from playground.render.lightmap.light_source import LightmapLight
from playground.render.radiosity.light_source import RadiosityLight
from playground.render.stored import StoredLight
from playground.render.stored_renderer import LightSource
from playground.scene.setup import Setup


class DrawnLight(RadiosityLight):
    """The radiosity of the view, as far as it is solved: nothing more is solved for it."""

    def __init__(self, run: RadiosityRun, solving: Solving) -> None:
        super().__init__()
        self.result, self._run, self._solving = run.drawn, run, solving

    def prepare(self, setup: Setup) -> Iterator[float]:
        """Nothing: the window goes on solving by itself."""
        return iter(())

    def stored(self, setup: Setup) -> tuple[StoredLight | None, ...]:
        """The light that the view draws, or a part of it."""
        return self._run.stored(setup, self._solving)

    def note(self) -> str:
        """Nothing; the panel of radiosity tells."""
        return ""

    def close(self) -> None:
        """The solution is the window's."""


@dataclass(frozen=True)
class Light:
    """Which light a pixel shows: ``stamp`` changes whenever the ``source`` has another one."""

    method: str
    stamp: int
    source: LightSource = field(compare=False)


def _explain(
    setup: Setup, pixel: tuple[int, int], size: tuple[int, int], light: Light
) -> StoredPixel:
    return explain_stored(setup, pixel, size, light.method, light.source)


_explainer: Explainer[StoredPixel] = Explainer(_explain)
_lightmap = LightmapLight()  # its own: asking for parts of the light changes what it holds


def stored_explained(state: State, picture: Picture, slots: StoredSlots) -> StoredPixel | None:
    """Why the picked pixel of ``picture`` has its colour; None while there is no light for it."""
    assert state.pixel is not None
    light = Light(picture.stored, 0, _lightmap)  # a lightmap stays as it is
    if picture.stored == RADIOSITY:
        if slots.radiosity.drawn is None:
            return None
        source = DrawnLight(slots.radiosity, state.solving)
        light = Light(RADIOSITY, slots.radiosity.draws, source)
    size = picture.box[2:]
    return _explainer(picture.setup, pixel_at(state.pixel, size), size, light)
