"""Radiosity: its knobs, the solver's controls, how far it is, what it keeps and leaves out."""

from __future__ import annotations

from dataclasses import replace

from imgui_bundle import imgui

from playground.gui.radiosity.radiosity_keys import from_the_beginning, play_or_pause
from playground.gui.radiosity.radiosity_told import RadiosityTold
from playground.gui.radiosity.solving import Solving
from playground.gui.shortcuts import keys_of
from playground.gui.state import FIVE, LIGHTMAP, RADIOSITY, State
from playground.gui.widget import plots
from playground.gui.widget.theme import PALETTES
from playground.gui.widgets import Ui, edit, tooltip
from playground.scene.knob import knobs
from playground.scene.settings import Shading

WORK = ("patches", "refinement", "form_factors", "hemicube", "occlusion", "normalise")
SOLVING = ("solver", "convergence", "light_shown")


def draw(state: State, ui: Ui) -> State:
    """What is solved and how, then the solver at work, then what is shown of it."""
    settings = edit(ui, state.setup.settings, only=(*WORK, *SOLVING))
    if settings is not state.setup.settings:
        state = state.with_setup(replace(state.setup, settings=settings))
    imgui.separator_text("solution")
    state = _buttons(state)
    _progress(state, ui.radiosity)
    imgui.separator_text("shown")
    state = _flat(state)
    solving = _shown(state.solving, ui)
    if solving is not state.solving:
        state = replace(state, solving=solving)
    if ui.radiosity.laws:
        _checks(state, ui.radiosity)
    return _lightmap(state, ui)


def _buttons(state: State) -> State:
    """Play, pause, step, restart."""
    if imgui.button("Pause###play" if state.solving.playing else "Play###play"):
        state = play_or_pause(state)
    imgui.set_item_tooltip(f"solve on, or wait ({keys_of('Solve on, or wait')})")
    imgui.same_line()
    imgui.push_item_flag(imgui.ItemFlags_.button_repeat.value, True)
    if imgui.button("Step"):
        state = replace(state, solving=state.solving.stepped())
    imgui.pop_item_flag()
    imgui.set_item_tooltip(
        f"one step of the solver, then wait; hold it for more ({keys_of('One step')})"
    )
    imgui.same_line()
    if imgui.button("Restart"):
        state = from_the_beginning(state)
    imgui.set_item_tooltip(
        "solve from the beginning; form factors that still hold stay "
        f"({keys_of('Solve from the beginning')})"
    )
    return state


def _progress(state: State, told: RadiosityTold) -> None:
    """How far it is, who shoots, where the light has gone."""
    palette = PALETTES[state.theme]
    if not told.on:
        if RADIOSITY not in (state.method, state.other) and state.layout != FIVE:
            imgui.text_disabled(f"choose radiosity in View, or press {_key()}")
        return
    if told.error:
        plots.wrapped(told.error, palette.alarm)
        return
    imgui.progress_bar(told.share, imgui.ImVec2(-1.0, 0.4 * imgui.get_font_size()), "")
    for line in (told.left, told.shooter, told.energy):
        if line:
            plots.wrapped(line, palette.faint)


def _checks(state: State, told: RadiosityTold) -> None:
    """Which laws the form factors keep, and what is left out."""
    palette = PALETTES[state.theme]
    imgui.separator_text("form factors")
    for line in told.laws:
        plots.wrapped(line, palette.faint)
    if told.warnings:
        imgui.text_disabled("not modelled")
    for warning in told.warnings:
        plots.wrapped(warning, palette.alarm)


def _key() -> str:
    return keys_of("Radiosity, or back")


def _flat(state: State) -> State:
    """Each patch in one colour, which is the shading flat, or smooth."""
    settings = state.setup.settings
    flat = settings.shading == Shading.FLAT
    _, now = imgui.checkbox("flat patches", flat)
    imgui.set_item_tooltip("each patch in its one colour, as it was computed (shading: flat)")
    if now == flat:
        return state
    shading = Shading.FLAT if now else Shading.PER_FRAGMENT
    settings = replace(settings, shading=shading.value)
    return state.with_setup(replace(state.setup, settings=settings))


def _shown(solving: Solving, ui: Ui) -> Solving:
    """Outlines, the patches that shoot, and the light by bounces."""
    for name, words in (
        ("outlines", "outlines of the patches"),
        ("shooter", "mark who shoots"),
        ("by_bounce", "by bounce"),
    ):
        on = bool(getattr(solving, name))
        _, now = imgui.checkbox(words, on)
        tooltip(knobs(Solving)[name])
        if now != on:
            solving = replace(solving, **{name: now})
    return edit(ui, solving, only=("bounces",)) if solving.by_bounce else solving


def _lightmap(state: State, ui: Ui) -> State:
    """Which file the method lightmap draws with."""
    imgui.separator_text(LIGHTMAP)
    scene = edit(ui, state.setup.scene, only=("lightmap",))
    if scene is not state.setup.scene:
        state = state.with_setup(replace(state.setup, scene=scene))
    return state
