"""What the scene needs: what each part contributes and costs, and a switch to drop it."""

from __future__ import annotations

from dataclasses import replace
from math import isnan

from imgui_bundle import imgui

from playground.gui.measure import needs_log
from playground.gui.measure.needs_log import Dropped
from playground.gui.measure.needs_run import SIZE
from playground.gui.measure.scope_path import shaders
from playground.gui.state import STORED, State
from playground.gui.widget import plots
from playground.gui.widget.theme import PALETTES
from playground.gui.widgets import Ui, edit
from playground.gui.work import progress_bar
from playground.measure.advice import Finding

TINT = 0.35  # how strongly a proposed row has the colour of what is chosen
NARROW = 3.6  # width of a column of numbers, in heights of the text


def draw(state: State, ui: Ui) -> State:
    """The budget, the measuring, what was proposed, and the list with its switches."""
    log = edit(ui, state.needs, only=("budget", "metric"))
    if log is not state.needs:
        state = replace(state, needs=log)
    state = _measuring(state)
    palette = PALETTES[state.theme]
    if log.error:
        plots.wrapped(log.error, palette.alarm)
    if not log.findings and log.advice is None:
        return state
    lacks = needs_log.dropped(state)
    if lacks is None:
        plots.wrapped("the setup has changed since: measure again", palette.alarm)
    elif needs_log.walked_away(state):
        plots.wrapped("measured from where the camera was", palette.faint)
    if log.advice is not None:
        plots.wrapped(log.advice.sentence(), palette.text)
    imgui.begin_disabled(lacks is None or log.running)
    state = _buttons(state, lacks)
    state = _table(state, lacks or needs_log.NOTHING)
    imgui.end_disabled()
    return state


def _measuring(state: State) -> State:
    """Measure, or how far it has come and the way to stop it."""
    log = state.needs
    if log.running:
        if progress_bar.draw(log.progress, "measure"):
            state = needs_log.cancelled(state)
        imgui.text_disabled(log.doing)
        return state
    if imgui.button("Measure###measure"):
        state = needs_log.asked(state)
    width, height = SIZE
    imgui.set_item_tooltip(
        f"draws the picture at {width}×{height} without each of its parts, some seconds long;\n"
        "the window goes on meanwhile"
    )
    if state.method in STORED:
        plots.wrapped(f"measured as rasterised, not by {state.method}", PALETTES[state.theme].faint)
    if shaders(state):
        plots.wrapped("the edited shaders do not take part", PALETTES[state.theme].faint)
    return state


def _buttons(state: State, lacks: Dropped | None) -> State:
    advice = state.needs.advice
    if advice is not None and advice.chosen:
        if imgui.button("Apply proposal"):
            state = needs_log.proposed(state)
        imgui.set_item_tooltip("drop what is tinted below, and nothing else")
        imgui.same_line()
    imgui.begin_disabled(not lacks)
    if imgui.button("Restore all"):
        state = needs_log.applied(state, needs_log.NOTHING)
    imgui.end_disabled()
    return state


def _table(state: State, lacks: Dropped) -> State:
    """One row per candidate; the tick drops it."""
    flags = imgui.TableFlags_.row_bg.value | imgui.TableFlags_.borders_inner_h.value
    if not imgui.begin_table("needs", 3, flags):
        return state
    metric = state.needs.advice.metric if state.needs.advice is not None else state.needs.metric
    wide = NARROW * imgui.get_font_size()
    fixed = imgui.TableColumnFlags_.width_fixed.value
    imgui.table_setup_column("drop", imgui.TableColumnFlags_.width_stretch.value)
    imgui.table_setup_column(metric.upper(), fixed, wide)
    imgui.table_setup_column("ms less", fixed, wide)
    imgui.table_headers_row()
    for finding in state.needs.findings:
        state = _row(state, finding, metric, lacks)
    imgui.end_table()
    return state


def _row(state: State, finding: Finding, metric: str, lacks: Dropped) -> State:
    candidate, saving = finding.candidate, finding.saving
    advice = state.needs.advice
    imgui.table_next_row()
    palette = PALETTES[state.theme]
    if advice is not None and finding in advice.chosen:
        tint = imgui.get_color_u32(imgui.ImVec4(*palette.accent, TINT))
        imgui.table_set_bg_color(imgui.TableBgTarget_.row_bg1, tint)
    imgui.table_next_column()
    on = candidate in lacks
    changed, now = imgui.checkbox(f"##{candidate.name}", on)
    if changed:
        state = needs_log.switched(state, candidate, now)
    imgui.same_line()
    plots.wrapped(candidate.name, palette.text)
    errors = finding.errors
    flip = "" if errors.flip is None else f", FLIP {errors.flip:.2g}"
    imgui.set_item_tooltip(
        f"without it: RMSE {errors.rmse:.2g}, max {errors.max:.2g}{flip},\n"
        f"{100 * errors.off:.2f} % of the 8-bit codes off by more than 1;\n"
        f"{saving.without:.3g} instead of {saving.full:.3g} ms a picture"
    )
    imgui.table_next_column()
    error = errors.of(metric)
    imgui.text("" if isnan(error) else f"{error:.2g}")
    imgui.table_next_column()
    imgui.text(f"{saving.saved:.2g}" if saving.saved else "none")
    imgui.set_item_tooltip(
        f"median of the differences {saving.median:.2g} ms, between {saving.low:.2g} and "
        f"{saving.high:.2g};\nup to {saving.floor:.2g} ms are noise"
    )
    return state
