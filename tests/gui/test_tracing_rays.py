"""The rays behind a pixel of a traced picture: how they are shown, pruned and told."""

import numpy as np
import pytest
from traced import rendered, settle, traced

from playground.explain.ray_pixel import trace_pixel
from playground.explain.ray_tree import BLOCKED
from playground.gui.picture.comparison import pictures
from playground.gui.rays import ray_words
from playground.gui.rays.ray_lines import lines
from playground.gui.rays.ray_trees import gone
from playground.gui.rays.ray_view import ALL, PACE, REST, RayView
from playground.scene.library import load

ROOM, GLASS = "whitted-room", (610, 430)  # on the glass sphere, in pixels of the window
SIZE = (64, 48)


@pytest.fixture(scope="module")
def tree():
    return trace_pixel(load(ROOM), (38, 30), SIZE)


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
