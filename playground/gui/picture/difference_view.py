"""The difference of the two compared pictures on the screen, and what its colours mean."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import moderngl
from imgui_bundle import imgui

from playground.explain.colour_map import VIRIDIS
from playground.gui.layers import marks_of
from playground.gui.picture.canvas import ink
from playground.gui.picture.comparison import Picture
from playground.gui.picture.difference import Compared
from playground.gui.picture.slot import Given
from playground.gui.scene_view import Slots
from playground.gui.state import State
from playground.gui.widget.spans import tidy
from playground.gui.widgets import tooltip
from playground.scene.knob import knobs

WIDE, BAR = 300.0, 14.0  # width of the legend and height of its bar, at text size 1
LEAST, SHARE = 220.0, 0.36  # in a small view: so wide at least, and of the width of the view
MARGIN, PAD = 12.0, 10.0
TICKS = 2  # parts of the bar with a number at each end
WHITE = (1.0, 1.0, 1.0)


def pictured(
    state: State, shown: tuple[Picture, ...], textures: list[moderngl.Texture], slots: Slots
) -> tuple[tuple[Picture, ...], list[moderngl.Texture]]:
    """The two pictures as one: their difference, with the lines that are switched on."""
    a, b = shown
    of = slots.difference.of
    if all(settled(picture, i, slots) for i, picture in enumerate(shown)):
        stamps = (_stamp(picture, i, slots) for i, picture in enumerate(shown))
        of = Compared(a.setup, (*stamps, b.reference, b.paths, a.box))
    texture = slots.difference.texture(of, textures[0], textures[1], state.magnify)
    marks = marks_of(state, slots)
    if of is not None and marks:
        given = Given(texture, (of, state.magnify))
        texture = slots.marked(given, of.setup, marks)
    caption = f"|{a.caption} − {b.caption}|"
    stored, reference, paths = a.stored or b.stored, a.reference or b.reference, a.paths or b.paths
    one = replace(a, reference=reference, paths=paths, stored=stored, tests=False)
    return (replace(one, caption=caption),), [texture]


def settled(picture: Picture, number: int, slots: Slots) -> bool:
    """Whether a picture is there as it shall be."""
    if picture.reference:
        return not slots.reference.computing
    if picture.paths:
        return not slots.paths.computing
    if picture.stored:
        return slots.stored.settled(picture.stored)
    return not picture.traced or slots.traced.settled(number)


def _stamp(picture: Picture, number: int, slots: Slots) -> object:
    """What changes whenever a picture does."""
    if picture.reference:
        return slots.reference.stamp
    if picture.paths:
        return slots.paths.stamp, slots.paths.shows
    if picture.stored:
        return slots.stored.stamp(number, picture.stored)
    return slots.traced.stamp(number) if picture.traced else slots[number].draws


def legend(state: State, slots: Slots, origin: Any, space: Any, scale: float) -> State:
    """The scale of colours, the slider that stretches it, the maximum and the mean."""
    line = imgui.get_text_line_height_with_spacing()
    wide = min(WIDE * scale, max(SHARE * space.x, LEAST * scale), space.x - 2 * MARGIN * scale)
    pad = PAD * scale
    high = 2 * pad + 3 * line + BAR * scale + imgui.get_frame_height_with_spacing()
    left = origin.x + space.x - wide - MARGIN * scale
    top = origin.y + space.y - high - MARGIN * scale
    paint = imgui.get_window_draw_list()
    low, end = imgui.ImVec2(left, top), imgui.ImVec2(left + wide, top + high)
    paint.add_rect_filled(low, end, ink((0.0, 0.0, 0.0), 0.72), 5 * scale)
    left, wide = left + pad, wide - 2 * pad
    found = slots.difference.difference
    words = f"maximum {found.largest:.3f}   mean {found.mean:.2g}"
    if slots.reference.computing:
        coming = slots.reference.coming
        words = "computing the reference..." if coming else "the reference was given up"
    elif not slots.traced.done:
        words = "tracing rays..."
    elif slots.stored.working:
        words = "solving radiosity..."
    elif slots.paths.computing:
        words = "following paths..."
    paint.add_text(imgui.ImVec2(left, top + pad), ink(WHITE), "difference as shown, 0 to 1")
    paint.add_text(imgui.ImVec2(left, top + pad + line), ink(WHITE), words)
    _bar(left, top + pad + 2 * line, wide, scale, state.magnify)
    below = top + pad + 3 * line + BAR * scale
    imgui.set_cursor_screen_pos(imgui.ImVec2(left, below))
    imgui.set_next_item_width(wide)
    imgui.set_next_item_allow_overlap()
    return replace(state, magnify=_slider(state.magnify))


def _slider(magnify: float) -> float:
    """The slider that stretches the colours; right-click sets the declared default."""
    knob, flags = knobs(State)["magnify"], imgui.SliderFlags_
    options = flags.logarithmic.value | flags.always_clamp.value
    changed, new = imgui.slider_float(
        "##magnify", magnify, knob.low, knob.high, "magnified %.3g times", options
    )
    tooltip(knob)
    if imgui.is_item_hovered() and imgui.is_mouse_clicked(1):
        return float(knob.default)
    return tidy(new) if changed else magnify


def _bar(left: float, top: float, wide: float, scale: float, magnify: float) -> None:
    """The colours from 0 to 1/magnify, and numbers under them."""
    paint, high = imgui.get_window_draw_list(), BAR * scale
    colours = [ink((float(r), float(g), float(b))) for r, g, b in VIRIDIS]
    step = wide / (len(colours) - 1)
    for i in range(len(colours) - 1):
        low = imgui.ImVec2(left + i * step, top)
        end = imgui.ImVec2(left + (i + 1) * step, top + high)
        a, b = colours[i], colours[i + 1]
        paint.add_rect_filled_multi_color(low, end, a, b, b, a)
    for i in range(TICKS + 1):
        value = f"{i / TICKS / magnify:.3g}" + ("+" if i == TICKS else "")
        width = imgui.calc_text_size(value).x
        x = left + i / TICKS * (wide - width)
        paint.add_text(imgui.ImVec2(x, top + high + scale), ink(WHITE), value)
