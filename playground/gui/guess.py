"""Guess the bug: one mistake of the zoo is on, and its name is not told.

The mistake never enters the setup, so that neither the status line nor the history, a
saved file or a copied command can name it: `played` adds it where pictures are drawn.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache
from random import Random
from typing import TYPE_CHECKING

from playground.render.gl.bugs import zoo
from playground.scene.assign import assign, parse_light
from playground.scene.knob import Declared, integer
from playground.scene.library import load
from playground.scene.settings import BUGS, Settings
from playground.scene.setup import Setup

if TYPE_CHECKING:
    from playground.gui.state import State

# One scene in which each mistake shows: few triangles, unequal scale, a point light, sRGB.
SCENE, LIGHT = "stretched", "point position=-2,2.6,3.2 diffuse=.8,.8,.8 ambient=.2,.2,.2"
CHANGES = (
    "object.0.mesh=icosphere",
    "object.0.tessellation=1",
    "object.0.transform.scale=1,1,1",
    "object.0.material.diffuse=.4,.3,.1",
    "object.0.material.specular=.8,.8,.8",
    "object.0.material.shininess=12",
    "object.1.transform.scale=1.1,0.3,0.9",
    "camera.eye=2.6,1.6,7.4",
    "camera.target=0.1,0,0",
    "background=.02,.02,.025",
    "curve=srgb",
)


@dataclass(frozen=True)
class Guess(Declared):
    """The game: which riddle of which series is on, what has been guessed, the score.

    ``number`` is 0 while nobody plays. The same ``series`` has the same riddles in the same
    order, so that a class can play one together. ``peek`` shows the pictures without
    any mistake, for as long as a button is held.
    """

    label = "game"

    series: int = integer(1, 1, 999, help="the same series has the same riddles, for everyone")
    number: int = 0
    tried: tuple[str, ...] = ()  # wrong guesses at this riddle
    over: bool = False  # found or given up: the name may be told
    found: bool = False
    solved: int = 0  # riddles found at the first guess
    ended: int = 0  # riddles found or given up
    peek: bool = False


@lru_cache(maxsize=64)
def answer(game: Guess) -> str:
    """The name of the mistake that is on; never the same twice running."""
    last = ""
    for number in range(1, game.number + 1):
        others = [name for name in BUGS if name != last]
        last = Random(f"{game.series}.{number}").choice(others)
    return last


def puzzle() -> Setup:
    """The scene of every riddle, drawn right."""
    setup = load(SCENE).with_(lights=(parse_light(LIGHT),), name="riddle")
    for change in CHANGES:
        setup = assign(setup, change)
    return setup


def begin(state: State) -> State:
    """The first riddle of the series; undo leads back to the setup that was there."""
    game = Guess(series=state.guess.series, number=1)
    state = replace(state.opened(puzzle()), guess=game)
    return state.say("one mistake is on: which? turn the camera, change what you like")


def proceed(state: State) -> State:
    """The next riddle, in the scene as it stands."""
    game = state.guess
    after = replace(game, number=game.number + 1, tried=(), over=False, found=False)
    return replace(state, guess=after).say(f"riddle {after.number}")


def leave(state: State) -> State:
    """End the game; the series that was played is over, the next one waits."""
    series = state.guess.series % 999 + 1
    return replace(state, guess=Guess(series=series)).say("the game is over")


def say_it_is(state: State, name: str) -> State:
    """The student's guess."""
    game = state.guess
    if game.number == 0 or game.over or name in game.tried:
        return state
    if name != answer(game):
        return replace(state, guess=replace(game, tried=(*game.tried, name))).say("not this one")
    solved = game.solved + (not game.tried)
    done = replace(game, over=True, found=True, solved=solved, ended=game.ended + 1)
    return replace(state, guess=done).say("right")


def give_up(state: State) -> State:
    """Be told the answer."""
    game = state.guess
    if game.number == 0 or game.over:
        return state
    return replace(state, guess=replace(game, over=True, ended=game.ended + 1)).say("given up")


def why(game: Guess) -> str:
    """What the student is told after the last guess; names the answer only when it is over."""
    bugs = zoo()
    if game.over:
        bug = bugs[answer(game)]
        return f"{'Right' if game.found else 'It was'}: {bug.title}. {bug.breaks}"
    if game.tried:
        wrong = bugs[game.tried[-1]]
        return f"Not this one. {wrong.title} looks different. {wrong.breaks}"
    return ""


def show(setup: Setup, name: str) -> Setup:
    """Where the bug ``name`` shows best, with the bug on; ``setup`` lends its anti-aliasing."""
    bug = zoo()[name]
    shown = load(bug.look)
    for change in bug.set:
        shown = assign(shown, change)
    return shown.with_(bugs=(name,), samples=setup.settings.samples)


def masked(state: State, error: str) -> str:
    """The message of an error, unless it would tell which mistake is on."""
    secret = bool(state.guess.number) and not state.guess.over
    if secret and any(name in error for name in BUGS):
        return "this edit and the mistake that is on do not go together"
    return error


def unpeeked(state: State) -> State:
    """The state at the beginning of a frame: who still holds the button will say so again."""
    return replace(state, guess=replace(state.guess, peek=False)) if state.guess.peek else state


def played(state: State, setup: Setup) -> Setup:
    """``setup`` as the game wants it drawn: with the hidden mistake, or with none to compare."""
    game = state.guess
    bugs = set(setup.settings.bugs)
    if game.number:
        bugs.add(answer(game))
    wanted = () if game.peek else tuple(name for name in BUGS if name in bugs)
    if wanted == setup.settings.bugs:
        return setup
    return replace(setup, settings=_with(setup.settings, wanted))


# The same settings give the same object again: renderers notice change by identity.
@lru_cache(maxsize=64)
def _with(settings: Settings, bugs: tuple[str, ...]) -> Settings:
    return replace(settings, bugs=bugs)
