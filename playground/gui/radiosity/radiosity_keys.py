"""What keys and menus do with stored light: choose its methods, and drive the solver."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

from playground.gui.action import Action, key
from playground.gui.actions import five_answers, toggle_method
from playground.gui.state import FIVE, LIGHTMAP, RADIOSITY, State


def play_or_pause(state: State) -> State:
    """Let the solver go on, or wait."""
    solving = replace(state.solving, playing=not state.solving.playing)
    word = "solving on" if solving.playing else "the solver waits"
    return replace(state, solving=solving).say(word)


def one_step(state: State) -> State:
    """One step of the solver, which waits after it."""
    return replace(state, solving=state.solving.stepped())


def from_the_beginning(state: State) -> State:
    """Solve anew."""
    return replace(state, solving=state.solving.restarted())


METHODS = tuple(
    Action(
        "Shading",
        name,
        letter.upper(),
        (key(letter),),
        partial(toggle_method, method=method),
        on=lambda state, method=method: state.method == method,  # type: ignore[misc]
    )
    for name, letter, method in (
        ("Radiosity, or back", "i", RADIOSITY),
        ("Lightmap, or back", "u", LIGHTMAP),
    )
)
SOLVER = (
    Action(
        "Radiosity",
        "Solve on, or wait",
        "K",
        (key("k"),),
        play_or_pause,
        on=lambda state: state.solving.playing,
    ),
    Action("Radiosity", "One step", "J", (key("j"),), one_step, repeats=True),
    Action("Radiosity", "Solve from the beginning", "Z", (key("z"),), from_the_beginning),
    Action(
        "Radiosity",
        "One scene, five answers",
        "5",
        (key("_5"), key("keypad5")),
        five_answers,
        on=lambda state: state.layout == FIVE,
    ),
)
