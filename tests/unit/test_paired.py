"""What a saving is: pairs of pictures timed in turn, and what the noise allows to say."""

from fractions import Fraction

import pytest
from test_advisor import DARK, KEY, advice, ball

from playground.measure.paired import DOUBT, FEWEST, PAIRS, Stopwatch, paired, saving_of
from playground.steps import finished


def test_a_saving_within_the_noise_is_none():
    noise = [0.5, -0.4, 0.3, -0.6, 0.2, 0.7, -0.1, -0.3]
    assert saving_of([(10 + n, 10.0) for n in noise]).saved == 0.0
    clear = saving_of([(12 + n, 10.0) for n in noise])
    assert clear.saved == pytest.approx(2.05)
    assert (clear.low, clear.high) == pytest.approx((1.4, 2.7))  # of 8 the outermost two
    assert saving_of([(12 + n, 10.0) for n in noise], floor=3.0).saved == 0.0
    assert saving_of([(8 + n, 10.0) for n in noise]).saved < 0.0


def test_the_interval_misses_the_median_as_seldom_as_it_says():
    """For the numbers 1 to n in all 2^n ways above and below the median, counted exactly."""
    ways = [1]  # in how many ways 0, 1 … of n numbers lie above the median: a row of Pascal's
    for pairs in range(1, PAIRS + 1):
        ways = [a + b for a, b in zip([0, *ways], [*ways, 0], strict=True)]
        if pairs < FEWEST:
            continue
        found = saving_of([(float(i), 0.0) for i in range(pairs)])
        k = int(found.low) + 1
        assert found.high == pairs - k
        missed = [Fraction(sum(ways[:j] + ways[pairs - j + 1 :]), 2**pairs) for j in (k, k + 1)]
        assert missed[0] <= DOUBT < missed[1]


def test_pairs_are_interleaved_and_take_turns():
    full, other, calls = ball(KEY), ball(), []

    def noted(setup):
        calls.append("AB"[setup is other])
        return 1.0

    list(paired(noted, full, other, warm=1))
    assert "".join(calls[:10]) == "AB" + "ABBAABBA"
    assert len(calls) == 2 * (1 + PAIRS)

    calls.clear()
    list(paired(lambda setup: noted(setup) * 1000.0, full, other))
    assert len(calls) == 2 * FEWEST


def test_a_neighbour_who_often_wakes_up_does_not_hide_a_saving(rng):
    """Every fourth picture takes ten times as long: with 12 pairs that would hide it."""
    full = ball(KEY)

    def disturbed(setup):
        return (0.2 if setup is full else 0.1) * (10.0 if rng.random() < 0.25 else 1.0)

    assert finished(paired(disturbed, full, ball()), None).saved == pytest.approx(0.1)
    assert saving_of([(2.0, 10.0), (2.0, 1.0), (20.0, 1.0), (2.0, 1.0)] * 3).saved == 0.0


def test_a_setup_against_itself_is_the_noise_floor():
    """A machine on which whoever is new is faster: nothing must seem to be saved."""
    setup = ball(KEY)
    found = advice(setup, 1.0, cost=lambda drawn: 5.0 if drawn is setup else 4.0)
    assert all(finding.saving.median == 1.0 for finding in found.findings)
    assert all(finding.saving.saved == 0.0 for finding in found.findings)
    assert not found.chosen


def test_the_stopwatch_counts_the_milliseconds_of_a_clock():
    ticks = iter([1.0, 1.5, 2.0, 2.25, 3.0, 3.0])
    watch = Stopwatch((4, 4), "numpy", clock=lambda: next(ticks))
    a, b, c = ball(KEY), ball(), ball(DARK)
    assert [watch(a), watch(b), watch(c)] == [500.0, 250.0, 0.0]
    assert [setup for setup, _ in watch._open] == [b, c]
    watch.close()
    assert watch._open == []


@pytest.mark.gl
def test_what_a_window_has_still_to_draw_is_not_timed(gl_context):
    order = []

    class Window:
        """The context, noting when it is waited for."""

        def __getattr__(self, name):
            return getattr(gl_context, name)

        def finish(self):
            order.append("finish")

    watch = Stopwatch((4, 4), "gl", Window(), clock=lambda: order.append("clock") or 0.0)
    watch(ball(KEY))
    watch.close()
    assert order == ["finish", "clock", "clock"]
