"""The race of the solvers: curves drawn while they run, their times and rows, and their books."""

from __future__ import annotations

from dataclasses import replace

from imgui_bundle import imgui

from playground.gui.radiosity import energy_bars, race_log, race_plot
from playground.gui.radiosity.race_log import Lane, RaceLog
from playground.gui.radiosity.solver_colours import COLOURS
from playground.gui.state import State
from playground.gui.widget import plots
from playground.gui.widget.theme import PALETTES
from playground.gui.widgets import Ui, edit
from playground.gui.work import progress_bar
from playground.measure.solver_race import MOST_PATCHES
from playground.scene.settings import SOLVERS

KNOBS = ("goal", "against", "drawn")
ENERGY = ("books_of", "channel")
NAMES = ("emitted", "absorbed", "escaped", "unshot")
TITLES = (("solver", 0.0), ("steps", 3.5), ("time", 3.5), ("rows", 2.7), ("left", 3.5))
MANY = 100_000  # steps that are told in thousands


def draw(state: State, ui: Ui) -> State:
    """Who runs, the race, its curves, and the energy of one solver."""
    state = _table(state)
    log = edit(ui, state.race, only=KNOBS)
    state = replace(state, race=log) if log is not state.race else state
    state = _racing(state)
    log, palette = state.race, PALETTES[state.theme]
    if log.error:
        plots.wrapped(log.error, palette.alarm)
    if not log.lanes:
        return state
    if race_log.outdated(state):
        plots.wrapped("the setup has changed since: race again", palette.alarm)
    if log.patches:
        imgui.text_disabled(f"{log.patches:,} patches, the same rows for all")
    race_plot.draw(log, state.theme)
    for lane in log.lanes:
        if lane.error:
            plots.wrapped(f"{lane.solver}: {lane.error}", palette.alarm)
    imgui.separator_text("where the light of one of them has gone")
    log = edit(ui, log, only=ENERGY)
    _energy(log, state.theme)
    return replace(state, race=log) if log is not state.race else state


def _racing(state: State) -> State:
    """Race, or how far the slowest has come and the way to stop it."""
    log = state.race
    if log.running:
        return race_log.cancelled(state) if progress_bar.draw(log.progress, "race") else state
    imgui.begin_disabled(not log.solvers)
    if imgui.button("Race###race"):
        state = race_log.started(state)
    imgui.end_disabled()
    imgui.set_item_tooltip(
        f"on the setup as it is, with at most {MOST_PATCHES:,} patches and without refinement,\n"
        "in a process beside the window. Rows of form factors are computed once; each\n"
        "solver is charged with those that it asks for, so that its time is what it would\n"
        "take alone"
    )
    if any(lane.laps for lane in log.lanes):
        imgui.same_line()
        if imgui.button("Copy as CSV"):
            imgui.set_clipboard_text(log.to_csv())
            state = state.say("the table is copied")
    return state


def _table(state: State) -> State:
    """A row per solver: whether it takes part, steps, time, rows, light left."""
    flags = imgui.TableFlags_.row_bg.value | imgui.TableFlags_.borders_inner_h.value
    if not imgui.begin_table("lanes", len(TITLES), flags):
        return state
    log = state.race
    fixed, free = imgui.TableColumnFlags_.width_fixed, imgui.TableColumnFlags_.width_stretch
    for title, wide in TITLES:
        title = "error" if title == "left" and log.drawn == "error" else title
        kind = fixed if wide else free
        imgui.table_setup_column(title, kind.value, wide * imgui.get_font_size())
    imgui.table_headers_row()
    for solver in SOLVERS:
        imgui.table_next_row()
        imgui.table_next_column()
        log = _runner(log, solver, state.theme)
        for text in _numbers(log.lane(solver), log):
            imgui.table_next_column()
            imgui.text(text)
    imgui.end_table()
    return replace(state, race=log) if log is not state.race else state


def _runner(log: RaceLog, solver: str, theme: str) -> RaceLog:
    """The tick of a solver in the colour of its curve, and its name, broken where it is long."""
    colour = imgui.ImVec4(*COLOURS[theme][solver], 1.0)
    imgui.push_style_color(imgui.Col_.check_mark, colour)
    imgui.push_style_color(imgui.Col_.border, colour)
    changed, on = imgui.checkbox(f"##{solver}", solver in log.solvers)
    imgui.pop_style_color(2)
    if changed:
        chosen = {*log.solvers, solver} if on else {*log.solvers} - {solver}
        log = replace(log, solvers=tuple(name for name in SOLVERS if name in chosen))
    imgui.set_item_tooltip("takes part in the next race")
    imgui.same_line()
    wide = imgui.calc_text_size(solver).x > imgui.get_content_region_avail().x
    imgui.text(solver.replace("-", "-\n") if wide else solver)
    imgui.set_item_tooltip(_told(log.lane(solver), log))
    return log


def _numbers(lane: Lane | None, log: RaceLog) -> tuple[str, ...]:
    if lane is None or not lane.laps:
        return ("",) * 4
    last = lane.laps[-1]
    value = last.left if log.drawn == "light left" else last.error
    return _count(last.done), _time(last.seconds), f"{last.rows:,}", _power(value)


def _count(steps: int) -> str:
    return f"{steps:,}" if steps < MANY else f"{steps / 1000:,.0f} k"


def _power(value: float) -> str:
    """As "3.2e-7"."""
    return f"{value:.1e}".replace("e-0", "e-").replace("e+00", "")


def _time(seconds: float) -> str:
    return f"{1e3 * seconds:.0f} ms" if seconds < 1.0 else f"{seconds:.2f} s"


def _told(lane: Lane | None, log: RaceLog) -> str:
    """How it stands with a solver, in words."""
    if lane is None:
        return "did not run"
    if lane.error:
        return lane.error
    if not lane.laps:
        return "has not begun"
    last, word = lane.laps[-1], race_plot.steps_word(lane)
    state = "has arrived" if lane.ended else "is on its way" if log.running else "was stopped"
    return f"{state}: {last.done:,} {word}, error {last.error:.2g} against elimination"


def _energy(log: RaceLog, theme: str) -> None:
    """The books of the chosen solver."""
    lane = log.lane(log.books_of)
    if lane is None or not lane.laps:
        imgui.text_disabled(f"{log.books_of} did not run")
        return
    energy_bars.draw(lane.laps, log.channel, theme)
    last = lane.laps[-1]
    parts = {name: energy_bars.share_of(getattr(last, name), log.channel) for name in NAMES}
    whole = parts["emitted"] or 1.0
    shares = ", ".join(f"{100.0 * parts[x] / whole:.3g} % {x}" for x in NAMES[1:])
    plots.wrapped(f"after {last.done:,}: {shares}", PALETTES[theme].text)
    worst = energy_bars.worst_imbalance(lane.laps)
    plots.wrapped(
        f"imbalance: {last.imbalance:.1e} of all light now, {worst:.1e} at most",
        PALETTES[theme].text,
    )
    imgui.set_item_tooltip(
        "|emitted − absorbed − escaped − unshot| of the worst channel; each is computed by\n"
        "itself, so that this is a test: rounding alone is about 1e-15"
    )
