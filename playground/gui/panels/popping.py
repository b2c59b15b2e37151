"""The popping scope: the camera on its path, and what the highlight does along it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from imgui_bundle import imgui, implot

from playground.gui.measure import scope_path
from playground.gui.measure.scope_path import DRAWN, EXACT, Scope
from playground.gui.same_object import kept_for_same
from playground.gui.state import State
from playground.gui.widget import plots
from playground.gui.widget.theme import PALETTES
from playground.gui.widgets import Ui
from playground.gui.work import progress_bar
from playground.measure.popping import Brightness, Step, largest_jump

ORDER = (*EXACT, *DRAWN)  # the reference lies below the others
TICKS = (0, 90, 180, 270, 360)  # degrees
Steps = tuple[Step, ...]
Curve = tuple[np.ndarray, np.ndarray]  # angles and values, as the plot takes them
GUIDE = 7  # number of the line that shows the angle, for ImPlot
HEIGHT = 6.2  # of a plot, in heights of the text
CURVES: tuple[tuple[str, Callable[[Brightness], float]], ...] = (
    ("brightest point of the highlight", lambda value: value.peak),
    ("mean brightness", lambda value: value.mean),
)


def draw(state: State, ui: Ui) -> State:
    """The path, the measuring, two plots, and the largest jumps."""
    settled = not imgui.is_any_item_active() and not imgui.is_mouse_down(0)
    if settled and not state.playing and scope_path.outdated(state):
        state = scope_path.measured(state)
    state = _path(state)
    state = _measuring(state)
    if state.scope.error:
        plots.wrapped(state.scope.error, PALETTES[state.theme].alarm)
    plots.legend(state.theme, (*DRAWN, *EXACT))
    for name, value in CURVES:
        imgui.text_disabled(name)
        state = _plot(state, name, value, HEIGHT * imgui.get_font_size())
    _jumps(state.scope)
    return state


def _path(state: State) -> State:
    """Play, pause and scrub."""
    scope = state.scope
    if imgui.button("Pause###play" if scope.playing else "Play###play"):
        state = replace(state, scope=replace(scope, playing=not scope.playing), playing=False)
        if scope_path.off_path(state):
            state = scope_path.scrubbed(state, scope.angle)
    imgui.set_item_tooltip("the camera goes once around its target, at the height where it is")
    imgui.same_line()
    imgui.set_next_item_width(-1)
    away = scope_path.off_path(state)
    pattern = "%.0f° (the camera is elsewhere)" if away else "%.0f°"
    changed, angle = imgui.slider_float("##angle", state.scope.angle, 0.0, 360.0, pattern)
    imgui.set_item_tooltip("where on its path the camera is; drag it, here or in the plots")
    return scope_path.scrubbed(state, angle) if changed else state


def _measuring(state: State) -> State:
    """Measure, or how far it has come and the way to stop it."""
    scope = state.scope
    if scope.running:
        cancelled = progress_bar.draw(scope.progress, "measure")
        return scope_path.cancelled(state) if cancelled else state
    if imgui.button("Measure again###measure"):
        state = scope_path.measured(state)
    imgui.set_item_tooltip("along the path that starts where the camera is now")
    if scope_path.off_path(state):
        imgui.same_line()
        if imgui.button("Back to the path"):
            state = scope_path.scrubbed(state, scope.angle)
    return state


def _plot(state: State, name: str, value: Callable[[Brightness], float], height: float) -> State:
    """One quantity against the angle, for the three modes."""
    if not plots.begin(f"##{name}", state.theme, height):
        return state
    axis = implot.AxisFlags_
    implot.setup_axes("", "", axis.lock.value, axis.lock.value)
    implot.setup_axis_limits(implot.ImAxis_.x1, 0.0, 360.0, implot.Cond_.always)
    implot.setup_axis_ticks(implot.ImAxis_.x1, list(map(float, TICKS)), [f"{t}°" for t in TICKS])
    curves, top = curves_of(state.scope.drawn, state.scope.exact, value)
    implot.setup_axis_limits(implot.ImAxis_.y1, 0.0, 1.1 * top, implot.Cond_.always)
    implot.setup_axis_format(implot.ImAxis_.y1, "%.2f")
    for mode, (angles, values) in curves.items():
        thick = mode in EXACT
        spec = plots.pen(state.theme, mode, 5.0 if thick else 1.5, 0.6 if thick else 1.0)
        implot.plot_line(mode, angles, values, spec)
    if not scope_path.off_path(state):
        colour = imgui.ImVec4(*PALETTES[state.theme].text, 0.8)
        moved, angle, *_ = implot.drag_line_x(GUIDE, state.scope.angle, colour, 1.0)
        state = scope_path.scrubbed(state, angle) if moved else state
    plots.end()
    return state


@kept_for_same(2 * len(CURVES))
def curves_of(
    drawn: Steps, exact: Steps, value: Callable[[Brightness], float]
) -> tuple[dict[str, Curve], float]:
    """The curve of each mode, and the largest value of all (1 where there is none)."""
    curves = {mode: curve(exact if mode in EXACT else drawn, mode, value) for mode in ORDER}
    return curves, max(float(values.max(initial=0.0)) for _, values in curves.values()) or 1.0


def curve(steps: Steps, mode: str, value: Callable[[Brightness], float]) -> Curve:
    """Angles and values of one mode, as the plot takes them."""
    angles = np.array([step.angle for step in steps], dtype=np.float64)
    return angles, np.array([value(step.modes[mode]) for step in steps], dtype=np.float64)


def _jumps(scope: Scope) -> None:
    """The largest change from one step to the next, of each mode."""
    flags = imgui.TableFlags_.row_bg.value | imgui.TableFlags_.borders_inner_h.value
    if not imgui.begin_table("jumps", 3, flags):
        return
    for title in ("largest jump", "brightest", "mean"):
        imgui.table_setup_column(title)
    imgui.table_headers_row()
    for mode, jump in _largest_jumps(scope.drawn, scope.exact).items():
        imgui.table_next_row()
        for text in (mode, f"{jump.peak:.4f}", f"{jump.mean:.5f}"):
            imgui.table_next_column()
            imgui.text(text)
    imgui.end_table()


@kept_for_same(2)
def _largest_jumps(drawn: Steps, exact: Steps) -> dict[str, Brightness]:
    named = dict.fromkeys(DRAWN, drawn) | dict.fromkeys(EXACT, exact)
    return {mode: largest_jump(steps, mode) for mode, steps in named.items()}
