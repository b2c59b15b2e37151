"""Form factors in the window: the pure parts, then patches chosen in the real app."""

from dataclasses import replace
from threading import Event
from time import monotonic, sleep

import numpy as np
import pytest

from playground.errors import PlaygroundError
from playground.explain.patch_pair import explain_pair
from playground.gui.radiosity.factor_view import OTHER, UNDER, FactorView
from playground.gui.work.aside import Aside
from playground.gui.work.latest import Latest
from playground.render.radiosity.factor.form_factors import METHODS
from playground.render.radiosity.factor.hemicube import Hemicubes
from playground.render.radiosity.patch.divide import divide
from playground.scene.library import load

imgui = pytest.importorskip("imgui_bundle").imgui

from playground.gui.radiosity import (  # noqa: E402
    factor_formula,
    factor_table,
    hemicube_image,
)

SETUP = "cornell-box"
FLOOR, RED, GREEN = (417, 620), (200, 300), (700, 300)  # of the window: on three sides of the box
PATIENCE = 300.0  # seconds for what takes one


@pytest.fixture(scope="module")
def box():
    setup = load(SETUP).with_(patches=80)
    return setup, divide(setup)


class TestView:
    def test_clicks_choose_i_then_j_then_a_new_pair(self):
        view = FactorView().clicked(3)
        assert (view.one, view.other) == (3, None)
        view = view.clicked(3).clicked(5)
        assert (view.one, view.other) == (3, 5)
        assert (view.swapped().one, view.swapped().other) == (5, 3)
        view = view.clicked(7, second=True)
        assert (view.one, view.other) == (3, 7)
        view = view.clicked(8)
        assert (view.one, view.other) == (8, None)
        assert FactorView().clicked(2, second=True).one == 2
        assert view.swapped() is view and view.forgotten().one is None

    def test_other_patches_have_other_numbers(self, box):
        setup, patches = box
        view = FactorView(of=patches, one=3, other=5)
        assert view.on(None) is view and view.on(patches) is view
        again = view.on(divide(setup.with_(exposure=2.0)))
        assert (again.one, again.other) == (3, 5) and again.of is not patches
        assert view.on(divide(setup.with_(patches=60))).one is None

    def test_the_picture_is_pointed_at_before_the_panel(self):
        assert FactorView(under=1, lit=2).pointed == 1
        assert FactorView(lit=2).pointed == 2 and FactorView().pointed is None


class TestHemicubeImage:
    @pytest.mark.parametrize("resolution", [8, 64])
    def test_pixels_of_a_patch_sum_to_its_form_factor(self, box, resolution):
        _, patches = box
        items = Hemicubes(patches, True, resolution).item_buffer(20)
        row = METHODS["hemicube"](patches, [20], True, resolution=resolution)[0]
        for patch in (60, 17, 63, 20):
            count, factor = hemicube_image.summed(items, patch)
            assert (count > 0) == (row[patch] > 0.0)
            np.testing.assert_allclose(factor, row[patch], rtol=1e-12)
        np.testing.assert_allclose(hemicube_image.row_sum(items), row.sum(), rtol=1e-12)

    def test_every_pixel_stands_once_in_the_image(self):
        place = hemicube_image.places(16)
        assert place.shape == (32, 32) and np.count_nonzero(place < 0) == 4 * 8 * 8
        assert sorted(place[place >= 0]) == [*range(3 * 16 * 16)]
        # The lowest row of the top stands at the bottom of the middle.
        assert place[23, 8] == 0 and place[8, 8] == 15 * 16

    def test_colours_and_marks(self, box):
        _, patches = box
        items = Hemicubes(patches, True, 16).item_buffer(20)
        colours = hemicube_image.own_colours(len(patches))
        assert len(np.unique(np.round(colours, 6), axis=0)) == len(patches)
        image = hemicube_image.image(items, colours, ((60, OTHER), (17, UNDER)))
        assert image.shape == (32, 32, 4)
        seen = hemicube_image.laid_flat(items)
        corner = hemicube_image.places(16) < 0
        np.testing.assert_array_equal(image[..., 3] == 0, corner)
        for patch, colour in ((60, OTHER), (17, UNDER), (63, hemicube_image.DIMMED * colours[63])):
            shown = image[(seen == patch + 1) & ~corner, :3]
            assert len(shown) and (shown == np.uint8(np.array(colour) * 255 + 0.5)).all()
        deltas = hemicube_image.image(items, None)
        middle, rim = deltas[16, 16, :3].astype(int), deltas[16, 0, :3].astype(int)
        assert middle[1] > 200 and rim[1] < 30  # viridis: yellow where most light goes through

    def test_the_pixel_under_the_mouse(self, box):
        _, patches = box
        items = Hemicubes(patches, True, 16).item_buffer(20)
        assert hemicube_image.pixel_at(items, 0.01, 0.01) is None
        patch, delta = hemicube_image.pixel_at(items, 0.5, 0.5)
        assert patch == items[7, 8] - 1 and delta == hemicube_image.delta_form_factors(16)[7, 8]

    def test_pixels_stay_square_when_enlarged(self):
        codes = np.arange(4 * 4 * 4, dtype=np.uint8).reshape(4, 4, 4)
        large = hemicube_image.enlarged(codes)
        times = hemicube_image.FINE // 4
        assert large.shape == (hemicube_image.FINE, hemicube_image.FINE, 4)
        np.testing.assert_array_equal(large[::times, ::times], codes)
        np.testing.assert_array_equal(large[times - 1 :: times, times - 1 :: times], codes)


