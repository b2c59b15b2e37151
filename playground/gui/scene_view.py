"""All pictures of the view as textures, by whatever method they are made."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from functools import lru_cache
from typing import TYPE_CHECKING

import moderngl

from playground.gui.lesson.lesson_pictures import LessonPictures
from playground.gui.lightmap.atlas_picture import AtlasPicture
from playground.gui.overlay_lines import Marks
from playground.gui.picture.difference import DifferencePicture
from playground.gui.picture.path_picture import PathPicture
from playground.gui.picture.reference import ReferencePicture
from playground.gui.picture.slot import Given, Slot
from playground.gui.radiosity.factor_run import FactorRun
from playground.gui.radiosity.stored_slots import StoredSlots
from playground.gui.rays.traced_slots import TracedSlots
from playground.scene.settings import Settings, Shading
from playground.scene.setup import Setup

if TYPE_CHECKING:
    from types import TracebackType


class Slots:
    """As many slots as the layout has pictures; each keeps its programs and meshes."""

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self._slots: list[Slot] = []
        self.reference = ReferencePicture(context)
        self.difference = DifferencePicture(context)
        self.lesson = LessonPictures(context)
        self.traced = TracedSlots(context)
        self.factors = FactorRun(context)
        self.stored = StoredSlots(context)
        self.paths = PathPicture(context)
        self.atlas = AtlasPicture(context)
        self._chalk = Slot(context)
        self._texts: Mapping[str, str] = {}
        self._used: tuple[int, ...] = ()

    def __getitem__(self, index: int) -> Slot:
        while index >= len(self._slots):
            self._slots.append(Slot(self._context))
            self._slots[-1].override(self._texts)
        return self._slots[index]

    def marked(self, given: Given, setup: Setup, marks: Marks) -> moderngl.Texture:
        """The texture with a picture of ``setup`` that has no depth, and ``marks`` over it."""
        bare = replace(setup, settings=_unlit(setup.settings))
        return self._chalk.texture(bare, given.texture.size, marks, given)

    def use(self, rastered: Iterable[int], traced: Iterable[int] = ()) -> None:
        """Say which pictures of the present layout GL draws, and which are ray traced."""
        self._used = tuple(rastered)
        self.traced.use(traced)

    def override(self, texts: Mapping[str, str]) -> None:
        """Draw every picture with ``texts`` in place of shader files."""
        self._texts = texts
        for slot in self._slots:
            slot.override(texts)

    @property
    def shader_error(self) -> str:
        """Why the texts are not what the pictures in use were drawn with, or empty."""
        errors = (self[number].shader_error for number in self._used)
        return next(filter(None, errors), "")

    @property
    def milliseconds(self) -> float:
        """GPU time of the last drawing of every picture in use."""
        drawn = sum(self[number].milliseconds for number in self._used)
        return drawn + self.traced.milliseconds + self.stored.milliseconds

    @property
    def refining(self) -> bool:
        """Whether the next frame will bring more of a picture."""
        return self.traced.refining or self.stored.working

    @property
    def coming(self) -> bool:
        """Whether a thread computes a picture."""
        pictures = self.reference.coming or self.traced.coming or self.paths.working
        return pictures or self.factors.now.working

    @property
    def draws(self) -> int:
        """How often any picture has been drawn."""
        return sum(slot.draws for slot in self._slots) + self.stored.draws

    def restore(self) -> None:
        """Leave the state of GL as a window expects to find it."""
        self._context.enable_only(moderngl.NOTHING)
        self._context.front_face = "ccw"

    def close(self) -> None:
        """Free the GPU memory."""
        self.reference.rest()
        self.reference.release()
        self.difference.release()
        self.atlas.release()
        self.traced.close()
        self.factors.close()
        self.stored.close()
        self.paths.rest()
        self.paths.release()
        self.lesson.forget()
        for slot in (*self._slots, self._chalk):
            slot.release()
        self._slots.clear()

    def __enter__(self) -> Slots:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()


# The same settings give the same object again: renderers notice change by identity.
@lru_cache(maxsize=16)
def _unlit(settings: Settings) -> Settings:
    """Enough for the depth of a picture."""
    return replace(settings, shading=Shading.PER_FRAGMENT.value, terms=(), bugs=())
