"""Pictures by any two methods beside each other, five answers to one scene, and what is kept."""

from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest
from test_radiosity_window import Solved, size_of

from playground.gui import actions
from playground.gui.command_line import command_line
from playground.gui.memory import recall, recalled, remember
from playground.gui.picture import path_picture
from playground.gui.picture.comparison import boxes, pictures
from playground.gui.picture.difference import differ
from playground.gui.picture.orbit import widened
from playground.gui.picture.path_picture import sampled
from playground.gui.radiosity.radiosity_keys import METHODS
from playground.gui.state import (
    CHOSEN,
    FIVE,
    LIGHTMAP,
    PATHS,
    RADIOSITY,
    RASTER,
    REFERENCE,
    TRACED,
    start,
)
from playground.render.trace.path import PathTracing
from playground.scene.library import load
from playground.scene.settings import Shading

SHADINGS = tuple(mode.value for mode in Shading)
MODES = (*SHADINGS, REFERENCE, TRACED, RADIOSITY, LIGHTMAP, PATHS)
CAPTION, GAP, LEGEND = 40, 4, np.s_[-150:, -330:]


def by(state, mode):
    """The state whose first picture is made in this way."""
    if mode in (REFERENCE, PATHS):
        return replace(state, first=mode)
    return actions._made_by(state, mode)


class TestState:
    @pytest.mark.parametrize(("one", "other"), [*combinations(MODES, 2)])
    def test_any_two_are_compared(self, one, other):
        for mode, beside in ((one, other), (other, one)):
            state = replace(start(load("cornell-box")), layout="wipe", other=beside)
            a, b = pictures(by(state, mode), 300, 200)
            assert (a.caption, b.caption) == (mode, beside)
            kinds = [(p.reference, p.traced, p.stored, p.paths) for p in (a, b)]
            names = [(x == REFERENCE, x == TRACED, x, x == PATHS) for x in (mode, beside)]
            for kind, name in zip(kinds, names, strict=True):
                stored = name[2] if name[2] in (RADIOSITY, LIGHTMAP) else ""
                assert kind == (name[0], name[1], stored, name[3])

    @pytest.mark.parametrize("other", MODES)
    def test_two_pictures_never_show_the_same(self, other):
        state = replace(start(load("cornell-box")), layout="wipe")
        state = actions.kept_apart(state, replace(state, other=other))
        changes = [
            *(action.do for action in METHODS),
            *(lambda s, mode=mode: actions.shade(s, mode) for mode in SHADINGS),
            *(lambda s, f=f: actions.kept_apart(s, replace(s, first=f)) for f in (PATHS, CHOSEN)),
            *(lambda s, o=o: actions.kept_apart(s, replace(s, other=o)) for o in MODES),
        ]
        for change in changes:
            state = change(state)
            a, b = pictures(state, 300, 200)
            assert a.caption != b.caption

    def test_a_key_chooses_the_method_and_takes_it_back(self):
        for action, method in zip(METHODS, (RADIOSITY, LIGHTMAP), strict=True):
            state = action.do(start(load("teapot")))
            assert state.method == method and action.on(state)
            assert action.do(state).method == RASTER

    def test_the_method_is_undone(self):
        state = start(load("cornell-box"))
        solved = actions.toggle_method(state, RADIOSITY)
        kept = solved.history.record(state.moment, solved.moment, held=False)
        assert actions.undo(replace(solved, history=kept)).method == RASTER

    def test_the_command_line_says_the_method_and_the_knobs(self):
        base = load("cornell-box")
        setup = base.with_(patches=250, solver="jacobi")
        words = command_line(setup, "cornell-box", base, RADIOSITY)
        assert "--method radiosity" in words
        assert "settings.patches=250" in words and "settings.solver=jacobi" in words

    def test_method_and_knobs_are_remembered(self, tmp_path):
        setup = load("cornell-box").with_(patches=250)
        state = replace(start(setup), method=RADIOSITY, layout=FIVE)
        remember(state, (800, 600), tmp_path / "window.json")
        memory = recall(tmp_path / "window.json")
        again = recalled(start(memory.setup), memory)
        assert (again.method, again.layout) == (RADIOSITY, FIVE)
        assert again.setup.settings == setup.settings

    def test_stored_light_makes_no_mistakes(self):
        setup = load("teapot").with_(bugs=("missing-max",))
        state = replace(start(setup), method=RADIOSITY)
        assert pictures(state, 300, 200)[0].setup.settings.bugs == ()

    def test_a_pixel_of_stored_light_is_not_explained_by_the_local_model(self):
        from playground.gui.pixel.explained import explained

        state = start(load("cornell-box"))
        assert explained(pictures(state, 300, 200)[0], (0.5, 0.5)) is not None
        solved = replace(state, method=RADIOSITY)
        assert explained(pictures(solved, 300, 200)[0], (0.5, 0.5)) is None


