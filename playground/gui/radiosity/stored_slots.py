"""The pictures of stored light in the view: by radiosity, which is being solved, or a lightmap."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import moderngl

from playground.errors import PlaygroundError
from playground.gui.overlay_lines import Marks
from playground.gui.picture.slot import Slot
from playground.gui.radiosity.patch_lines import PatchLines, PatchMarker
from playground.gui.radiosity.radiosity_run import Light, RadiosityRun
from playground.gui.radiosity.solving import Solving
from playground.gui.state import RADIOSITY
from playground.render.gl.stored import GLStored
from playground.render.lightmap.light_source import LightmapLight
from playground.scene.setup import Setup

Place = tuple[int, str]  # number in the layout, method
HERE = "Bake in the panel Lightmap does it here."
NONE_YET = (
    "this setup has none yet. Press Bake in the panel Lightmap; or, on the command line, "
    "playground bake SETUP -o out.toml, and open out.toml."
)


class Lent:
    """Light that somebody else computes, as a renderer asks for it."""

    def __init__(self) -> None:
        self.warnings: tuple[str, ...] = ()
        self.light: Light = ()

    def prepare(self, setup: Setup) -> Iterator[float]:
        """Nothing: it is there, or the objects are dark."""
        return iter(())

    def stored(self, setup: Setup) -> Light:
        """What was put here last."""
        return self.light

    def note(self) -> str:
        """Nothing; the panel tells."""
        return ""

    def close(self) -> None:
        """Nothing is held here."""


class StoredSlots:
    """A picture for each place of the layout that shows stored light."""

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self._slots: dict[Place, tuple[Slot, GLStored, Lent]] = {}
        self._asked: dict[Place, tuple[object, ...]] = {}
        self.radiosity = RadiosityRun(context)
        self._lightmap = LightmapLight()
        self.no_lightmap = ""  # why there is none to draw with
        self._wanted = False
        self._marker = PatchMarker()

    def solve(self, setup: Setup | None, solving: Solving) -> None:
        """Go on with the radiosity of what is shown; None where no picture wants it."""
        self._wanted = setup is not None
        if setup is not None:
            self.radiosity.advance(setup, solving)

    def texture(
        self, place: Place, setup: Setup, size: tuple[int, int], marks: Marks, solving: Solving
    ) -> moderngl.Texture:
        """The picture of ``setup`` with the light that is there."""
        slot, renderer, lent = self._at(place)
        asked = (setup.scene, setup.settings, self._stamp(place))
        known = self._asked.get(place, ())
        if len(known) != 3 or known[:2] != asked[:2] or known[2] != asked[2]:
            lent.light = self._light(place, setup, solving)
            renderer.ask_again()
            slot.forget()
            self._asked[place] = asked
        return slot.texture(setup, size, marks)

    def marked(self, solving: Solving) -> PatchLines | None:
        """The patches as lines, if they are shown and wanted."""
        return self._marker.lines(self.radiosity, solving) if self._wanted else None

    def use(self, places: Iterable[Place]) -> None:
        """Say which places show stored light."""
        used = set(places)
        for place in set(self._slots) - used:
            self._slots.pop(place)[0].release()
            self._asked.pop(place, None)

    def stamp(self, number: int, method: str) -> object:
        """What changes whenever a picture does."""
        place = (number, method)
        return (self._stamp(place), self._slots[place][0].draws if place in self._slots else 0)

    def settled(self, method: str) -> bool:
        """Whether nothing more will come of the pictures of a method by itself."""
        return method != RADIOSITY or not self.radiosity.working

    def trouble(self, method: str) -> str:
        """Why a method has no light to show; empty if it has."""
        return self.radiosity.error if method == RADIOSITY else self.no_lightmap

    @property
    def solves(self) -> bool:
        """Whether a picture shows radiosity."""
        return self._wanted

    @property
    def warnings(self) -> tuple[str, ...]:
        """What the lightmap shows that its author may not expect."""
        return self._lightmap.warnings

    @property
    def working(self) -> bool:
        """Whether the next frame will bring more light."""
        return self._wanted and self.radiosity.working

    @property
    def milliseconds(self) -> float:
        """GPU time of the last drawing of each."""
        return sum(slot.milliseconds for slot, _, _ in self._slots.values())

    @property
    def draws(self) -> int:
        """How often any has been drawn."""
        return sum(slot.draws for slot, _, _ in self._slots.values())

    def close(self) -> None:
        """Free the GPU memory."""
        self.use(())
        self.radiosity.close()

    def _at(self, place: Place) -> tuple[Slot, GLStored, Lent]:
        if place not in self._slots:
            lent = Lent()
            renderer = GLStored((1, 1), lent, self._context)
            self._slots[place] = Slot(self._context, renderer), renderer, lent
        return self._slots[place]

    def _stamp(self, place: Place) -> int:
        return self.radiosity.draws if place[1] == RADIOSITY else 0  # a lightmap stays as it is

    def _light(self, place: Place, setup: Setup, solving: Solving) -> Light:
        if place[1] == RADIOSITY:
            return self.radiosity.stored(setup, solving)
        try:
            light = self._lightmap.stored(setup)
        except PlaygroundError as error:
            self.no_lightmap = f"{error} {HERE}" if setup.scene.lightmap else NONE_YET
            return (None,) * len(setup.scene.objects)
        self.no_lightmap = ""
        return light
