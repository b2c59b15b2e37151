"""The Snell bench: its numbers are those of optics, and its ray is dragged."""

from dataclasses import replace
from math import asin, atan, cos, degrees, radians, sin

import numpy as np
import pytest

from playground.gui.rays import snell_bench
from playground.gui.rays.snell import MEDIA, SNAP, Bench, angle_at, medium, shares
from playground.shading import optics


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


@pytest.mark.parametrize("angle", [4.0, 12.0, 25.4, 33.0, 48.0, 70.0, 86.0])
@pytest.mark.parametrize("normal", [0.0, 180.0])
@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_the_words_of_an_angle_lie_on_neither_of_its_sides(angle, normal, side):
    wide, high = 0.6, 0.22  # about what "25.4 °" takes at its distance
    ray = normal + side * angle
    at = snell_bench.words_at(ray, normal, wide, high)
    x, y = sin(radians(at)), cos(radians(at))
    corners = [(x + 0.5 * a * wide, y + 0.5 * b * high) for a in (-1, 1) for b in (-1, 1)]
    for way in (ray, normal):
        across, along = cos(radians(way)), sin(radians(way))
        sides = {np.sign(p * across - q * along) for p, q in corners}
        assert len(sides) == 1 and sides != {0.0}
