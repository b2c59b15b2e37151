"""Form factors and the light of patches, explained: the numbers are those of the solver."""

import json

import numpy as np
import pytest
from plates import patches_of

import playground as pg
from playground.cli import main
from playground.explain.method import explain
from playground.explain.nusselt import PIECES, projection
from playground.explain.patch_at import patch_at, patch_of_pixel
from playground.explain.patch_light import MOST, explain_patch
from playground.explain.patch_pair import RAYS, explain_pair, pair_steps
from playground.explain.patch_words import percent
from playground.render.radiosity.factor.form_factors import METHODS
from playground.render.radiosity.patch.divide import divide
from playground.scene.settings import Settings
from playground.shading.form_factor import adjacent_rectangles, opposite_rectangles

SETUP, SIZE = "cornell-box", (80, 60)
FLOOR = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]  # its front is up
CEILING = [[0, 0, 1], [0, 1, 1], [1, 1, 1], [1, 0, 1]]
WALL = [[0, 0, 0], [0, 1, 0], [0, 1, 1], [0, 0, 1]]  # shares an edge with the floor
HALF = [[0.5, 0, 0.5], [0.5, 1, 0.5], [1, 1, 0.5], [1, 0, 0.5]]  # hangs over half of the floor
UNIT = float(np.finfo(np.float64).eps)


def plates(*corners):
    return patches_of(np.array(corners, dtype=float), [[1, 1]] * len(corners))


@pytest.fixture(scope="module")
def box():
    setup = pg.load(SETUP).with_(patches=80)
    return setup, divide(setup)


