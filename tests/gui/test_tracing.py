"""Ray tracing in the window: its picture, the rays behind a pixel, the Snell bench."""

import time
from dataclasses import replace
from math import asin, atan, degrees, radians, sin

import numpy as np
import pytest

from playground.explain.ray_pixel import trace_pixel
from playground.explain.ray_tree import BLOCKED
from playground.gui import actions
from playground.gui.command_line import command_line
from playground.gui.picture.comparison import pictures
from playground.gui.rays import ray_words
from playground.gui.rays.ray_lines import lines
from playground.gui.rays.ray_trees import gone
from playground.gui.rays.ray_view import ALL, PACE, REST, RayView
from playground.gui.rays.snell import MEDIA, SNAP, Bench, angle_at, medium, shares
from playground.gui.rays.traced_aside import MOST, effort_codes, painted, traced_codes
from playground.gui.state import RASTER, REFERENCE, TRACED, start
from playground.scene.library import load
from playground.shading import optics

ROOM, GLASS = "whitted-room", (610, 430)  # on the glass sphere, in pixels of the window
SIZE = (64, 48)


@pytest.fixture(scope="module")
def tree():
    return trace_pixel(load(ROOM), (38, 30), SIZE)


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


class TestRays:
    def test_one_bounce_after_the_other(self):
        view = RayView()
        assert view.grows_to(3) == 4.0
        less = view.stepped(-1, 3)
        assert (less.step, less.grows_to(3)) == (2, 3.0)
        assert less.stepped(1, 3).step == ALL
        assert view.stepped(-9, 3).step == 0

    def test_the_animation_grows_rests_and_begins_again(self):
        view = RayView().played().later(0.5 * PACE, 2)
        assert view.grows_to(2) == pytest.approx(0.5)
        whole = view.later(2.6 * PACE, 2)
        assert whole.grows_to(2) == 3.0 and whole.playing
        assert whole.later(REST, 2).grown == 0.0
        assert whole.played().grows_to(2) == 3.0

    def test_what_was_cut_off_another_tree_means_nothing(self):
        view = RayView(of="a").toggled(3)
        assert view.for_tree("a") is view
        assert view.for_tree("b").pruned == frozenset()
        assert view.toggled(3).pruned == frozenset()

    def test_a_branch_goes_with_all_that_grows_on_it(self, tree):
        parent = next(node for node in tree.nodes[1:] if node.children)
        cut = gone(tree, RayView(pruned=frozenset({parent.number})))
        assert cut == {node.number for node in parent.walk()}
        left = sum(node.added for node in tree.nodes if node.number not in cut)
        np.testing.assert_allclose(left, tree.prune(parent), atol=1e-14)

    def test_every_ray_is_a_line_and_shadow_rays_say_what_blocks_them(self, tree):
        found = list(lines(tree, 1.0, -1))
        rays = [line for line in found if not line.shadow]
        assert [line.node for line in rays] == [node.number for node in tree.nodes]
        for line, node in zip(rays, tree.nodes, strict=True):
            np.testing.assert_array_equal(line.start, node.start)
            assert line.since == node.depth and line.kind == node.kind
        floor = trace_pixel(load(ROOM), (18, 36), SIZE)  # in the shadow of the mirror
        words = [line.words for line in lines(floor, 1.0, -1) if line.kind == BLOCKED]
        assert words == ["blocked by object 6 (sphere)"]

    def test_the_words_hold_the_numbers_of_the_node(self, tree):
        node = next(node for node in tree.nodes if node.refraction is not None)
        said = "\n".join(ray_words.told(tree, node))
        assert f"{node.incidence:.2f}°" in said and f"{node.refraction:.2f}°" in said
        assert f"{node.fresnel:.4f}" in said and node.name in said
        assert ray_words.numbers(node.weight) in said
        assert ray_words.numbers(np.array([0.5, 0.25, 1e-90])) == "(0.5, 0.25, 0)"


class TestSnell:
    @pytest.mark.parametrize("above", MEDIA.values())
    @pytest.mark.parametrize("below", MEDIA.values())
    @pytest.mark.parametrize("angle", [0.0, 20.0, 41.0, 70.0, 89.0])
    def test_the_bench_says_what_optics_says(self, above, below, angle):
        bench = Bench(above=above, below=below, angle=angle)
        turned = radians(angle)
        given = np.cos(turned), np.sin(turned), above, below
        assert bench.shares.mean[0] == optics.fresnel(*given)
        assert (bench.shares.s[0], bench.shares.p[0]) == optics.fresnel_polarised(*given)
        assert bench.shares.schlick[0] == optics.schlick_either(*given)
        total = optics.cosine_transmitted(np.sin(turned), above, below) < 0.0
        assert (bench.refracted is None) == total
        if not total:  # Snell's law, to the rounding of two sines
            left, right = above * sin(turned), below * sin(radians(bench.refracted))
            assert left == pytest.approx(right, abs=1e-14)

    def test_special_angles(self):
        out = Bench(above=1.5, below=1.0)
        assert out.critical == pytest.approx(degrees(asin(1.0 / 1.5)))
        assert Bench().critical is None
        assert Bench().brewster == pytest.approx(degrees(atan(1.5)))
        at = shares(Bench(), np.array([Bench().brewster]))
        assert at.p[0] == pytest.approx(0.0, abs=1e-30) and at.s[0] > 0.1

    def test_a_dragged_ray_snaps_to_the_critical_angle(self):
        out = Bench(above=1.5, below=1.0)
        assert out.snapped(out.critical + 0.5 * SNAP).angle == out.critical
        assert out.snapped(out.critical + 2.0 * SNAP).angle != out.critical
        assert Bench().snapped(200.0).angle < 90.0

    def test_the_way_back_is_the_way(self):
        bench = Bench(angle=33.0)
        back = bench.swapped()
        assert (back.above, back.below, back.angle) == (1.5, 1.0, bench.refracted)
        assert back.refracted == pytest.approx(33.0)

    def test_names_and_the_mouse(self):
        assert [medium(index) for index in (1.0, 1.333, 1.5, 2.42, 1.7)] == [*MEDIA, ""]
        assert angle_at(-3.0, 3.0) == pytest.approx(45.0)
        assert angle_at(0.0, -5.0) == 0.0


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


