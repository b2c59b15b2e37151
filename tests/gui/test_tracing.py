"""Ray tracing in the window: the picture, how it comes about, and what lies over it."""

import time
from dataclasses import replace
from threading import Event

import numpy as np
import pytest
from traced import rendered, same, settle, traced

from playground.gui import actions
from playground.gui.command_line import command_line
from playground.gui.picture.comparison import pictures
from playground.gui.rays.traced_aside import MOST, effort_codes, painted, traced_codes
from playground.gui.state import RASTER, REFERENCE, TRACED, start
from playground.scene.library import load

ROOM = "whitted-room"
SIZE = (64, 48)


def last(pieces):
    return [piece.item for piece in pieces if piece.item is not None][-1]


class TestState:
    def test_the_method_is_undone_with_the_setup(self):
        state = start(load(ROOM))
        traced = actions.toggle_tracing(state)
        assert (traced.method, traced.setup) == (TRACED, state.setup)
        kept = traced.history.record(state.moment, traced.moment, held=False)
        back = actions.undo(replace(traced, history=kept))
        assert back.method == RASTER and "method" in back.message
        assert actions.redo(back).method == TRACED
        assert "nothing" in actions.undo(start(load(ROOM))).message

    def test_a_shading_is_seen_when_it_is_chosen(self):
        state = actions.shade(actions.toggle_tracing(start(load(ROOM))), "flat")
        assert (state.method, state.mode) == (RASTER, "flat")

    @pytest.mark.parametrize("other", ["flat", "per-vertex", "per-fragment", REFERENCE, TRACED])
    def test_two_pictures_never_show_the_same(self, other):
        state = replace(start(load(ROOM)), layout="wipe", other=other)
        for change in (actions.toggle_tracing, *(_shade(m) for m in ("flat", "per-vertex"))):
            state = change(state)
            a, b = pictures(state, 300, 200)
            assert a.caption != b.caption
        for name in ("flat", TRACED, "per-vertex", REFERENCE):
            state = actions.kept_apart(state, replace(state, other=name))
            a, b = pictures(state, 300, 200)
            assert a.caption != b.caption and name in (a.caption, b.caption)

    def test_a_traced_picture_makes_no_mistakes(self):
        state = replace(start(load("teapot").with_(bugs=("missing-max",))), method=TRACED)
        assert pictures(state, 300, 200)[0].setup.settings.bugs == ()
        assert state.setup.settings.bugs

    def test_the_command_traces(self):
        setup = load(ROOM)
        words = command_line(setup, ROOM, setup, TRACED)
        assert "--method ray-tracing" in words
        assert "--method" not in command_line(setup, ROOM, setup)


def _shade(mode):
    return lambda state: actions.shade(state, mode)


class TestAside:
    def test_numpy_traces_the_very_picture(self):
        import playground

        setup = load("sphere-row")
        codes = last(traced_codes(setup, SIZE))
        image = playground.render(setup, SIZE, renderer="numpy", method="ray-tracing")
        np.testing.assert_array_equal(codes[..., :3], image.codes())

    def test_more_tests_are_brighter_and_none_are_black(self):
        codes = painted(np.array([[0, 1, 10, 100, MOST, 10 * MOST]]))[0, :, :3].astype(int)
        assert codes[0].sum() == 0 and (np.diff(codes[1:5].sum(axis=1)) > 0).all()
        np.testing.assert_array_equal(codes[4], codes[5])

    def test_the_heat_map_counts_tests(self):
        codes = last(effort_codes(load("glass-ring"), SIZE))
        assert codes.shape == (*SIZE[::-1], 4)
        assert len(np.unique(codes[..., :3].reshape(-1, 3), axis=0)) > 20


@pytest.mark.gl
@pytest.mark.parametrize("samples", [1, 4])
@pytest.mark.parametrize("name", [ROOM, "sphere-row"])
def test_the_window_shows_the_tracers_picture(hands, name, samples):
    hands.load(name, samples=samples)
    raster = hands.pixels()
    hands.key("y")
    assert hands.state.method == TRACED
    settle(hands)
    same(hands.pixels(), rendered(hands))
    hands.key("z", "ctrl")
    assert hands.state.method == RASTER
    np.testing.assert_array_equal(hands.pixels(), raster)


@pytest.mark.gl
def test_the_first_picture_is_coarse_and_any_change_drops_what_is_under_way(hands, monkeypatch):
    from playground.gui.rays import tracing

    monkeypatch.setattr(tracing, "coarseness", lambda seconds: 4)
    monkeypatch.setattr(tracing, "bands", lambda seconds, rows: 16)
    monkeypatch.setattr(tracing, "PIECE", 0.0)  # one band a frame
    hands.load(ROOM, samples=2)
    hands.window.state = replace(hands.state, method=TRACED)
    hands.frames(1)
    picture = hands.window.slots.traced.first
    assert picture.samples_done == 0 and not picture.done
    coarse = hands.pixels()
    full = rendered(hands)
    assert np.abs(coarse - full).mean() < 12.0  # it shows the same, and not as sharp
    assert np.abs(coarse - full).max() > 50.0
    end = time.monotonic() + 300.0
    while picture.share == 0.0 and time.monotonic() < end:
        hands.frames(1)
    assert 0.0 < picture.share < 0.5
    hands.window.state = hands.state.with_setup(hands.state.setup.with_(exposure=0.5))
    hands.frames(1)
    assert picture.share == 0.0 and picture.samples_done == 0
    settle(hands)
    same(hands.pixels(), rendered(hands))
    assert picture.left_out.max > 0.0
    draws = picture.draws
    hands.frames(5)
    assert picture.draws == draws  # nothing is drawn while nothing changes


