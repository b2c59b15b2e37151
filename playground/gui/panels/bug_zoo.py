"""The bug zoo: classic mistakes to switch on, what they break, and a game of guessing."""

from __future__ import annotations

from dataclasses import replace
from difflib import ndiff
from functools import lru_cache

from imgui_bundle import imgui

from playground.gui import guess
from playground.gui.state import CHOSEN, RASTER, State
from playground.gui.widget import theme
from playground.gui.widget.plots import wrapped
from playground.gui.widgets import Ui, attempt, bare
from playground.render.gl.bugs import Bug, Edit, zoo
from playground.scene.knob import knobs
from playground.scene.settings import BUGS

Rgb = tuple[float, float, float]
GONE: dict[str, Rgb] = {"dark": (1.0, 0.56, 0.50), "light": (0.70, 0.08, 0.04)}
NEW: dict[str, Rgb] = {"dark": (0.52, 0.85, 0.56), "light": (0.05, 0.42, 0.14)}


def draw(state: State, ui: Ui) -> State:
    """The game if it is on, else the switches and the way into it."""
    _warn_if_drawn_right(state)
    if state.guess.number:
        return _game(state)
    state = _invitation(state, ui)
    imgui.separator()
    for bug in zoo().values():
        imgui.push_id(bug.name)
        state = _bug(state, bug, ui)
        imgui.pop_id()
    if state.setup.settings.bugs:
        imgui.separator()
        state = _peek(state)
        imgui.same_line()
        if imgui.button("All off"):
            state = _with_bugs(state, (), ui)
    return state


def _invitation(state: State, ui: Ui) -> State:
    if imgui.button("Guess the bug"):
        return guess.begin(_rasterised(state))
    imgui.set_item_tooltip("one of the mistakes is on, and you say which")
    knob = knobs(guess.Guess)["series"]
    imgui.same_line()
    imgui.text("series")
    imgui.same_line()
    imgui.set_next_item_width(-1)
    series = bare(knob, "series", state.guess.series)
    game = attempt(ui, state.guess, "series", series)
    return state if game is state.guess else replace(state, guess=game)


def _bug(state: State, bug: Bug, ui: Ui) -> State:
    """The switch of one mistake, what it breaks, and its edit of the shaders."""
    bugs = state.setup.settings.bugs
    on = bug.name in bugs
    _, now = imgui.checkbox(bug.title, on)
    if now != on:
        chosen = {*bugs} ^ {bug.name}
        state = _with_bugs(state, tuple(name for name in BUGS if name in chosen), ui)
    padding = imgui.get_style().frame_padding.x
    wide = imgui.calc_text_size("Show me").x + 2 * padding
    imgui.same_line(imgui.get_cursor_pos_x() + imgui.get_content_region_avail().x - wide)
    if imgui.small_button("Show me"):
        shown = guess.show(state.setup, bug.name)
        state = _rasterised(state).opened(shown).say(f"{bug.title}: {bug.breaks}")
    imgui.set_item_tooltip(f"opens the setup '{bug.look}' with this mistake on; Ctrl+Z comes back")
    indent = imgui.get_frame_height() + imgui.get_style().item_inner_spacing.x
    imgui.indent(indent)
    wrapped(bug.breaks, theme.PALETTES[state.theme].faint)
    if imgui.tree_node("in the shader"):
        imgui.unindent(indent)
        _edits(bug.edits, state.theme)
        imgui.indent(indent)
        imgui.tree_pop()
    imgui.unindent(indent)
    return state


def _with_bugs(state: State, bugs: tuple[str, ...], ui: Ui) -> State:
    settings = attempt(ui, state.setup.settings, "bugs", bugs)
    state = state.with_setup(replace(state.setup, settings=settings))
    return _rasterised(state) if bugs else state


def _rasterised(state: State) -> State:
    """The state whose first picture the rasteriser makes: only its shaders have the mistakes."""
    return replace(state, method=RASTER, first=CHOSEN)


def _warn_if_drawn_right(state: State) -> None:
    """A word where a mistake is on and the chosen method makes none."""
    if state.method != RASTER and (state.guess.number or state.setup.settings.bugs):
        words = f"The mistakes are in the shaders of the rasteriser; {state.method} makes none."
        wrapped(words, GONE[state.theme])


def _peek(state: State) -> State:
    """A button that shows the pictures without any mistake for as long as it is held."""
    imgui.button("Hold: drawn right")
    imgui.set_item_tooltip("shows the picture without the mistake while you hold the button")
    if imgui.is_item_active():
        return replace(state, guess=replace(state.guess, peek=True))
    return state


def _game(state: State) -> State:
    """The list to pick from, the verdict, and the way on."""
    game = state.guess
    imgui.text(f"Series {game.series}, riddle {game.number}")
    score = f"{game.solved} of {game.ended} at the first guess"
    end = imgui.get_cursor_pos_x() + imgui.get_content_region_avail().x
    imgui.same_line(end - imgui.calc_text_size(score).x)
    imgui.text_disabled(score)
    wrapped(
        "One of these mistakes is on. Turn the camera, move the lights, change the shading: "
        "which one is it?",
        theme.PALETTES[state.theme].text,
    )
    state = _choices(state)
    verdict = guess.why(state.guess)
    if verdict:
        imgui.spacing()
        wrapped(verdict, (NEW if state.guess.found else GONE)[state.theme])
    imgui.spacing()
    state = _ways_on(state)
    if state.guess.over and state.guess.number:
        _edits(zoo()[guess.answer(state.guess)].edits, state.theme)
    return state


def _choices(state: State) -> State:
    game = state.guess
    right = guess.answer(game) if game.over else ""
    for bug in zoo().values():
        mark = "✓ " if bug.name == right else "× " if bug.name in game.tried else ""
        imgui.begin_disabled((game.over and not mark) or bug.name in game.tried)
        if imgui.button(f"{mark}{bug.title}###{bug.name}", imgui.ImVec2(-1, 0)):
            state = guess.say_it_is(state, bug.name)
        imgui.end_disabled()
        imgui.set_item_tooltip(bug.breaks)
    return state


def _ways_on(state: State) -> State:
    if state.guess.over:
        if imgui.button("Next riddle###next"):
            return guess.proceed(state)
    elif imgui.button("Give up###next"):
        return guess.give_up(state)
    imgui.same_line()
    state = _peek(state)
    imgui.same_line()
    if imgui.button("End"):
        return guess.leave(state)
    return state


def _edits(edits: tuple[Edit, ...], colours: str) -> None:
    """What the mistake changes in the shader files: red goes, green comes."""
    for i, edit in enumerate(edits):
        if not i or edits[i - 1].file != edit.file:
            imgui.text_disabled(f"shaders/{edit.file}")
        theme.push_code_font()
        for line in changed_lines(edit):
            wrapped(line, (GONE if line[0] == "-" else NEW)[colours])
        imgui.pop_font()


@lru_cache(maxsize=64)
def changed_lines(edit: Edit) -> tuple[str, ...]:
    """The lines that go, with a minus before them, and those that come, with a plus."""
    lines = ndiff(edit.find.splitlines(), edit.replace.splitlines())
    return tuple(f"{line[0]} {' '.join(line[2:].split())}" for line in lines if line[0] in "+-")
