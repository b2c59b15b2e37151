"""One place of the view: a picture of a setup as a texture, drawn again only when it changes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import moderngl

from playground.errors import PlaygroundError
from playground.gui.overlay_lines import NO_MARKS, LineArt, Marks
from playground.gui.picture.texture_target import TextureTarget
from playground.render.gl.program import ShaderError
from playground.render.gl.renderer import GLRenderer
from playground.scene.setup import Setup


@dataclass(frozen=True)
class Given:
    """A picture that GL has not drawn; ``stamp`` changes when it does."""

    texture: moderngl.Texture
    stamp: object


class Slot:
    """One place of the view: its renderer, its texture, and what stands in it."""

    def __init__(self, context: moderngl.Context, renderer: GLRenderer | None = None) -> None:
        """``renderer`` takes the place of the one for the local model."""
        self._context = context
        self._renderer = renderer or GLRenderer((1, 1), context)
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

    def forget(self) -> None:
        """Draw the same setup again: something else than the setup has changed."""
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