def test_what_is_sampled_keeps_its_shape_and_its_number():
    assert sampled((200, 100)) == (200, 100)
    width, height = sampled((1600, 800))
    assert width * height <= path_picture.MOST
    assert abs(width / height - 2.0) < 0.02
    assert sampled((1, 1), 4) == (1, 1)


@pytest.fixture
def solved(hands, gl_context, monkeypatch):
    monkeypatch.setattr(path_picture, "MOST", 4000)
    made = Solved(hands, gl_context)
    yield made
    hands.load("teapot")


def followed(solved, samples=2):
    """Wait until the path-traced picture has so many samples of every pixel."""
    paths = solved.hands.window.slots.paths

    def there():
        told = paths.told
        known = paths.stamp and told and not paths.computing
        return known and told.size == sampled(paths.stamp[1]) and told.samples >= samples

    solved.hands.frames(1)
    solved.hands.until(there)
    return paths


@pytest.mark.gl
def test_the_paths_are_those_of_the_library(solved, monkeypatch):
    monkeypatch.setattr(path_picture, "SAMPLES", 3)
    solved.show("facing-plates", view={"layout": "side by side", "other": PATHS})
    solved.wait()
    paths = followed(solved, 3)
    setup, size = paths.stamp
    tracing = PathTracing(setup, sampled(size))
    for _ in tracing.steps(3):
        pass
    small = tracing.image().codes()
    rows, columns = (np.arange(n) * m // n for n, m in zip(size[::-1], small.shape, strict=False))
    np.testing.assert_array_equal(paths.codes[..., :3], small[rows[:, None], columns])
    assert paths.told.error == pytest.approx(tracing.standard_error().mean())


@pytest.mark.gl
def test_a_change_drops_the_paths_and_the_solution_stays(solved):
    solved.show("facing-plates", view={"layout": "wipe", "other": PATHS})
    solved.wait()
    paths, result = followed(solved), solved.run.result
    before = paths.stamp
    solved.hands.key("left_arrow")
    followed(solved)
    assert paths.stamp != before and solved.run.result is result
    solved.hands.window.state = replace(solved.hands.state, layout="single")
    solved.hands.frames(3)
    assert not paths.working and paths.told is None


@pytest.mark.gl
@pytest.mark.parametrize("other", ["per-vertex", REFERENCE])
def test_the_difference_to_the_solution(solved, other):
    solved.show(view={"layout": "difference", "other": other, "magnify": 16.0})
    solved.wait()
    reference = solved.hands.window.slots.reference
    solved.hands.until(lambda: other != REFERENCE or not reference.computing)
    seen = solved.wait()
    size = size_of(seen)
    beside = reference.codes[..., :3] if other == REFERENCE else None
    if beside is None:
        beside = solved.drawn(size, RASTER, shading=other)
    expected = differ(solved.drawn(size), beside).painted(16.0)[..., :3].astype(np.float64)
    seen[LEGEND] = expected[LEGEND]
    np.testing.assert_array_equal(seen[CAPTION:], expected[CAPTION:])


@pytest.mark.gl
def test_five_answers_to_one_scene(solved):
    """Each box shows what its method draws elsewhere; the lightmap's says that there is none."""
    solved.show(view={"layout": FIVE})
    seen = solved.wait()
    size = size_of(seen)
    places = boxes(5, *size)
    assert [p.caption for p in pictures(solved.hands.state, *size)] == [
        "Phong, local",
        "Phong with lightmap",
        "ray tracing",
        RADIOSITY,
        PATHS,
    ]
    for number, method in ((0, RASTER), (3, RADIOSITY)):
        x, y, wide, high = places[number]
        expected = solved.drawn((wide, high), method)
        np.testing.assert_array_equal(
            seen[y + CAPTION : y + high, x : x + wide], expected[CAPTION:]
        )
    stored = solved.hands.window.slots.stored
    assert stored.trouble(LIGHTMAP) and not stored.trouble(RADIOSITY)
    paths = followed(solved)
    assert 0.0 < paths.told.error < 1.0
    setup = solved.hands.state.setup
    wide, high = places[4][2:]
    assert paths.stamp[0].camera == widened(setup.camera, wide / high)
    solved.hands.key("_5")
    assert solved.hands.state.layout == "single"
