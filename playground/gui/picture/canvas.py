"""Drawing over a picture in the picture's own pixels."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from math import hypot, isfinite
from typing import Any

import numpy as np
from imgui_bundle import imgui
from numpy.typing import ArrayLike

from playground.gui.picture.comparison import Box
from playground.gui.picture.gizmo_math import Pixel, Size
from playground.render.view import View

Rgb = tuple[float, float, float]
Floats = tuple[float, ...]
SHADE = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Canvas:
    """ImGui's draw list over the box of a picture.

    ``scale`` is that of the text, in ImGui's units; ``dense`` are pixels per such unit.
    """

    origin: Any  # upper left corner of the view, ImGui's units
    dense: Any
    scale: float
    box: Box

    @property
    def size(self) -> Size:
        """Width and height of the picture in pixels."""
        return self.box[2], self.box[3]

    @property
    def unit(self) -> float:
        """Pixels of the picture per unit of length in the interface, at text size 1."""
        return float(self.scale * self.dense.x)

    def at(self, place: Pixel) -> imgui.ImVec2:
        """Where a pixel of the picture is on the screen."""
        x = self.origin.x + (self.box[0] + place[0]) / self.dense.x
        y = self.origin.y + (self.box[1] + place[1]) / self.dense.y
        return imgui.ImVec2(x, y)

    def begin(self) -> None:
        """Draw within the picture only, until `end`."""
        low, high = self.at((0.0, 0.0)), self.at((float(self.box[2]), float(self.box[3])))
        imgui.get_window_draw_list().push_clip_rect(low, high, True)

    def end(self) -> None:
        """Draw anywhere again."""
        imgui.get_window_draw_list().pop_clip_rect()

    def line(self, a: Pixel, b: Pixel, colour: Rgb, width: float = 2.0, alpha: float = 1.0) -> None:
        """A line with a dark edge: it is seen over any picture."""
        paint = imgui.get_window_draw_list()
        start, end = self.at(a), self.at(b)
        paint.add_line(start, end, ink(SHADE, 0.5 * alpha), (width + 2.0) * self.scale)
        paint.add_line(start, end, ink(colour, alpha), width * self.scale)

    def arrow(self, a: Pixel, b: Pixel, colour: Rgb, width: float = 2.0) -> None:
        """A line with a head at ``b``."""
        x, y = b[0] - a[0], b[1] - a[1]
        long = hypot(x, y)
        if long < 1.0:
            return
        head = min(11.0 * self.unit, long)
        x, y = x / long * head, y / long * head
        neck = (b[0] - 0.8 * x, b[1] - 0.8 * y)
        self.line(a, neck, colour, width)
        left = (b[0] - x - 0.4 * y, b[1] - y + 0.4 * x)
        right = (b[0] - x + 0.4 * y, b[1] - y - 0.4 * x)
        corners = self.at(b), self.at(left), self.at(right)
        paint = imgui.get_window_draw_list()
        paint.add_triangle_filled(*corners, ink(colour))
        paint.add_triangle(*corners, ink(SHADE, 0.6), self.scale)

    def text(self, middle: Pixel, words: str, colour: Rgb) -> None:
        """Words around a point."""
        size, at = imgui.calc_text_size(words), self.at(middle)
        place = imgui.ImVec2(at.x - size.x / 2.0, at.y - size.y / 2.0)
        imgui.get_window_draw_list().add_text(place, ink(colour), words)

    def plate(self, middle: Pixel, words: str, colour: Rgb) -> None:
        """Words on a dark disc."""
        paint = imgui.get_window_draw_list()
        paint.add_circle_filled(self.at(middle), 9.0 * self.scale, ink(SHADE, 0.55))
        self.text(middle, words, colour)


def note(words: str) -> None:
    """A tooltip that leaves most of the picture free; the view itself has no padding to lend."""
    size = imgui.get_font_size()
    imgui.push_style_var(imgui.StyleVar_.window_padding, imgui.ImVec2(0.6 * size, 0.5 * size))
    if imgui.begin_tooltip():
        imgui.push_text_wrap_pos(22.0 * size)
        imgui.text_unformatted(words)
        imgui.pop_text_wrap_pos()
        imgui.end_tooltip()
    imgui.pop_style_var()


def ink(colour: Rgb, alpha: float = 1.0) -> int:
    """A colour with components in [0, 1] as ImGui packs it."""
    return int(imgui.get_color_u32(imgui.ImVec4(*colour, alpha)))


def segment(view: View, a: ArrayLike, b: ArrayLike, size: Size) -> tuple[Pixel, Pixel] | None:
    """The pixels of the ends of a line in the world, cut where it passes behind the eye."""
    # Plain floats: for two points NumPy would be slower, and overlays have a hundred lines.
    eye, ahead, rows = _numbers(view)
    start, end = _relative(a, eye), _relative(b, eye)
    before, after, least = _dot(ahead, start), _dot(ahead, end), 1e-3 * view.near
    if before < least and after < least:
        return None
    if before < least or after < least:
        share = (least - before) / (after - before)
        cut = tuple(s + (e - s) * share for s, e in zip(start, end, strict=True))
        start, end = (cut, end) if before < least else (start, cut)
    first, last = (_pixel(place, view.scale, rows, size) for place in (start, end))
    return (first, last) if first and last else None


@lru_cache(maxsize=4)
def _numbers(view: View) -> tuple[Floats, Floats, tuple[Floats, ...]]:
    """The eye, the direction of view, and the rows of the matrix to clip space."""
    rows = tuple(tuple(row) for row in view.clip_from_eye.tolist())
    return tuple(view.eye.tolist()), tuple((-view.camera_from_world[2]).tolist()), rows


def _relative(point: ArrayLike, eye: Floats) -> Floats:
    x, y, z = np.asarray(point, dtype=np.float64).tolist()
    return x - eye[0], y - eye[1], z - eye[2]


def _dot(a: Floats, b: Floats) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _pixel(place: Floats, scale: float, rows: tuple[Floats, ...], size: Size) -> Pixel | None:
    """As `View.window`, for one place relative to the eye; None where it has no pixel."""
    place = place[0] * scale, place[1] * scale, place[2] * scale
    x, y, _, w = (_dot(row, place) + row[3] for row in rows)
    if not w > 0.0:
        return None
    across, down = (x / w + 1.0) / 2.0 * size[0], (1.0 - y / w) / 2.0 * size[1]
    return (across, down) if isfinite(across) and isfinite(down) else None
