"""The bug zoo: its switches, and a game that does not tell."""

from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest

from playground.gui import actions, guess, status
from playground.gui.picture.comparison import pictures
from playground.gui.state import shown, start
from playground.measure.metrics import rmse
from playground.render.gl.bugs import zoo
from playground.scene.library import load
from playground.scene.settings import BUGS
from playground.scene.setup_file import format_setup


def playing(series=1):
    state = start(load("teapot"))
    return guess.begin(replace(state, guess=replace(state.guess, series=series)))


def wrong(state):
    return next(name for name in BUGS if name != guess.answer(state.guess))


def test_the_same_series_has_the_same_riddles_and_another_has_others():
    def series(number):
        return [guess.answer(guess.Guess(series=number, number=i)) for i in range(1, 9)]

    assert series(7) == series(7)
    assert len({tuple(series(number)) for number in range(1, 20)}) > 10
    asked = [name for number in range(1, 20) for name in series(number)]
    assert set(asked) == set(BUGS)
    assert all(a != b for a, b in zip(series(3), series(3)[1:], strict=False))
    assert guess.answer(guess.Guess()) == ""


def test_nothing_but_the_pictures_shows_the_answer():
    state = playing()
    name = guess.answer(state.guess)
    bug = zoo()[name]
    assert state.setup.settings.bugs == shown(state).settings.bugs == ()
    assert pictures(state, 400, 300)[0].setup.settings.bugs == (name,)
    for step in (lambda s: s, guess.proceed, lambda s: guess.say_it_is(s, wrong(s))):
        state = step(state)
        texts = (
            state.message,
            state.setup.name,
            status.described(state.setup),
            format_setup(state.setup),
        )
        for text in texts:
            assert not any(n in text or zoo()[n].title in text for n in BUGS), text
    assert bug.title not in guess.why(playing().guess)


def test_a_wrong_guess_is_told_why_and_costs_the_point():
    state = playing()
    name = wrong(state)
    state = guess.say_it_is(state, name)
    assert state.guess.tried == (name,) and not state.guess.over
    assert zoo()[name].breaks in guess.why(state.guess)
    assert guess.say_it_is(state, name) is state
    state = guess.say_it_is(state, guess.answer(state.guess))
    assert state.guess.found and state.guess.over
    assert (state.guess.solved, state.guess.ended) == (0, 1)
    assert guess.why(state.guess).startswith("Right")


def test_a_right_guess_counts_and_giving_up_tells():
    state = playing(5)
    state = guess.say_it_is(state, guess.answer(state.guess))
    assert (state.guess.solved, state.guess.ended) == (1, 1)
    assert guess.give_up(state) is state
    state = guess.give_up(guess.proceed(state))
    assert (state.guess.solved, state.guess.ended, state.guess.number) == (1, 2, 2)
    assert zoo()[guess.answer(state.guess)].title in guess.why(state.guess)
    state = guess.leave(state)
    assert state.guess == guess.Guess(series=6)
    assert pictures(state, 400, 300)[0].setup.settings.bugs == ()


def test_what_is_opened_next_has_no_hidden_mistake():
    state = playing(5).opened(load("sphere"))
    assert state.guess == guess.Guess(series=5)
    assert pictures(state, 400, 300)[0].setup.settings.bugs == ()


def test_a_shader_error_does_not_tell_either():
    state = playing()
    error = f"shaders/shade.glsl: bug '{guess.answer(state.guess)}' does not find 'x'"
    assert guess.answer(state.guess) not in guess.masked(state, error)
    assert guess.masked(state, "shade.glsl:3: syntax error") == "shade.glsl:3: syntax error"
    assert guess.masked(guess.give_up(state), error) == error


def test_peeking_shows_the_picture_drawn_right_for_one_frame():
    state = playing()
    state = replace(state, guess=replace(state.guess, peek=True))
    assert pictures(state, 400, 300)[0].setup.settings.bugs == ()
    state = guess.unpeeked(state)
    assert pictures(state, 400, 300)[0].setup.settings.bugs
    settings = [pictures(state, 400, 300)[0].setup.settings for _ in range(2)]
    assert settings[0] is settings[1]  # renderers notice change by identity