class TestPair:
    def test_facing_squares_have_the_closed_form_of_the_catalogue(self):
        pair = explain_pair(plates(FLOOR, CEILING), 0, 1)
        assert pair.angle == (0.0, 0.0) and pair.distance == 1.0
        assert pair.point == pytest.approx((1 / np.pi, 1 / np.pi))
        assert pair.disc == pytest.approx((1 / (np.pi + 1), 1 / (np.pi + 1)))
        # polygon_pair promises 1e-10 for polygons apart, rounding for close ones
        assert pair.closed[0] == pytest.approx(float(opposite_rectangles(1, 1, 1)), rel=1e-10)
        assert pair.visible == 1.0 and pair.expected == pair.closed

    def test_a_shared_edge_is_exact_and_points_are_not(self):
        pair = explain_pair(plates(FLOOR, WALL), 0, 1)
        exact = float(adjacent_rectangles(1, 1, 1))
        assert pair.closed == pytest.approx((exact, exact), rel=1e-10)
        assert abs(pair.told("closed-form").error) < 1e-10
        for method in ("point-to-point", "point-to-polygon", "hemicube"):
            assert abs(pair.told(method).error) > 0.02, method

    @pytest.mark.parametrize(("i", "j"), [(20, 60), (45, 23), (3, 70), (7, 8)])
    def test_every_method_says_what_its_rows_say(self, box, i, j):
        setup, patches = box
        pair = explain_pair(patches, i, j, setup.settings)
        assert [told.method for told in pair.methods] == [*reversed(METHODS)]
        for told in pair.methods:
            knobs = {"resolution": setup.settings.hemicube} if told.method == "hemicube" else {}
            rows = METHODS[told.method](patches, [i, j], True, **knobs)
            # of one patch or of two at once: the same sums in another order
            assert told.factors == pytest.approx((rows[0, j], rows[1, i]), rel=64 * UNIT, abs=0)
            assert told.sums == pytest.approx(tuple(rows.sum(axis=1)), rel=len(patches) * UNIT)
            weighed = patches.area[i] * told.factors[0], patches.area[j] * told.factors[1]
            assert told.exchange == weighed[0] - weighed[1]
            if pair.expected[0] > 0.0:
                assert told.error == told.factors[0] / pair.expected[0] - 1.0

    def test_reciprocity_holds_for_the_closed_form_alone(self, box):
        setup, patches = box
        pair = explain_pair(patches, 20, 60, setup.settings)
        power = patches.area[20] * pair.told("closed-form").factors[0]
        assert power > 0.0
        assert abs(pair.told("closed-form").exchange) <= 4 * UNIT * power
        assert abs(pair.told("hemicube").exchange) > 1e-4 * power

    def test_what_hangs_between_hides_its_share(self):
        patches = plates(FLOOR, CEILING, HALF)
        pair = explain_pair(patches, 0, 1)
        assert 0.0 < pair.visible < 1.0
        # Every segment through x > 1/2 at half height is stopped, and by symmetry these weigh half.
        assert pair.visible == pytest.approx(0.5, abs=1.0 / RAYS)
        assert pair.expected[0] == pair.closed[0] * pair.visible
        assert "gets through" in pair.text()
        open_ = explain_pair(patches, 0, 1, Settings(occlusion=False))
        assert open_.visible == 1.0 and "not looked at" in open_.text()
        assert open_.told("closed-form").error == pytest.approx(0.0, abs=1e-10)

    def test_backs_exchange_nothing(self):
        pair = explain_pair(plates(FLOOR, HALF), 1, 0)
        assert pair.facing and pair.closed[0] > 0.0
        turned = explain_pair(plates(FLOOR, HALF[::-1]), 0, 1)
        assert not turned.facing and turned.closed == (0.0, 0.0)
        assert all(told.factors == (0.0, 0.0) and told.error is None for told in turned.methods)
        assert "do not face" in turned.text()

    def test_swapped_is_the_pair_asked_the_other_way(self, box):
        setup, patches = box
        there = explain_pair(patches, 20, 60, setup.settings).swapped()
        back = explain_pair(patches, 60, 20, setup.settings)
        for name in ("numbers", "area", "angle", "point", "disc"):
            assert getattr(there, name) == pytest.approx(getattr(back, name), rel=4 * UNIT)
        assert there.closed == pytest.approx(back.closed, rel=1e-10)
        for one, other in zip(there.methods, back.methods, strict=True):
            assert one.factors == pytest.approx(other.factors, rel=64 * UNIT)
            assert one.exchange == pytest.approx(other.exchange, rel=1e-9, abs=1e-12)
        assert (
            there.swapped().text().split("method")[0]
            == (explain_pair(patches, 20, 60, setup.settings).text().split("method")[0])
        )

    def test_a_pair_grows_method_by_method(self, box):
        setup, patches = box
        steps = list(pair_steps(patches, 20, 60, setup.settings))
        assert [len(step.methods) for step in steps] == [*range(len(METHODS) + 1)]

    @pytest.mark.parametrize(
        ("i", "j", "words"), [(0, 0, "two patches"), (-1, 0, "0 to 1"), (0, 2, "0 to 1")]
    )
    def test_what_is_no_pair_is_refused(self, i, j, words):
        with pytest.raises(pg.PlaygroundError, match=words):
            explain_pair(plates(FLOOR, CEILING), i, j)

    def test_words_latex_and_plain_values(self):
        pair = explain_pair(plates(FLOOR, CEILING), 0, 1)
        for words in (*METHODS, "θ = 0.00°", "A_i F_ij - A_j F_ji", "all of 289 segments"):
            assert words in pair.text(), words
        assert r"\frac{\cos\theta_i\cos\theta_j}{\pi|v|^2}" in pair.latex()
        told = json.loads(json.dumps(pair.to_dict()))
        assert told["closed"] == list(pair.closed) and told["disc"] == list(pair.disc)
        assert told["numbers"] == [0, 1]
        assert [row["method"] for row in told["methods"]] == [*reversed(METHODS)]

    def test_errors_are_percentages(self):
        assert percent(0.595) == "+60 %" and percent(-0.0123) == "-1.2 %"
        assert percent(-1.0) == "-100 %" and percent(None) == "-"


class TestPixel:
    def test_the_nearest_patch_is_seen_and_of_two_the_front(self):
        eye, up = np.array([0.3, 0.4, 0.2]), np.array([0.0, 0.0, 1.0])
        patches = plates(CEILING, FLOOR, CEILING[::-1])
        assert patch_at(patches, eye, -up) == 1
        assert patch_at(patches, eye, up) == 0
        assert patch_at(patches, eye + 2 * up, -up) == 2
        assert patch_at(patches, eye, np.array([0.0, 0.0, 1.0]) + 9.0) is None

    def test_a_pixel_shows_the_patch_that_the_picture_shows(self, box):
        setup, patches = box
        for pixel in ((40, 55), (20, 30), (60, 20), (40, 5), (47, 48)):
            seen = explain(setup, pixel, SIZE, "radiosity").patch
            assert seen is not None
            assert patch_of_pixel(setup, patches, pixel, SIZE) == seen

    def test_two_pixels_give_the_pair_of_their_patches(self, box):
        setup, patches = box
        pair = explain(setup, (40, 55), SIZE, "radiosity", to=(20, 30))
        ends = (patch_of_pixel(setup, patches, pixel, SIZE) for pixel in ((40, 55), (20, 30)))
        assert pair.numbers == tuple(ends)

    def test_what_shows_no_patch_is_refused(self, box):
        setup, _ = box
        with pytest.raises(pg.PlaygroundError, match="no patch"):
            explain(setup, (40, 55), SIZE, "radiosity", to=(0, 0))
        with pytest.raises(pg.PlaygroundError, match="second pixel"):
            explain(setup, (40, 55), SIZE, to=(20, 30))

    def test_the_command_line_tells_the_pair_and_refuses_what_is_none(self, capsys):
        words = ["explain", SETUP, "--size", "80x60", "--pixel", "40", "55"]
        pair = [*words, "--method", "radiosity", "--to", "20", "30"]
        assert main(pair) == 0
        assert "A_i F_ij - A_j F_ji" in capsys.readouterr().out
        assert main([*pair, "--json"]) == 0
        told = json.loads(capsys.readouterr().out)
        assert len(told["methods"]) == len(METHODS)
        assert main([*words, "--to", "20", "30"]) == 2
        assert "second pixel" in capsys.readouterr().err


