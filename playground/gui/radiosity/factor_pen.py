"""The two patches of a form factor in the picture: outlines, normals, the line between, angles."""

from __future__ import annotations

from itertools import pairwise
from math import sqrt
from typing import Any, NamedTuple

import numpy as np
from imgui_bundle import imgui

from playground.gui.layers import stages
from playground.gui.picture.canvas import SHADE, Canvas, Rgb, ink, segment
from playground.gui.picture.comparison import Picture
from playground.gui.picture.gizmo_math import Pixel, seen
from playground.gui.pixel.arrows import arrow_length
from playground.gui.pixel.vector_pen import Rect, apart
from playground.gui.radiosity.factor_view import ONE, OTHER, UNDER, FactorView
from playground.gui.state import State
from playground.gui.widget.directions import arc
from playground.render.radiosity.patch.patches import Patches
from playground.render.view import View
from playground.shading.floats import Array

ARC = 0.55  # radius of the arc of an angle, in lengths of a normal
FOOT = 0.15  # how far under the patch its letter stands, in the same


def draw(state: State, shown: tuple[Picture, ...], origin: Any, dense: Any, scale: float) -> None:
    """What is chosen, and what is under the mouse, over every picture."""
    view, patches = state.factors, state.factors.of
    if patches is None or not (view.picking or view.one is not None):
        return
    for picture in stages(state, shown):
        canvas = Canvas(origin, dense, scale, picture.box)
        canvas.begin()
        _draw(view, patches, picture, canvas)
        canvas.end()


def _draw(view: FactorView, patches: Patches, picture: Picture, canvas: Canvas) -> None:
    eye = seen(picture.setup.scene, picture.setup.camera, canvas.size)
    for patch in (view.under, view.lit):
        if patch is not None and patch not in (view.one, view.other):
            _outline(patches, patch, UNDER, eye, canvas, 1.5)
    chosen = [
        Chosen(patches, patch, letter, colour, eye, canvas)
        for patch, letter, colour in ((view.one, "i", ONE), (view.other, "j", OTHER))
        if patch is not None
    ]
    for one in chosen:
        _outline(patches, one.patch, one.colour, eye, canvas, 3.0)
    if len(chosen) == 2:
        line = segment(eye, chosen[0].start, chosen[1].start, canvas.size)
        if line is not None:
            canvas.line(*line, UNDER, 1.5, 0.9)
    labels = [label for one in chosen for label in one.arrow()]
    for one, towards in zip(chosen, chosen[::-1], strict=True):
        labels += one.angle(towards.start) if len(chosen) == 2 else []
    _write(labels, canvas)


def _outline(
    patches: Patches, patch: int, colour: Rgb, eye: View, canvas: Canvas, width: float
) -> None:
    """The edges of one patch."""
    corners = patches.origin + patches.polygon[patch]
    for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        line = segment(eye, a, b, canvas.size)
        if line is not None:
            canvas.line(*line, colour, width)


class Label(NamedTuple):
    """Words, and the pixel in their middle."""

    words: str
    middle: Pixel
    colour: Rgb


class Chosen:
    """One of the two patches over one picture."""

    def __init__(
        self, patches: Patches, patch: int, letter: str, colour: Rgb, eye: View, canvas: Canvas
    ) -> None:
        self.patch, self.colour, self.start = patch, colour, patches.origin + patches.centre[patch]
        self._letter, self._normal = letter, patches.normal[patch]
        self._eye, self._canvas = eye, canvas
        away = float(np.linalg.norm(self.start - eye.eye))
        size = 3.0 * sqrt(float(patches.area[patch]))
        self._length = arrow_length(size, away, eye, canvas.size[1])

    def arrow(self) -> list[Label]:
        """The normal, and the letter at its foot."""
        line = self._line(np.zeros(3), self._normal)
        if line is None:
            return []
        self._canvas.arrow(*line, self.colour)
        foot = self._line(np.zeros(3), -FOOT * self._normal)
        return [Label(self._letter, foot[1], self.colour)] if foot is not None else []

    def angle(self, there: Array) -> list[Label]:
        """The arc from the normal to the other patch, and how wide it is."""
        way = there - self.start
        distance = float(np.linalg.norm(way))
        if distance == 0.0:
            return []
        directions = arc(self._normal, way / distance, 17)
        for a, b in pairwise(ARC * directions):
            line = self._line(a, b)
            if line is not None:
                self._canvas.line(*line, self.colour, 1.5)
        end = self._line(np.zeros(3), directions[len(directions) // 2])
        cosine = np.clip(self._normal @ way / distance, -1.0, 1.0)
        words = f"θ{self._letter} {np.degrees(np.arccos(cosine)):.0f}°"
        return [Label(words, end[1], self.colour)] if end is not None else []

    def _line(self, a: Array, b: Array) -> tuple[Pixel, Pixel] | None:
        """The pixels of two points in lengths of the normal, from the centre."""
        first, last = self.start + self._length * a, self.start + self._length * b
        return segment(self._eye, first, last, self._canvas.size)


def _write(labels: list[Label], canvas: Canvas) -> None:
    """The words on dark plates, none over another."""
    paint, pad, taken = imgui.get_window_draw_list(), 3.0 * canvas.scale, list[Rect]()
    for words, middle, colour in labels:
        size, at = imgui.calc_text_size(words), canvas.at(middle)
        wide, high = size.x + 2.0 * pad, size.y + 1.0
        x, y, _, _ = rect = apart((at.x - 0.5 * wide, at.y - 0.5 * high, wide, high), taken)
        taken.append(rect)
        end = imgui.ImVec2(x + wide, y + high)
        paint.add_rect_filled(imgui.ImVec2(x, y), end, ink(SHADE, 0.6), pad)
        paint.add_text(imgui.ImVec2(x + pad, y), ink(colour), words)