@pytest.mark.gl
@pytest.mark.parametrize("name", BUGS)
def test_every_mistake_shows_in_the_riddle(gl_context, name):
    from playground.render.gl.renderer import GLRenderer

    setup, codes = guess.puzzle(), np.empty((2, 180, 240, 4), np.uint8)
    with GLRenderer((240, 180), gl_context) as renderer:
        renderer.render(setup, out=codes[0])
        renderer.render(setup.with_(bugs=(name,)), out=codes[1])
    assert rmse(*codes[..., :3].astype(float)) > 1.5  # 8-bit codes, over the whole picture


@pytest.mark.gl
@pytest.mark.parametrize("pair", list(combinations(BUGS, 2)), ids="+".join)
def test_any_two_mistakes_can_be_on_together(gl_context, pair):
    from playground.render.gl.renderer import GLRenderer

    with GLRenderer((32, 24), gl_context) as renderer:
        renderer.render(guess.puzzle().with_(bugs=pair))


@pytest.mark.gl
def test_a_switch_makes_the_mistake_and_undo_takes_it_back(hands):
    right = hands.pixels()
    open_panel(hands, lambda c: c.item_check(f"{PANEL}/missing-max/{zoo()['missing-max'].title}"))
    assert hands.state.setup.settings.bugs == ("missing-max",)
    assert rmse(hands.pixels(), right) > 1.0
    hands.window.state = actions.undo(hands.window.state)
    hands.frames(2)
    assert hands.state.setup == hands.state.loaded
    np.testing.assert_array_equal(hands.pixels(), right)


@pytest.mark.gl
def test_show_me_opens_where_it_shows_and_can_be_undone(hands):
    before = hands.state.setup
    open_panel(hands, lambda c: c.item_click(f"{PANEL}/wrong-normal-matrix/Show me"))
    assert hands.state.setup.settings.bugs == ("wrong-normal-matrix",)
    assert hands.state.setup.name == "stretched"
    hands.window.state = actions.undo(hands.window.state)
    assert hands.state.setup == before


@pytest.mark.gl
def test_the_game_is_played_with_the_mouse(hands, window):
    open_panel(hands, lambda c: c.item_click(f"{PANEL}/Guess the bug"))
    assert hands.state.guess.number == 1
    title = window.wnd.title
    assert not any(bug.title in title for bug in zoo().values())
    name = guess.answer(hands.state.guess)
    seen = hands.pixels()
    size = (seen.shape[1], seen.shape[0])
    np.testing.assert_array_equal(seen, hands.expected(size, bugs=(name,)))
    hands.do(lambda c: c.item_click(f"{PANEL}/###{wrong(hands.state)}"))
    assert hands.state.guess.tried and not hands.state.guess.over
    hands.do(lambda c: c.item_click(f"{PANEL}/###{name}"))
    assert hands.state.guess.found
    hands.do(lambda c: c.item_click(f"{PANEL}/###next"))
    assert hands.state.guess.number == 2
    hands.do(lambda c: c.item_click(f"{PANEL}/###next"))
    assert hands.state.guess.over and not hands.state.guess.found
    hands.do(lambda c: c.item_click(f"{PANEL}/End"))
    assert hands.state.guess.number == 0


PANEL = "//Controls/Bug zoo"


def open_panel(hands, deed):
    def script(context):
        context.item_open("//Controls/Bug zoo")
        deed(context)

    hands.do(script)


@pytest.mark.gl
@pytest.mark.parametrize("deed", ["Guess the bug", "missing-max/max(0, ·) forgotten"])
def test_what_makes_no_mistakes_gives_way_to_the_rasteriser(hands, deed):
    hands.load("stretched")
    hands.window.state = replace(hands.state, method="ray-tracing", first="reference")
    open_panel(hands, lambda c: c.item_click(f"{PANEL}/{deed}"))
    state = hands.state
    assert state.guess.number or state.setup.settings.bugs == ("missing-max",)
    assert (state.method, state.first) == ("raster", "as chosen")
    wrong = hands.pixels()
    hands.window.state = replace(state, guess=guess.Guess(), setup=state.setup.with_(bugs=()))
    hands.frames(2)
    assert rmse(wrong, hands.pixels()) > 0.0  # the rasteriser makes the mistake
    hands.window.state = state
    hands.key("z", "ctrl")
    assert hands.state.method == "ray-tracing" and hands.state.setup.name == "stretched"
