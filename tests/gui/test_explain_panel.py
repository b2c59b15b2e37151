"""Why a pixel has its colour: the pure parts, then the panel in the real app."""

from types import SimpleNamespace

import numpy as np
import pytest

from playground.explain.colour_map import colour_of
from playground.explain.pixel import explain
from playground.gui.picture.comparison import Picture
from playground.gui.pixel.clue import Clue
from playground.gui.pixel.explained import Explainer, chosen_corner, pixel_at
from playground.scene.library import load
from playground.shading.display import code8

imgui = pytest.importorskip("imgui_bundle").imgui

from playground.gui.picture import pointer  # noqa: E402
from playground.gui.pixel import (  # noqa: E402
    filter_bars,
    lobe_plot,
    side_view,
    triangle_lens,
    triangle_mark,
)
from playground.gui.pixel import vector_pen as pen  # noqa: E402
from playground.gui.pixel.equation import formula, numbers  # noqa: E402

POINT = (390, 330)  # of the window: on the teapot, in its highlight


@pytest.mark.parametrize("shininess", [1.0, 5.0, 40.0, 80.0])
def test_the_lobe_is_the_power_of_the_cosine(shininess):
    points = lobe_plot.lobe(shininess)
    reach, angle = np.hypot(*points.T), np.radians(np.arange(-90.0, 91.0))
    np.testing.assert_allclose(reach, np.cos(angle) ** shininess, atol=1e-12)
    np.testing.assert_allclose(points[:, 0], reach * np.sin(angle), atol=1e-12)
    np.testing.assert_allclose(points[:, 0], -points[::-1, 0], atol=1e-12)
    assert points[len(points) // 2] == pytest.approx((0.0, 1.0))


def test_the_viewer_stands_on_the_lobe_and_beyond_90_degrees_at_its_origin():
    right, up = lobe_plot.marker(20.0, 15.0)
    assert np.hypot(right, up) == pytest.approx(np.cos(np.radians(15.0)) ** 20)
    assert np.degrees(np.arctan2(right, up)) == pytest.approx(15.0)
    assert lobe_plot.marker(20.0, 120.0) == (0.0, 0.0)


@pytest.mark.parametrize("up", [0.2, 0.5, 0.8])
def test_labels_of_the_lobe_are_tied_to_the_curve(up):
    x = lobe_plot.across(10.0, up)
    assert np.hypot(x, up) == pytest.approx((up / np.hypot(x, up)) ** 10, abs=1e-3)
    assert x > 0.0


def test_bars_share_one_scale_that_holds_every_value():
    assert filter_bars.heights([(0.5, 1.0, 0.0)]) == [[0.5, 1.0, 0.0]]
    assert filter_bars.heights([(4.0, 1.0, 0.0), (1.0, 1.0, 1.0)])[0] == [1.0, 0.25, 0.0]


def test_a_place_of_the_view_belongs_to_one_picture():
    setup = load("sphere")
    left = Picture(setup, "", (0, 0, 100, 50), (0.0, 0.3))
    right = Picture(setup, "", (0, 0, 100, 50), (0.3, 1.0))
    assert pointer.place((left, right), 10.0, 25.0) == (0, (0.1, 0.5))
    assert pointer.place((left, right), 60.0, 25.0) == (1, (0.6, 0.5))
    assert pointer.place((left, right), 60.0, 50.0) is None


def test_a_share_of_the_picture_is_the_same_place_at_every_size():
    assert pixel_at((0.5, 0.25), (640, 480)) == (320, 120)
    assert pixel_at((0.5, 0.25), (1280, 960)) == (640, 240)
    assert pixel_at((1.0, 1.0), (8, 8)) == (7, 7)


def test_the_side_view_shows_rho_in_its_true_size(rng):
    for _ in range(50):
        n, r, v = (x / np.linalg.norm(x) for x in rng.normal(size=(3, 3)))
        axes = side_view.side_axes(n, r, v)
        np.testing.assert_allclose(axes @ axes.T, np.eye(2), atol=1e-9)
        assert (axes @ r) @ (axes @ v) == pytest.approx(r @ v)
        assert axes[0] @ v >= 0.0
        path = side_view.arc(r, v)
        np.testing.assert_allclose(np.linalg.norm(path, axis=1), 1.0)
        np.testing.assert_allclose(path[[0, -1]], [r, v], atol=1e-12)


def test_the_side_view_stands_where_all_directions_are_one():
    n = np.array([0.0, 0.0, 1.0])
    axes = side_view.side_axes(n, n, n)
    np.testing.assert_allclose(axes @ n, (0.0, 1.0), atol=1e-12)


def test_small_triangles_fill_the_large_one():
    made = triangle_lens.pieces(5)
    assert len(made) == 25
    for weights in made:
        np.testing.assert_allclose(weights.sum(axis=1), 1.0)
        assert abs(np.linalg.det(weights)) == pytest.approx(1 / 25)


def test_arrows_are_hit_near_their_tips_only():
    arrows = {"n": ((0.0, 0.0), (0.0, -60.0)), "l": ((0.0, 0.0), (60.0, 0.0))}
    assert pen.nearest((2.0, -50.0), arrows, 7.0) == "n"
    assert pen.nearest((50.0, 3.0), arrows, 7.0) == "l"
    assert pen.nearest((1.0, -1.0), arrows, 7.0) == ""


def test_plates_keep_apart():
    first = pen.apart((0.0, 0.0, 10.0, 10.0), [])
    second = pen.apart((5.0, 5.0, 10.0, 10.0), [first])
    assert second == (5.0, 10.0, 10.0, 10.0)
    assert pen.apart((50.0, 5.0, 10.0, 10.0), [first, second]) == (50.0, 5.0, 10.0, 10.0)


def test_the_equation_says_the_numbers_of_the_point():
    why = explain(load("teapot"), (390, 309), (920, 651))
    point = why.corners[0]
    light = point.lights[0]
    assert formula("diffuse", why)[1:4] == ("n", "·", "l")
    said = numbers("diffuse", why, point, light)
    assert said == (f"{light.diffuse_factor:.3f} ·", "(1, 1, 1) ⊗", "(0.66, 0.3, 0.14)")
    blinn = explain(load("teapot").with_(highlight="blinn"), (390, 309), (920, 651))
    assert formula("specular", blinn)[1:4] == ("n", "·", "h")
    assert formula("specular", why, area=True)[:2] == ("1/π ∫ max(", "r")
    fitted = formula("specular", blinn, area=True)
    assert fitted[0].startswith("≈") and fitted[1:4] == ("n", "·", "h")
    assert fitted[-1].strip() == "by a fitted lobe"
    off = explain(load("teapot").with_(terms=("ambient",)), (390, 309), (920, 651))
    assert numbers("diffuse", off, point, light) == ("switched off",)


def test_the_explainer_computes_once_and_rests_while_it_is_slow(monkeypatch):
    from playground.gui.pixel import explained

    asked, now = [], [0.0]

    def slow(setup, pixel, size):
        asked.append(pixel)
        now[0] += 0.1
        return SimpleNamespace(pixel=pixel)

    monkeypatch.setattr(explained, "explain", slow)
    monkeypatch.setattr(explained, "perf_counter", lambda: now[0])
    explainer, setup = Explainer(), load("sphere")
    for _ in range(5):
        assert explainer(setup, (1, 1), (8, 8)).pixel == (1, 1)
    assert explainer(setup, (2, 2), (8, 8)).pixel == (1, 1)  # the old one for a moment
    now[0] += explained.REST * 0.1 + 1e-6
    assert explainer(setup, (2, 2), (8, 8)).pixel == (2, 2)
    assert explainer(setup, (1, 1), (8, 8)).pixel == (1, 1)  # still known
    assert asked == [(1, 1), (2, 2)]


def test_the_heaviest_vertex_is_shown_until_one_is_chosen():
    why = explain(load("teapot").with_(shading="per-vertex"), (390, 309), (920, 651))
    assert chosen_corner(why, Clue()) == int(why.weights.argmax())
    assert chosen_corner(why, Clue(corner=1)) == 1


@pytest.mark.gl
def test_a_click_picks_a_pixel_and_the_picture_agrees(hands):
    from playground.gui.picture.comparison import pictures
    from playground.gui.pixel.explained import explained

    box = hands.window.view_box()
    before = hands.state.setup
    codes = hands.pixels()[POINT[1] - box[1], POINT[0] - box[0]]
    hands.click(*POINT)
    hands.frames(3)
    assert hands.state.setup is before  # a click moves nothing
    picture = pictures(hands.state, *box[2:])[0]
    why = explained(picture, hands.state.pixel)
    assert why.pixel == (POINT[0] - box[0], POINT[1] - box[1])
    assert np.abs(why.codes - codes).max() <= 1.0  # float64 against float32


@pytest.mark.gl
@pytest.mark.parametrize("way", ["escape", "right click"])
def test_the_pixel_is_forgotten(hands, way):
    plain = hands.pixels()
    hands.click(*POINT)
    hands.io.add_mouse_pos_event(-1.0, -1.0)
    assert hands.state.pixel is not None
    assert (hands.pixels() != plain).any()  # the arrows
    if way == "escape":
        hands.key("escape")
    else:
        hands.click(*POINT, button=1)
    assert hands.state.pixel is None
    np.testing.assert_array_equal(hands.pixels(), plain)


@pytest.mark.gl
def test_a_drag_picks_nothing_and_shift_follows_the_mouse(hands):
    hands.drag(POINT, (POINT[0] + 60, POINT[1]))
    assert hands.state.pixel is None
    keys = hands.imgui.Key
    hands.io.add_key_event(keys.mod_shift, True)
    hands.io.add_mouse_pos_event(*POINT)
    hands.frames(3)
    first = hands.state.pixel
    hands.io.add_mouse_pos_event(POINT[0] + 20.0, POINT[1])
    hands.frames(3)
    hands.io.add_key_event(keys.mod_shift, False)
    hands.frames(2)
    assert first is not None
    assert hands.state.pixel[0] > first[0] and hands.state.pixel[1] == first[1]


@pytest.mark.gl
def test_vectors_light_up_their_symbols_and_symbols_their_vectors(hands):
    hands.click(*POINT)
    hands.frames(3)
    hands.io.add_mouse_pos_event(-1.0, -1.0)
    quiet = hands.pixels()
    lit = set()
    for x in range(282, 450, 6):  # along l and r in the picture
        for y in range(284, 354, 7):
            hands.io.add_mouse_pos_event(float(x), float(y))
            hands.frames(1)
            lit.add(hands.state.clue.lit)
    assert {"n", "l", "r", "v", "ρ", ""} <= lit
    for y in range(300, 440, 6):  # down the formulas of the panel
        hands.io.add_mouse_pos_event(1028.0, float(y))
        hands.frames(3)
        if hands.state.clue.lit:
            break
    assert hands.state.clue.lit
    assert (hands.pixels() != quiet).any()
    hands.io.add_mouse_pos_event(-1.0, -1.0)
    hands.frames(2)
    np.testing.assert_array_equal(hands.pixels(), quiet)


@pytest.mark.gl
@pytest.mark.parametrize("shading", ["flat", "per-vertex", "per-fragment"])
@pytest.mark.parametrize("layout", ["single", "side by side", "wipe", "terms"])
def test_every_shading_and_layout_is_explained(hands, shading, layout):
    from dataclasses import replace

    hands.load("teapot", shading=shading, tessellation=4, highlight="blinn")
    hands.window.state = replace(hands.state, layout=layout)
    hands.frames()
    hands.click(*POINT)
    hands.frames(3)
    assert hands.state.pixel is not None and not hands.state.failed
    hands.wheel(1100.0, 500.0, -30.0)
    hands.wheel(1100.0, 500.0, 30.0)


@pytest.mark.gl
def test_light_vertex_and_term_are_chosen_by_their_labels(hands):
    lights = load("teapot").scene.lights
    hands.load("teapot", shading="per-vertex", lights=lights * 2)
    hands.click(*POINT)
    hands.frames(3)

    def script(context):
        context.set_ref("Controls")
        context.item_click("**/light 1")
        context.item_click("**/corner C")
        context.item_click("**/specular##filter")

    hands.do(script)
    assert (hands.state.clue.light, hands.state.clue.corner) == (1, 2)
    assert hands.state.clue.term == "specular"


@pytest.mark.gl
def test_the_background_is_explained_too(hands):
    hands.click(30, 60)
    hands.frames(3)
    assert hands.state.pixel is not None and not hands.state.failed


MISSED = (375, 305), (890, 651)  # the pixel in the highlight of the coarse pot, and the picture


def coarse(shading):
    return load("teapot").with_(shading=shading, tessellation=4)


def test_the_lens_shows_what_the_vertices_miss():
    why = explain(coarse("per-vertex"), *MISSED)
    mix = triangle_lens.middles()
    corners = np.array([corner.colour for corner in why.corners])
    told = triangle_mark.shown_codes(why, mix @ corners)
    assert triangle_lens.mixed_inks(why) == tuple(pen.ink(code) for code in told.tolist())
    inks = triangle_lens.difference_inks(why)
    assert triangle_lens.largest(why) > 0.3  # the highlight lies between the vertices
    assert pen.ink(tuple(code8(colour_of(1.0)).tolist())) in inks  # yellow: the largest
    assert len(inks) == len(triangle_lens.shaded_inks(why)) == len(mix)
    fine = explain(load("teapot").with_(shading="per-vertex", tessellation=64), *MISSED)
    assert triangle_lens.largest(fine) < 0.05


@pytest.mark.gl
@pytest.mark.parametrize("shading", ["flat", "per-vertex", "per-fragment"])
def test_the_lens_is_there_where_triangles_are_not_shaded_at_every_point(hands, shading):
    seen = []
    draw = triangle_lens.compared
    hands.load("teapot", shading=shading, tessellation=4)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(triangle_lens, "compared", lambda why: (seen.append(why), draw(why)))
        hands.click(*POINT)
        hands.frames(3)
    assert bool(seen) == (shading != "per-fragment")