class TestLatest:
    def test_the_last_question_is_answered_and_the_others_are_dropped(self):
        latest, gate, asked = Latest(), Event(), []

        def items(name):
            asked.append(name)
            gate.wait(PATIENCE)
            yield name

        assert latest.ask("a", lambda: items("a")) is None
        for name in "bcd":
            latest.ask(name, lambda name=name: items(name))
        gate.set()
        until = monotonic() + PATIENCE
        while latest.ask("d", lambda: items("d")) != "d" and monotonic() < until:
            sleep(0.001)
        assert latest.item == "d" and asked == ["a", "d"]
        latest.close()
        assert latest.item is None and not latest.working

    def test_what_is_refused_is_told(self):
        def refused():
            raise PlaygroundError("no light at all")
            yield

        latest, until = Latest(), monotonic() + PATIENCE
        while not latest.error and monotonic() < until:
            latest.ask("a", refused)
        assert "no light" in latest.error and latest.item is None

    def test_an_error_is_told_that_comes_just_after_one_has_looked(self, monkeypatch):
        looked, working = Event(), Aside.working.fget

        def refused():
            looked.wait(PATIENCE)
            raise PlaygroundError("no light at all")
            yield

        def last_moment(aside):
            looked.set()
            aside._thread.join(PATIENCE)
            return working(aside)

        monkeypatch.setattr(Aside, "working", property(last_moment))
        latest = Latest()
        for _ in range(3):
            latest.ask("a", refused)
        assert "no light" in latest.error and not latest.working


def test_the_formula_has_the_numbers_of_the_pair(box):
    _, patches = box
    pair = explain_pair(patches, 20, 60)
    symbols, numbers, last = factor_formula.lines(pair)
    assert symbols[1] == ("cos θ_i cos θ_j", "π |v|^2")
    assert f"{pair.angle[0]:.1f}°" in numbers[1][0] and f"{pair.distance:.4g}" in numbers[1][1]
    assert last[0].endswith(f"{pair.point[0]:.4g}")
    cosines = np.prod(np.cos(np.radians(pair.angle)))
    assert pair.point[0] == pytest.approx(cosines / (np.pi * pair.distance**2) * pair.area[1])


def test_a_row_of_the_table_is_what_the_method_says(box):
    _, patches = box
    told = explain_pair(patches, 20, 60).told("hemicube")
    cells = factor_table.cells_of(told)
    assert float(cells[0]) == pytest.approx(told.factors[0], rel=1e-4) and "%" in cells[1]
    assert f"{told.sums[1]:.5f}" in factor_table.more(told)


