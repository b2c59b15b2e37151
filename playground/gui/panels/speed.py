"""Speed and error: what a frame takes, how far it is off, and a dot for all that was tried."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from imgui_bundle import imgui, implot

from playground.gui.measure import speed_log
from playground.gui.measure.speed_log import Dot
from playground.gui.state import State
from playground.gui.widget import log_axis, plots
from playground.gui.widget.theme import PALETTES
from playground.gui.widgets import Ui, attempt
from playground.gui.work import progress_bar
from playground.scene.settings import Shading

HEIGHT = 14.0  # of the plot, in heights of the text
LEAST = 1e-4  # errors below this are drawn here: nobody sees them, and they squeeze the others
BESIDE = {"flat": (-0.5, 0.9), "per-vertex": (0.3, -0.9), "per-fragment": (0.0, -1.0)}  # labels


def draw(state: State, ui: Ui) -> State:
    """The window's own times, the dot of what is shown now, and all dots."""
    log = state.speed
    imgui.text(f"this window: {log.gpu_ms:.1f} ms drawing, {log.wall_ms:.1f} ms a frame")
    imgui.set_item_tooltip("the pictures of the view; everything from one frame to the next")
    state = _measuring(state, ui)
    if state.speed.error:
        plots.wrapped(state.speed.error, PALETTES[state.theme].alarm)
    now = speed_log.present(state)
    _numbers(now)
    dots = state.speed.dots
    if dots:
        plots.legend(state.theme, [mode for mode in Shading if any(d.mode == mode for d in dots)])
        imgui.text_disabled("a dot for each mode and tessellation tried")
        _plot(state, dots, [now] if now else [])
        state = _table(state)
    return state


def _measuring(state: State, ui: Ui) -> State:
    """Measure on request, or by itself when something new is tried."""
    settled = not imgui.is_any_item_active() and not state.playing
    log = attempt(ui, state.speed, "automatic", _automatic(state.speed.automatic))
    state = replace(state, speed=log) if log is not state.speed else state
    if log.of is not None:
        cancelled = progress_bar.draw(log.progress, "measure")
        return speed_log.cancelled(state) if cancelled else state
    imgui.same_line()
    wanted = imgui.button("Measure now###measure")
    if wanted or (log.automatic and settled and speed_log.untried(state)):
        state = speed_log.asked(state)
    return state


def _automatic(on: bool) -> bool:
    _, on = imgui.checkbox("measure what I try", on)
    imgui.set_item_tooltip("measure every mode and tessellation by itself as you try it")
    return bool(on)


def _numbers(dot: Dot | None) -> None:
    """What was measured of the setup as it is shown now."""
    if dot is None:
        imgui.text_disabled("not measured yet")
        imgui.text_disabled("")
        return
    gpu = "no GPU clock" if dot.gpu_ms is None else f"{dot.gpu_ms:.3g} ms GPU"
    imgui.text(f"at 640×480: {dot.wall_ms:.3g} ms wall, {gpu}")
    imgui.set_item_tooltip("median of 21 frames: by the clock on the wall, and by the GPU's own")
    imgui.text(f"error: {dot.rmse:.2g} RMSE, {dot.largest:.2g} at most")
    imgui.set_item_tooltip(
        "linear light, against per-fragment shading of the same mesh in float64;\n"
        f"in 8-bit codes about {255 * dot.rmse:.2g} and {255 * dot.largest:.2g}"
    )


def _plot(state: State, dots: tuple[Dot, ...], now: list[Dot]) -> None:
    """One dot each; the one of what is shown now has a ring."""
    if not plots.begin("##dots", state.theme, HEIGHT * imgui.get_font_size()):
        return
    implot.setup_axes("ms per frame", "error (RMSE)")
    _axis(implot.ImAxis_.x1, [dot.milliseconds for dot in dots])
    _axis(implot.ImAxis_.y1, [error(dot) for dot in dots])
    for mode in Shading:
        mine = [dot for dot in dots if dot.mode == mode]
        spec = plots.pen(state.theme, mode)
        spec.marker, spec.marker_size = implot.Marker_.circle, 4.0
        implot.plot_scatter(mode, *_places(mine), spec)
    ring = plots.pen(state.theme, "reference", 2.0)
    ring.marker, ring.marker_size, ring.fill_alpha = implot.Marker_.circle, 8.0, 0.0
    implot.plot_scatter("now", *_places(now), ring)
    several = len({dot.setup for dot in dots}) > 1
    for dot in dots:
        text = f"{dot.setup} {dot.label}" if several else dot.label
        right, down = BESIDE[dot.mode]
        size, wide = imgui.get_font_size(), imgui.calc_text_size(text).x
        aside = imgui.ImVec2(right * (0.5 * wide + 0.5 * size), down * size)
        colour = plots.COLOURS[state.theme][dot.mode]
        implot.push_style_color(implot.Col_.inlay_text, imgui.ImVec4(*colour, 1.0))
        implot.plot_text(text, dot.milliseconds, error(dot), aside)
        implot.pop_style_color()
    plots.end()


def _axis(axis: int, values: list[float]) -> None:
    low, high = log_axis.limits(values)
    implot.setup_axis_scale(axis, implot.Scale_.log10)
    implot.setup_axis_limits(axis, low, high, implot.Cond_.always)
    ticks = log_axis.ticks(low, high)
    implot.setup_axis_ticks(axis, ticks, [_tick(axis, tick) for tick in ticks])


def _tick(axis: int, tick: float) -> str:
    lowest = axis == implot.ImAxis_.y1 and tick == LEAST
    return f"≤ {tick:g}" if lowest else f"{tick:g}"


def error(dot: Dot) -> float:
    """Where a dot stands on the logarithmic axis of errors."""
    return max(dot.rmse, LEAST)


def _places(dots: list[Dot]) -> tuple[np.ndarray, np.ndarray]:
    return np.array([dot.milliseconds for dot in dots]), np.array([error(dot) for dot in dots])


def _table(state: State) -> State:
    if imgui.button("Copy as CSV"):
        imgui.set_clipboard_text(state.speed.to_csv())
        state = state.say("the table is copied")
    imgui.same_line()
    if imgui.button("Clear"):
        log = replace(state.speed, dots=(), automatic=False)
        state = replace(state, speed=log)
    return state
