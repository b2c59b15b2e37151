"""The curves of the race: what each solver has left, against its own time or its steps."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from imgui_bundle import imgui, implot

from playground.gui.radiosity.race_log import Lane, RaceLog
from playground.gui.radiosity.solver_colours import COLOURS
from playground.gui.same_object import kept_for_same
from playground.gui.widget import log_axis, plots
from playground.measure.solver_race import Lap
from playground.scene.settings import SOLVERS

HEIGHT = 15.0  # of the plot, in heights of the text
LEAST = 1e-12  # what is less is drawn here, so that it does not squeeze the others
Curve = tuple[np.ndarray, np.ndarray]


def draw(log: RaceLog, theme: str) -> None:
    """One curve for each solver; the light left and the steps on logarithmic axes."""
    if not plots.begin("##race", theme, HEIGHT * imgui.get_font_size()):
        return
    across = "seconds, each alone" if log.against == "time" else "steps: sweeps, shots"
    implot.setup_axes(across, log.drawn)
    curves = [(lane.solver, curve_of(lane.laps, log.against, log.drawn)) for lane in log.lanes]
    across_all, up = ([v for _, curve in curves for v in _ends(curve[i])] for i in (0, 1))
    if log.against == "time":  # most of it goes into rows: equal steps of time show that
        longest = 1.05 * max(across_all, default=1.0)
        implot.setup_axis_limits(implot.ImAxis_.x1, 0.0, longest, implot.Cond_.always)
    else:
        _axis(implot.ImAxis_.x1, across_all)
    _axis(implot.ImAxis_.y1, up)
    for solver, curve in curves:
        if len(curve[0]):
            spec = pen(theme, solver)
            implot.plot_line(solver, *curve, spec)
            spec.marker, spec.marker_size = implot.Marker_.circle, 3.5
            implot.plot_scatter(f"{solver} now", curve[0][-1:], curve[1][-1:], spec)
    plots.end()


def pen(theme: str, solver: str) -> implot.Spec:
    """How the curve of a solver is drawn."""
    colour = imgui.ImVec4(*COLOURS[theme][solver], 1.0)
    spec = implot.Spec()
    spec.line_color = spec.marker_line_color = spec.marker_fill_color = colour
    spec.line_weight = 2.0
    return spec


@kept_for_same(4 * len(SOLVERS))
def curve_of(laps: Sequence[Lap], against: str, drawn: str) -> Curve:
    """Places on both axes; the start, at no step and no time, has none on a logarithmic one."""
    some = [lap for lap in laps if lap.done > 0]
    x = [lap.seconds if against == "time" else lap.done for lap in some]
    y = [lap.left if drawn == "light left" else lap.error for lap in some]
    kept = [(a, max(b, LEAST)) for a, b in zip(x, y, strict=True) if a > 0.0 and b == b]
    table = np.array(kept, dtype=np.float64).reshape(-1, 2)
    return np.ascontiguousarray(table[:, 0]), np.ascontiguousarray(table[:, 1])


def steps_word(lane: Lane) -> str:
    """What the steps of a solver are called."""
    names = {"jacobi": "sweeps", "gauss-seidel": "sweeps", "conjugate-gradients": "iterations"}
    return names.get(lane.solver, "elimination" if lane.solver == "direct" else "shots")


def _ends(values: np.ndarray) -> list[float]:
    return [float(values.min()), float(values.max())] if len(values) else []


def _axis(axis: int, values: list[float]) -> None:
    low, high = log_axis.limits(values or [1e-3, 1.0])
    implot.setup_axis_scale(axis, implot.Scale_.log10)
    implot.setup_axis_limits(axis, low, high, implot.Cond_.always)
    ticks = log_axis.ticks(low, high)
    skip = max(1, -(-len(ticks) // 7))  # labels that do not run into each other
    ticks = [tick for i, tick in enumerate(reversed(ticks)) if i % skip == 0]
    implot.setup_axis_ticks(axis, ticks, [_word(tick) for tick in ticks])


def _word(tick: float) -> str:
    """Short enough to stand side by side: 10 k, 1e-5."""
    for size, letter in ((1e6, " M"), (1e3, " k")):
        if tick >= size:
            return f"{tick / size:g}{letter}"
    return f"{tick:g}".replace("e-0", "e-")
