"""The books of a solver as stacked bars: absorbed + escaped + unshot = emitted, at every step."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from imgui_bundle import imgui, implot

from playground.gui.radiosity.race_log import CHANNELS, PARTS
from playground.gui.radiosity.solver_colours import BOOKS
from playground.gui.same_object import kept_for_same
from playground.gui.widget import plots
from playground.gui.widget.theme import PALETTES
from playground.measure.solver_race import Lap

HEIGHT = 9.0  # of the plot, in heights of the text
MOST = 24  # bars; of more steps, so many are shown
THICK = 0.8  # of a bar, its place being 1


def draw(laps: Sequence[Lap], channel: str, theme: str) -> None:
    """The bars of some of the steps, their legend, and how well the books balance."""
    legend(theme)
    if not plots.begin("##energy", theme, HEIGHT * imgui.get_font_size()):
        return
    some, parts = bars_of(laps, channel)
    axis = implot.AxisFlags_
    implot.setup_axes("step", "", axis.lock.value, axis.lock.value)
    implot.setup_axis_limits(implot.ImAxis_.x1, -0.6, max(len(some), 6) - 0.4, implot.Cond_.always)
    low, high = (float(x) for x in (parts.min(initial=0.0), _tops(parts).max(initial=100.0)))
    implot.setup_axis_limits(implot.ImAxis_.y1, 1.08 * low, 1.08 * high, implot.Cond_.always)
    skip = max(1, -(-len(some) // 6))
    places = [float(i) for i in range(0, len(some), skip)]
    implot.setup_axis_ticks(
        implot.ImAxis_.x1, places or [0.0], [f"{some[int(i)].done:,}" for i in places] or [""]
    )
    _stacks(parts, theme)
    spec = implot.Spec()
    spec.line_color = imgui.ImVec4(*PALETTES[theme].text, 0.8)
    ends = np.array([-0.6, max(len(some), 6) - 0.4])
    implot.plot_line("emitted", ends, np.array([100.0, 100.0]), spec)
    plots.end()


def legend(theme: str) -> None:
    """The entries of the books, each behind a square of its colour."""
    size = imgui.get_font_size()
    for i, name in enumerate(PARTS):
        if i:
            imgui.same_line(0.0, size)
        at = imgui.get_cursor_screen_pos()
        low = imgui.ImVec2(at.x, at.y + 0.25 * size)
        high = imgui.ImVec2(at.x + 0.6 * size, at.y + 0.85 * size)
        colour = imgui.get_color_u32(imgui.ImVec4(*BOOKS[theme][name], 1.0))
        imgui.get_window_draw_list().add_rect_filled(low, high, colour)
        imgui.set_cursor_screen_pos(imgui.ImVec2(at.x + 0.9 * size, at.y))
        imgui.text(name)
    imgui.same_line(0.0, size)
    imgui.text_disabled("line: 100 %")


@kept_for_same(2)
def bars_of(laps: Sequence[Lap], channel: str) -> tuple[list[Lap], np.ndarray]:
    """Some of the steps, first and last among them, and their parts in per cent, (bars, 3)."""
    if not laps:
        return [], np.zeros((0, len(PARTS)))
    chosen = np.unique(np.linspace(0, len(laps) - 1, MOST).round().astype(int))
    some = [laps[i] for i in chosen]
    emitted = np.array([share_of(lap.emitted, channel) for lap in some])
    columns = [[share_of(getattr(lap, part), channel) for lap in some] for part in PARTS]
    parts = np.array(columns).T / np.where(emitted > 0.0, emitted, 1.0)[:, None]
    return some, 100.0 * parts


def share_of(energy: tuple[float, float, float], channel: str) -> float:
    """The energy of one channel, or of all."""
    return sum(energy) if channel == CHANNELS[0] else energy[CHANNELS.index(channel) - 1]


def worst_imbalance(laps: Sequence[Lap]) -> float:
    """The largest |emitted − absorbed − escaped − unshot| of all steps, relative."""
    return max((lap.imbalance for lap in laps), default=0.0)


def _tops(parts: np.ndarray) -> np.ndarray:
    return np.asarray(np.maximum(parts, 0.0).sum(axis=1))


def _stacks(parts: np.ndarray, theme: str) -> None:
    """Each part on those before it; what is below zero, light sent too early, hangs down."""
    places = np.arange(len(parts), dtype=np.float64)
    for sign in (1.0, -1.0):
        tops = np.cumsum(np.maximum(sign * parts, 0.0), axis=1)
        for i in reversed(range(len(PARTS))):  # the highest first, the others before it
            if not tops[:, i].any():
                continue
            spec = implot.Spec()
            spec.fill_color = spec.line_color = imgui.ImVec4(*BOOKS[theme][PARTS[i]], 1.0)
            heights = np.ascontiguousarray(sign * tops[:, i])
            implot.plot_bars(f"{PARTS[i]} {sign}", places, heights, THICK, spec)
