"""Pictures of setups as textures, drawn again only when setup or size have changed."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TYPE_CHECKING

import moderngl

from playground.errors import PlaygroundError
from playground.gui.difference import DifferencePicture
from playground.gui.lesson_pictures import LessonPictures
from playground.gui.overlay_lines import NO_MARKS, LineArt, Marks
from playground.gui.reference import ReferencePicture
from playground.gui.texture_target import TextureTarget
from playground.gui.traced_slots import TracedSlots
from playground.render.gl.program import ShaderError
from playground.render.gl.renderer import GLRenderer
from playground.scene.settings import Settings, Shading
from playground.scene.setup import Setup

if TYPE_CHECKING:
    from types import TracebackType


@dataclass(frozen=True)
class Given:
    """A picture that GL has not drawn; ``stamp`` changes when it does."""

    texture: moderngl.Texture
    stamp: object


class Slot:
    """One place of the view: its renderer, its texture, and what stands in it."""

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self._renderer = GLRenderer((1, 1), context)
        self._target: TextureTarget | None = None
        self._drawn: Setup | None = None
        self._marks = NO_MARKS
        self._given: Given | None = None
        self._lines: LineArt | None = None
        self._query = context.query(time=True)
        self._waiting = False
        self.draws = 0
        self._milliseconds = 0.0

    def texture(
        self,
        setup: Setup,
        size: tuple[int, int],
        marks: Marks = NO_MARKS,
        given: Given | None = None,
    ) -> moderngl.Texture:
        """The texture with the picture of ``setup``, and ``marks`` drawn over it.

        A picture that is ``given`` takes the place of the drawn one, which lends its depth.

        Raises
        ------
        PlaygroundError
            What the renderer refuses; the old picture is lost.
        """
        target = self._sized(size, setup.settings.samples)
        if (marks, given) != (self._marks, self._given):
            self._drawn, self._marks, self._given = None, marks, given
        if self._drawn is not setup and self._drawn != setup:
            self._drawn = None
            self._draw(setup, target)
            self._drawn = setup
        return target.texture

    def override(self, texts: Mapping[str, str]) -> None:
        """Draw with ``texts`` in place of shader files from now on."""
        if texts != self._renderer.overrides:
            self._renderer.overrides = texts
            self._drawn = None

    @property
    def shader_error(self) -> str:
        """Why the texts are not what the picture was drawn with; empty if they are."""
        return self._renderer.shader_error

    @property
    def milliseconds(self) -> float:
        """GPU time of the last drawing. Asked for a frame later, it costs no waiting."""
        if self._waiting:
            self._milliseconds, self._waiting = self._query.elapsed * 1e-6, False
        return self._milliseconds

    def _draw(self, setup: Setup, target: TextureTarget) -> None:
        self._renderer.size = target.size
        with self._query:
            self._draw_edited(setup, target)
            if self._given is not None:
                target.lay(self._given.texture)
            if self._marks:
                self._lines = self._lines or LineArt(self._context)
                self._lines.draw(setup, self._marks, target.size)
            target.resolve()
        self._waiting = True
        self.draws += 1

    def _draw_edited(self, setup: Setup, target: TextureTarget) -> None:
        """Draw; shaders of the user that compile, but cannot be fed, give way to the last good."""
        try:
            self._renderer.draw(setup, target)
        except (PlaygroundError, ShaderError):
            raise
        except Exception as error:  # a uniform or attribute of another type than ours
            if not self._renderer.overrides or self._renderer.shader_error:
                raise
            self._renderer.refuse_overrides(f"this compiles, but cannot be drawn with: {error}")
            self._renderer.draw(setup, target)

    def _sized(self, size: tuple[int, int], samples: int) -> TextureTarget:
        wanted = (size, min(samples, self._context.max_samples) if samples > 1 else 1)
        if self._target is not None and (self._target.size, self._target.samples) == wanted:
            return self._target
        if self._target is not None:
            self._target.release()
        self._target, self._drawn = None, None
        self._target = TextureTarget(self._context, size, samples)
        return self._target

    def release(self) -> None:
        """Free the GPU memory."""
        self._renderer.close()
        if self._lines is not None:
            self._lines.release()
        if self._target is not None:
            self._target.release()


class Slots:
    """As many slots as the layout has pictures; each keeps its programs and meshes."""

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self._slots: list[Slot] = []
        self.reference = ReferencePicture(context)
        self.difference = DifferencePicture(context)
        self.lesson = LessonPictures(context)
        self.traced = TracedSlots(context)
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
        return sum(self[number].milliseconds for number in self._used) + self.traced.milliseconds

    @property
    def draws(self) -> int:
        """How often any picture has been drawn."""
        return sum(slot.draws for slot in self._slots)

    def restore(self) -> None:
        """Leave the state of GL as a window expects to find it."""
        self._context.enable_only(moderngl.NOTHING)
        self._context.front_face = "ccw"

    def close(self) -> None:
        """Free the GPU memory."""
        self.reference.rest()
        self.reference.release()
        self.difference.release()
        self.traced.close()
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
