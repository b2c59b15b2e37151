"""The pictures that stand in the text of a lesson, as textures: formulas and figures."""

from __future__ import annotations

from typing import NamedTuple

import moderngl
import numpy as np

from playground.lesson.formula import Mask
from playground.lesson.parts import Figure
from playground.lesson.serve import Typeset


class Letters(NamedTuple):
    """A formula in pixels of the framebuffer: its texture, size, and what is below the line."""

    texture: moderngl.Texture
    width: int
    height: int
    depth: float


class LessonPictures:
    """Textures, made when they are first shown; formulas come from the process of the lesson."""

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self._formulas: dict[Typeset, Letters | None] = {}
        self._missing: dict[Typeset, None] = {}  # in the order in which they were asked for
        self._figures: dict[Figure, moderngl.Texture] = {}

    def formula(self, formula: str, size: float) -> Letters | None:
        """A formula whose letters are ``size`` pixels high; None until it is there."""
        key = Typeset(formula, round(size, 1))
        if key not in self._formulas:
            self._missing[key] = None
        return self._formulas.get(key)

    def figure(self, figure: Figure) -> moderngl.Texture:
        """The texture of a figure, row 0 on top."""
        if figure not in self._figures:
            height, width = figure.codes.shape[:2]
            codes = np.dstack([figure.codes, np.full((height, width), 255, np.uint8)])
            self._figures[figure] = self._context.texture((width, height), 4, codes.tobytes())
        return self._figures[figure]

    def wanted(self) -> Typeset | None:
        """A formula that is still missing."""
        return next(iter(self._missing), None)

    def keep(self, key: Typeset, mask: Mask) -> None:
        """A formula is there: white letters, as opaque as they cover their pixels."""
        self._missing.pop(key, None)
        height, width = mask.pixels.shape
        if not height or not width:
            return self.refuse(key)
        codes = np.full((height, width, 4), 255, np.uint8)
        codes[..., 3] = mask.pixels
        texture = self._context.texture((width, height), 4, codes.tobytes())
        self._formulas[key] = Letters(texture, width, height, mask.depth)
        return None

    def refuse(self, key: Typeset) -> None:
        """A formula cannot be had; its source is shown."""
        self._missing.pop(key, None)
        self._formulas[key] = None

    def forget(self) -> None:
        """Free the GPU memory."""
        textures = [letters.texture for letters in self._formulas.values() if letters]
        for texture in (*textures, *self._figures.values()):
            texture.release()
        self._formulas.clear()
        self._missing.clear()
        self._figures.clear()