@pytest.mark.gl
def test_numpy_traces_where_the_gpu_cannot(hands, monkeypatch):
    from playground.gui.rays.traced_slots import TracedSlots
    from playground.gui.rays.tracing import TracedPicture
    from playground.render.gl.program import ShaderError

    def refused(*more):
        raise ShaderError("this driver refuses")

    monkeypatch.setattr(TracedPicture, "texture", refused)
    monkeypatch.setattr(hands.window.slots, "traced", TracedSlots(hands.window.ctx))
    hands.load("sphere-row")
    traced(hands)
    seen, expected = hands.pixels(), rendered(hands)
    hands.window.slots.traced.close()
    assert np.median(np.abs(seen - expected)) == 0.0
    assert (np.abs(seen - expected).max(axis=2) > 1).mean() < 0.01  # float32 moves edges


@pytest.mark.gl
@pytest.mark.parametrize("layout", ["side by side", "wipe", "difference", "terms"])
def test_ray_tracing_is_compared_with_a_shading(hands, layout):
    hands.load("sphere-row")
    traced(hands, layout=layout, other="flat")
    if layout == "difference":
        hands.frames(2)
        assert hands.window.slots.difference.difference.largest > 0.1
    shown = pictures(hands.state, *hands.window.view_box()[2:])
    assert [picture.traced for picture in shown] == [True] * 5 if layout == "terms" else [1, 0]


@pytest.mark.gl
def test_knobs_of_ray_tracing_change_the_picture_and_are_undone(hands):
    hands.load("sphere-row")
    traced(hands)
    before = hands.pixels()

    def script(c):
        c.set_ref("//Controls")
        c.item_open("Ray tracing")
        c.item_input_value("Ray tracing/##depth", 0)

    hands.do(script)
    settle(hands)
    assert hands.state.setup.settings.depth == 0
    assert (hands.pixels() != before).any()
    hands.key("z", "ctrl")
    settle(hands)
    same(hands.pixels(), before)

    def back(c):
        c.set_ref("//Controls")
        c.item_open("View")
        c.item_click("View/raster##method")

    hands.do(back)
    assert hands.state.method == RASTER


@pytest.mark.gl
def test_boxes_lie_over_the_picture_of_every_method(hands):
    hands.load("glass-ring")
    chalk = replace(hands.state.chalk, boxes=True, level=5)
    for method in (RASTER, TRACED):
        hands.window.state = replace(hands.state, method=method, chosen=1)
        settle(hands)
        plain = hands.pixels()
        hands.window.state = replace(hands.state, chalk=chalk)
        settle(hands)
        changed = np.any(hands.pixels() != plain, axis=2).mean()
        assert 0.005 < changed < 0.3
        hands.window.state = replace(hands.state, chalk=replace(chalk, boxes=False))


@pytest.mark.gl
def test_the_heat_map_takes_the_place_of_the_traced_picture(hands):
    hands.load("glass-ring")
    traced(hands)
    plain = hands.pixels()
    traced(hands, chalk=replace(hands.state.chalk, tests=True))
    box = hands.window.view_box()
    setup = pictures(hands.state, *box[2:])[0].setup
    expected = last(effort_codes(setup, box[2:]))[..., :3]
    np.testing.assert_array_equal(hands.pixels()[40:], expected[40:])  # below the caption
    traced(hands, chalk=replace(hands.state.chalk, tests=False))
    same(hands.pixels(), plain)


@pytest.mark.gl
def test_warnings_are_told(hands):
    from playground.gui.rays.tracing_told import told

    hands.load(ROOM, shading="flat")
    traced(hands)
    hands.frames(2)
    time.sleep(0.2)
    now = told(hands.window.slots.traced)
    assert now.on and now.share == 1.0 and "not followed" in now.left_out
    assert any("flat" in warning for warning in now.warnings)


@pytest.mark.gl
def test_large_trees_are_built_beside_the_window(hands, monkeypatch):
    from playground.gui.rays import large_trees
    from playground.render.trace.bvh import bvh_of, is_built

    wanted = Event()

    def held(mesh):
        assert wanted.wait(60.0)
        return bvh_of(mesh)

    monkeypatch.setattr(large_trees, "LARGE", 100)
    monkeypatch.setattr(large_trees, "bvh_of", held)
    hands.load("glass-ring")
    hands.window.state = hands.state.with_setup(hands.state.setup.with_(tessellation=37))
    mesh = hands.state.setup.scene.objects[1].geometry().mesh
    assert not is_built(mesh)
    hands.window.state = replace(hands.state, method=TRACED)
    hands.frames(1)
    slots = hands.window.slots.traced
    assert slots.trees.working and not slots.done
    wanted.set()
    settle(hands)
    assert is_built(mesh) and not slots.trees.working
    same(hands.pixels(), rendered(hands))