def traced(hands, **changes):
    """The setup traced, until nothing more comes."""
    hands.window.state = replace(hands.state, method=TRACED, **changes)
    settle(hands)


def settle(hands):
    hands.frames(2)
    slots, until = hands.window.slots.traced, time.monotonic() + 60.0
    while (not slots.done or slots.coming) and time.monotonic() < until:
        time.sleep(0.002)
        hands.frames(1)
    assert slots.done and not slots.coming
    hands.frames(1)


def rendered(hands, **changes):
    """The codes (H, W, 3) of a tracer that knows nothing of the window."""
    from playground.gui.picture.orbit import widened
    from playground.render.gl.trace.tracer import GLTracer

    size = hands.window.view_box()[2:]
    setup = hands.state.setup.with_(**changes)
    setup = setup.with_(camera=widened(setup.camera, size[0] / size[1]))
    codes = np.empty((size[1], size[0], 4), dtype=np.uint8)
    with GLTracer(size, hands.window.ctx) as tracer:
        tracer.render(setup, out=codes)
    return codes[..., :3].astype(np.float64)


def same(seen, expected):
    """Up to one code where a constant in a program rounds otherwise than a uniform."""
    assert expected.std() > 5.0
    assert np.abs(seen - expected).max() <= 1.0


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
    until = time.monotonic() + 30.0
    while picture.share == 0.0 and time.monotonic() < until:
        time.sleep(0.01)
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
def test_a_click_shows_the_rays_and_a_branch_is_cut_off_exactly(hands):
    hands.load(ROOM)
    traced(hands)
    hands.click(*GLASS)
    hands.io.add_mouse_pos_event(-1.0, -1.0)
    hands.frames(3)
    box = hands.window.view_box()
    picture = pictures(hands.state, *box[2:])[0]
    tree = trace_pixel(picture.setup, (GLASS[0] - box[0], GLASS[1] - box[1]), box[2:])
    assert hands.state.rays.of == (tree.setup, tree.pixel, tree.size)
    codes = rendered(hands)[tree.pixel[1], tree.pixel[0]]
    assert np.abs(tree.codes - codes).max() <= 1.0  # float64 against float32

    def script(c):
        c.set_ref("//Controls")
        c.item_click("**/##keep 1")
        c.mouse_move("Explain/##tree")
        c.item_click("**/###row 2")
        c.item_click("**/−##bounce")

    hands.do(script)
    rays = hands.state.rays
    assert rays.pruned == {1} and rays.chosen == 2 and rays.step >= 0
    left = tree.colour - tree.prune(1)
    np.testing.assert_allclose(left, tree.branch(1), atol=1e-15)
    hands.key("escape")
    assert hands.state.pixel is None


@pytest.mark.gl
def test_a_ray_under_the_mouse_is_lit(hands):
    hands.load(ROOM)
    traced(hands)
    hands.click(*GLASS)
    hands.frames(3)
    hands.key("o")  # from the side the first ray is more than a point
    settle(hands)
    lit = set()
    for x in range(100, 900, 20):
        hands.io.add_mouse_pos_event(float(x), 328.0)
        hands.frames(1)
        lit.add(hands.state.rays.lit)
    assert {-1, 2} <= lit
    hands.key("o")
    hands.io.add_mouse_pos_event(-1.0, -1.0)
    settle(hands)
    assert hands.state.rays.lit == -1


@pytest.mark.gl
def test_the_ray_of_the_bench_is_dragged_and_snaps(hands):
    from test_controls import opened

    hands.window.state = replace(hands.state, bench=Bench(above=1.5, below=1.0, angle=10.0))

    def script(c):
        opened(c, "Snell bench")
        c.scroll_to_item_y("Snell bench/##ray")
        c.yield_(2)
        info = c.item_info("Snell bench/##ray")
        found.append((info.rect_full.min, info.rect_full.max))

    found = []
    hands.do(script)
    (low, high), critical = found[0], hands.state.bench.critical
    centre = ((low.x + high.x) / 2.0, (low.y + high.y) / 2.0)
    far = 0.4 * (high.y - low.y)
    turned = radians(critical + 0.4)
    start, end = (centre[0] - 5.0, centre[1] - far), None
    end = (centre[0] - far * np.sin(turned), centre[1] - far * np.cos(turned))
    hands.drag(start, end)
    assert hands.state.bench.angle == critical
    assert not hands.state.history.past  # it is no part of the setup


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
    from playground.render.trace.bvh import is_built

    monkeypatch.setattr(large_trees, "LARGE", 100)
    hands.load("glass-ring")
    hands.window.state = hands.state.with_setup(hands.state.setup.with_(tessellation=37))
    mesh = hands.state.setup.scene.objects[1].geometry().mesh
    assert not is_built(mesh)
    hands.window.state = replace(hands.state, method=TRACED)
    hands.frames(1)
    slots = hands.window.slots.traced
    assert slots.trees.working and not slots.done
    settle(hands)
    assert is_built(mesh) and not slots.trees.working
    same(hands.pixels(), rendered(hands))
