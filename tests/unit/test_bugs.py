"""The bug zoo: each mistake compiles, shows where it says, and leaves the rest alone."""

import numpy as np
import pytest

import playground as pg
from playground.render.gl.bugs import with_bugs, zoo
from playground.scene.assign import assign
from playground.scene.settings import BUGS

SIZE = (96, 72)


def test_the_zoo_and_the_knob_name_the_same_bugs():
    assert tuple(zoo()) == BUGS
    for bug in zoo().values():
        assert bug.title
        assert bug.breaks.endswith(".")
        assert bug.look in pg.library()


@pytest.mark.gl
@pytest.mark.parametrize("name", BUGS)
def test_each_bug_shows_in_its_setup(gl, name):
    setup = pg.load(zoo()[name].look)
    for assignment in zoo()[name].set:
        setup = assign(setup, assignment)
    right, wrong = np.empty((2, SIZE[1], SIZE[0], 4), np.uint8)
    with pg.open_renderer(SIZE, "gl") as renderer:
        renderer.render(setup, out=right)
        renderer.render(setup.with_(bugs=(name,)), out=wrong)
        again = renderer.render(setup, out=np.empty_like(right))
    assert np.array_equal(right, again)
    off = np.abs(right.astype(int) - wrong).max(axis=-1)
    assert off.max() >= 20, "nobody would see it"


@pytest.mark.gl
@pytest.mark.parametrize("shading", pg.Shading)
@pytest.mark.parametrize("name", pg.library())
def test_all_bugs_at_once_still_compile(gl, name, shading):
    setup = pg.load(name).with_(bugs=BUGS, curve="srgb", shading=shading)
    out = np.empty((SIZE[1], SIZE[0], 4), np.uint8)
    with pg.open_renderer(SIZE, "gl") as renderer:
        renderer.render(setup, out=out)


@pytest.mark.gl
def test_the_light_that_follows_the_camera(gl):
    """With the bug, orbiting around a ball leaves its picture as it was."""
    setup = pg.load("sphere").with_(
        mesh="icosphere", tessellation=48, bugs=("light-in-wrong-space",)
    )
    setup = setup.with_(lights=(pg.DirectionalLight(to_light=(0, 1, 1)),))
    views = [setup.with_(eye=(3.4 * np.sin(a), 0, 3.4 * np.cos(a))) for a in (0.0, 1.0)]
    first, second = (pg.render(view, SIZE, "gl").pixels for view in views)
    rightly = [pg.render(view.with_(bugs=()), SIZE, "gl").pixels for view in views]
    assert np.abs(rightly[0] - rightly[1]).max() > 0.3
    assert np.abs(first - second).mean() < np.abs(rightly[0] - rightly[1]).mean() / 2


def test_the_reference_makes_no_mistakes():
    with pytest.raises(pg.PlaygroundError, match="renderer gl"):
        pg.render(pg.load("sphere").with_(bugs=("missing-max",)), SIZE, "numpy")


def test_a_drifted_edit_is_noticed():
    with pytest.raises(ValueError, match="does not find"):
        with_bugs("phong.frag", "void main() {}", ("normal-not-renormalised",))
