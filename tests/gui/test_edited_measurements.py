"""Shaders edited in the window are the ones that the popping scope and the speed plot measure."""

import pytest

from playground import locate
from playground.gui.measure import scope_path, scope_run, speed_log
from playground.gui.measure.scope_path import DRAWN
from playground.gui.measure.speed_log import EDITED
from playground.gui.shader.shader_edit import edited, reverted
from playground.measure.popping import along
from playground.render.gl.renderer import GLRenderer

pytestmark = pytest.mark.gl
FILE, ANGLES = "shade.glsl", (0.0, 10.0, 20.0)
GOOD = locate.shader(FILE).read_text(encoding="utf-8")
BRIGHT = GOOD.replace("diffuse = vec3(0.0);", "diffuse = vec3(0.25);")
BRIGHTER = GOOD.replace("diffuse = vec3(0.0);", "diffuse = vec3(0.5);")
BROKEN = GOOD.replace("diffuse = vec3(0.0);", "diffuse = oops;")


@pytest.fixture(params=["Popping scope", "Speed and error"])
def panel(request):
    return request.param


@pytest.fixture
def measuring(hands, panel, monkeypatch):
    """The window on the setup "popping" with one panel open, and what measures until it rests."""
    for module in (scope_path, scope_run):
        monkeypatch.setattr(module, "ANGLES", ANGLES)
    hands.load("popping")
    hands.do(lambda c: c.item_open(f"Controls/{panel}"))

    def typed(text):
        hands.window.state = edited(hands.state, FILE, text)
        hands.frames(3)
        hands.until(lambda: not hands.state.scope.running and hands.state.speed.of is None)

    yield typed
    hands.do(lambda c: c.item_close(f"Controls/{panel}"))


@pytest.mark.parametrize("panel", ["Popping scope"], indirect=True)
def test_the_scope_measures_the_edited_shaders(hands, measuring):
    measuring(GOOD)
    plain = hands.state.scope
    measuring(BRIGHT)
    scope = hands.state.scope
    with GLRenderer(scope_run.SIZE, hands.window.ctx) as renderer:
        renderer.overrides = {FILE: BRIGHT}
        expected = tuple(along(scope.of, ANGLES, dict.fromkeys(DRAWN, renderer)))
    assert scope.drawn == expected != plain.drawn
    assert scope.exact == plain.exact  # the reference has no shaders
    measuring(GOOD)
    assert hands.state.scope.drawn == plain.drawn


@pytest.mark.parametrize("panel", ["Popping scope"], indirect=True)
def test_the_scope_says_why_it_cannot_measure(hands, measuring):
    measuring(BROKEN)
    assert f"shaders/{FILE}:" in hands.state.scope.error and "oops" in hands.state.scope.error
    assert hands.state.scope.drawn == ()
    measuring(GOOD)
    assert not hands.state.scope.error and len(hands.state.scope.drawn) == len(ANGLES)


@pytest.mark.parametrize("panel", ["Speed and error"], indirect=True)
def test_the_speed_plot_has_one_dot_for_the_edited_shaders(hands, measuring):
    measuring(GOOD)
    (plain,) = hands.state.speed.dots
    measuring(BRIGHT)
    before, bright = hands.state.speed.dots
    assert before == plain and bright.setup == plain.setup + EDITED
    assert bright.rmse > plain.rmse + 0.05
    measuring(BRIGHTER)
    before, brighter = hands.state.speed.dots
    assert before == plain and brighter.rmse > bright.rmse + 0.05
    assert speed_log.present(hands.state) == brighter
    hands.window.state = reverted(hands.state)
    hands.frames(3)
    assert hands.state.speed.of is None and speed_log.present(hands.state) == plain


@pytest.mark.parametrize("panel", ["Speed and error"], indirect=True)
def test_the_speed_plot_waits_for_shaders_that_compile(hands, measuring):
    measuring(GOOD)
    measuring(BROKEN)
    assert hands.state.shader_error and len(hands.state.speed.dots) == 1
    assert hands.state.speed.automatic
    measuring(BRIGHT)
    assert len(hands.state.speed.dots) == 2 and not hands.state.speed.error
