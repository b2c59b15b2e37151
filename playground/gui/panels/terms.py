"""The four terms of the sum: switches, weights, and the variants of the highlight."""

from __future__ import annotations

from dataclasses import replace

from imgui_bundle import imgui

from playground.gui.picture.formulas import formula
from playground.gui.state import State
from playground.gui.widgets import LABELS, Ui, attempt, bare, edit, tooltip
from playground.scene.knob import knobs
from playground.scene.settings import TERMS, Settings


def draw(state: State, ui: Ui) -> State:
    """One row per term, then the highlight."""
    settings = state.setup.settings
    for term in TERMS:
        settings = _term(settings, term, ui)
    settings = edit(ui, settings, only=("highlight", "gate"))
    if settings is state.setup.settings:
        return state
    return state.with_setup(replace(state.setup, settings=settings))


def _term(settings: Settings, term: str, ui: Ui) -> Settings:
    on = term in settings.terms
    _, now = imgui.checkbox(term, on)
    imgui.set_item_tooltip(f"{formula(term, settings.highlight)}\non or off: {term[0].upper()}")
    if now != on:
        chosen = {*settings.terms, term} if now else {*settings.terms} - {term}
        settings = attempt(ui, settings, "terms", tuple(t for t in TERMS if t in chosen))
    imgui.same_line(LABELS * imgui.get_font_size())
    imgui.set_next_item_width(-1)
    imgui.begin_disabled(not now)
    name = f"{term}_weight"
    knob = knobs(Settings)[name]
    settings = attempt(ui, settings, name, bare(knob, name, getattr(settings, name)))
    tooltip(knob)
    imgui.end_disabled()
    return settings