@pytest.mark.gl
class TestWindow:
    def begin(self, hands, **changes):
        hands.load(SETUP, **{"patches": 80, **changes})
        view = replace(FactorView(), picking=True)
        hands.window.state = replace(hands.state, factors=view)
        self.settle(hands)

    def settle(self, hands):
        """Wait for what threads compute."""
        hands.frames(2)
        hands.until(lambda: not hands.window.slots.factors.now.working)

    def shift_click(self, hands, x, y):
        hands.io.add_key_event(hands.imgui.Key.mod_shift, True)
        hands.click(x, y)
        hands.io.add_key_event(hands.imgui.Key.mod_shift, False)
        hands.frames()

    def numbers(self, hands):
        return hands.state.factors.one, hands.state.factors.other

    def test_two_clicks_choose_and_everything_is_told(self, hands):
        self.begin(hands)
        patches = hands.state.factors.of
        hands.click(*FLOOR)
        one = hands.state.factors.one
        assert patches.normal[one] == pytest.approx((0, 1, 0), abs=1e-9)
        assert hands.state.pixel is None and hands.state.factors.other is None
        hands.click(*RED)
        self.settle(hands)
        assert hands.state.factors.one == one
        other = hands.state.factors.other
        assert patches.reflectance[other][0] > 2 * patches.reflectance[other][1]
        now = hands.window.slots.factors.now
        wanted = explain_pair(patches, one, other, hands.state.setup.settings)
        assert [t.factors for t in now.pair.methods] == [t.factors for t in wanted.methods]
        assert now.hemicube.patch == one and now.picture > 0

    def test_shift_click_chooses_j_and_a_right_click_forgets_both(self, hands):
        self.begin(hands)
        hands.click(*FLOOR)
        hands.click(*RED)
        one, red = self.numbers(hands)
        self.shift_click(hands, *GREEN)
        assert hands.state.factors.one == one and hands.state.factors.other not in (red, None)
        hands.click(*RED)
        assert self.numbers(hands) == (red, None)
        hands.click(*GREEN, button=1)
        assert self.numbers(hands) == (None, None)

    def test_without_the_switch_clicks_explain_pixels(self, hands):
        self.begin(hands)
        hands.window.state = replace(hands.state, factors=FactorView())
        hands.click(*FLOOR)
        assert hands.state.pixel is not None and hands.state.factors.one is None
        assert hands.window.slots.factors.now.patches is None

    def test_a_drag_turns_the_camera_and_chooses_nothing(self, hands):
        self.begin(hands)
        camera = hands.state.setup.camera
        hands.drag(FLOOR, (FLOOR[0] + 60, FLOOR[1] - 30))
        assert hands.state.setup.camera != camera and self.numbers(hands) == (None, None)

    def test_the_patch_under_the_mouse_and_the_chosen_ones_are_outlined(self, hands):
        self.begin(hands)
        plain = hands.pixels()
        hands.io.add_mouse_pos_event(*RED)
        hands.frames(3)
        assert hands.state.factors.under is not None
        assert np.abs(hands.pixels() - plain).max() > 100
        hands.io.add_mouse_pos_event(1270, 100)
        hands.frames(3)
        assert hands.state.factors.under is None
        hands.click(*FLOOR)
        hands.io.add_mouse_pos_event(1270, 100)
        hands.frames(3)
        orange = np.array([255, 158, 38])
        assert (np.abs(hands.pixels() - orange).max(axis=-1) < 3).sum() > 50

    def test_the_hemicube_answers_the_mouse(self, hands):
        self.begin(hands)
        hands.click(*FLOOR)
        self.settle(hands)
        now, seen = hands.window.slots.factors.now, []
        items = now.hemicube.items
        middle = hemicube_image.pixel_at(items, 0.5, 0.5)[0]
        assert middle >= 0

        def script(c):
            c.item_open("//Controls/Form factors")
            c.yield_(2)
            c.mouse_move("//Controls/Form factors/##hemicube")
            c.yield_(3)
            seen.append(hands.state.factors.lit)
            c.mouse_click(0)
            c.yield_(3)

        hands.do(script)
        # The middle lies between four pixels: whichever the mouse hits.
        near = {hemicube_image.pixel_at(items, x, y)[0] for x in (0.49, 0.5) for y in (0.49, 0.5)}
        assert seen[0] in near and hands.state.factors.other == seen[0]

    def test_a_coarser_hemicube_and_other_colours_are_drawn_anew(self, hands):
        self.begin(hands, patches=70)  # not those that another test has solved
        hands.click(*FLOOR)
        self.settle(hands)
        for changes in ({"resolution": 8}, {"colouring": "delta"}, {"colouring": "light"}):
            view = replace(hands.state.factors, **changes)
            hands.window.state = replace(hands.state, factors=view)
            self.settle(hands)
        now = hands.window.slots.factors.now
        assert now.hemicube.resolution == 8 and not now.solved

    def test_solved_light_colours_the_hemicube(self, hands):
        from playground.gui.state import RADIOSITY

        self.begin(hands)
        hands.click(*FLOOR)
        view = replace(hands.state.factors, colouring="light")
        hands.window.state = replace(hands.state, factors=view, method=RADIOSITY)
        hands.until(lambda: hands.window.slots.factors.now.solved)

    def test_another_setup_forgets_and_one_without_light_says_so(self, hands):
        self.begin(hands)
        hands.click(*FLOOR)
        hands.window.state = hands.state.opened(load("facing-plates").with_(patches=60))
        self.settle(hands)
        assert self.numbers(hands) == (None, None)
        hands.window.state = hands.state.opened(load("facing-plates").with_(lights=()))
        self.settle(hands)
        assert hands.window.slots.factors.now.error

    @pytest.mark.parametrize("theme", ["dark", "light"])
    def test_the_whole_panel_draws_in_both_themes(self, hands, theme):
        self.begin(hands)
        hands.window.state = replace(hands.state, theme=theme)
        hands.click(*FLOOR)
        hands.click(*GREEN)
        self.settle(hands)

        def script(c):
            c.item_open("//Controls/Form factors")
            c.yield_(3)
            for label in ("##hemicube", "##across", "Swap##pair"):
                assert c.item_exists(f"//Controls/Form factors/{label}"), label

        hands.do(script)