class TestLight:
    @pytest.fixture(scope="class")
    @staticmethod
    def solved():
        return pg.radiosity(pg.load(SETUP).with_(patches=80), "numpy").solve()

    def test_the_equation_of_every_patch_holds(self, solved):
        # Shooting stops with that share of the light unsent; what is sent on is sent along
        # columns, which the closed form's rows are to rounding.
        left = solved.setup.settings.convergence * solved.patches.emission.max()
        for patch in range(0, len(solved.patches), 7):
            assert explain_patch(solved, patch).residual <= left

    def test_senders_are_the_strongest_and_add_up(self, solved):
        told = explain_patch(solved, 0)
        shares = [sender.share for sender in told.senders]
        assert shares == sorted(shares, reverse=True) and len(shares) == MOST < told.sending
        assert 0.5 < sum(shares) <= 1.0
        row = solved.form_factors.rows([0])[0]
        for sender in told.senders:
            assert sender.factor == row[sender.patch]
            np.testing.assert_array_equal(sender.sent, sender.factor * sender.light)
        np.testing.assert_allclose(told.gathered, row @ solved.light, rtol=len(row) * UNIT)

    def test_the_ledger_balances(self, solved):
        for patch in (0, 25, 50):
            ledger = explain_patch(solved, patch).ledger
            into = ledger["absorbed"] + ledger["reflected"]
            np.testing.assert_allclose(ledger["arrives"], into, rtol=4 * UNIT)
            out = ledger["reflected"] + ledger["emitted"]
            np.testing.assert_allclose(ledger["leaves"], out, rtol=4 * UNIT)

    def test_a_pixel_tells_the_light_of_its_patch(self, box):
        setup, _ = box
        why = explain(setup, (40, 55), SIZE, "radiosity")
        assert why.patch_light.patch == why.patch
        for words in ("C = E + ρ ⊗ (D + Σ F C)", "row sum", "absorbed"):
            assert words in why.text()
        told = json.loads(json.dumps(why.to_dict()))["patch_light"]
        assert told["patch"] == why.patch and len(told["senders"]) == MOST
        nothing = explain(setup, (0, 0), SIZE, "radiosity")
        assert nothing.patch is None and nothing.to_dict()["patch_light"] is None


class TestNusselt:
    @pytest.mark.parametrize("place", [(0.5, 0.5), (0.1, 0.8)])
    @pytest.mark.parametrize("other", [CEILING, WALL, HALF])
    def test_the_covered_share_of_the_base_is_the_form_factor(self, other, place):
        of = projection(plates(FLOOR, other), 0, 1, place)
        assert of.exact > 0.0
        # A piece of an arc with angle a lies within a²/8 of its chord: 4 edges, each of at most π,
        # give an area of at most 4 · π · (π/PIECES)²/8, of which the base is π.
        assert of.covered == pytest.approx(of.exact, abs=0.5 * (np.pi / PIECES) ** 2)
        np.testing.assert_allclose((of.outline**2).sum(axis=1) + of.height**2, 1.0, rtol=4 * UNIT)
        assert len(of.corners) in (4, 5) and len(of.outline) == PIECES * len(of.corners)

    def test_below_the_horizon_and_from_behind_there_is_nothing(self):
        for other in (np.array(CEILING) - [0, 0, 2], HALF[::-1]):
            of = projection(plates(FLOOR, other), 0, 1)
            assert (of.covered, of.exact, of.corners) == (0.0, 0.0, ())
