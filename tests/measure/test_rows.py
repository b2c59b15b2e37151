"""What is made of raw samples: medians, ratios, the front, slopes, standard errors."""

from dataclasses import replace

import numpy as np
import pytest
from synthetic import Fake, fronted, row

from playground.measure.jackknife import jackknife
from playground.measure.journal import Journal
from playground.measure.record import Batch
from playground.measure.report.text import winner, winners
from playground.measure.rows import difference, enough, fastest, ratio, rows_of, slope, told_apart


def test_a_row_holds_the_median_of_all_times_and_of_each_round():
    fake = Fake()
    (group,) = fake.groups(False)
    journal = Journal(None, "s")
    journal.add("fake", group[0], Batch([1.0, 2.0, 9.0], {"megabytes": [5.0]}), 0)
    journal.add("fake", group[0], Batch([3.0, 4.0, 5.0], {"megabytes": [7.0]}), 1)
    (found,) = rows_of(fake.experiment, group, journal)
    assert (found.median, found.count, found.rounds) == (3.5, 6, (2.0, 4.0))
    assert (found.low, found.high) == pytest.approx((1.5, 7.0))
    assert found.more == {"megabytes": 6.0}
    assert found.error is None and not found.front


def test_the_front_is_what_nothing_of_the_case_beats():
    rows = fronted(
        row("fast", 1.0, 0.5),
        row("slow and good", 5.0, 0.1),
        row("slow and bad", 5.0, 0.2),
        row("no error", 0.1),
        row("twin", 1.0, 0.5),
        row("alone", 9.0, 0.9, case="other"),
    )
    assert [r.method for r in rows if r.front] == ["fast", "slow and good", "twin", "alone"]


def test_the_fastest_below_a_bound_and_those_as_fast_within_its_spread():
    rows = [
        row("bad", 0.1, 0.5),
        row("best", 1.0, 0.005, spread=0.1),
        row("as fast", 1.05, 0.001),
        row("slower", 1.2, 0.0),
        row("unjudged", 0.2),
    ]
    assert [r.method for r in fastest(rows, 0.01)] == ["best", "as fast"]
    assert [r.method for r in fastest(rows, 0.001)] == ["as fast"]
    assert fastest(rows[:1], 0.01) == []
    ((case, (percent, per_mille)),) = winners(rows)
    assert case == ""
    text = winner(Fake().experiment, percent)
    assert text == "best (1 ms); as fast within its spread: as fast"
    assert winner(Fake().experiment, per_mille).startswith("as fast (1.05 ms)")
    assert winner(Fake().experiment, []) == "none"


def test_ratios_are_taken_within_rounds():
    """A machine that slows down threefold in one round does not change the ratio."""
    base, other = row("a", 2.0, spread=0.5), row("b", 4.0, spread=0.5)
    assert ratio(other, base) == pytest.approx(2.0)
    low, middle, high = difference(other, base)
    assert low < middle < high and middle == pytest.approx(2.0)


def test_two_times_are_told_apart_by_the_sign_of_their_differences():
    def rounds(*times):
        return replace(row("a", 1.0), rounds=times)

    base = rounds(*9 * [1.0])
    assert told_apart(rounds(*9 * [1.1]), base)
    assert told_apart(rounds(*8 * [1.1], 0.5), base)  # 2 · (1 + 9)/512 = 0.039
    assert not told_apart(rounds(*7 * [1.1], 0.5, 0.5), base)  # 2 · (1 + 9 + 36)/512 = 0.18
    assert not told_apart(base, base)
    assert told_apart(rounds(*6 * [0.9]), base)  # 2/64 = 0.031
    assert not told_apart(rounds(*5 * [0.9]), base)  # 2/32 = 0.063
    assert enough(rounds(*6 * [1.0])) and not enough(rounds(*5 * [1.0]))


def test_the_slope_of_a_power_law_is_its_exponent():
    rows = [row("a", 1.0, 3.0 * n**-1.5, n=n) for n in (1, 4, 16, 64)]
    assert slope(rows, "n") == pytest.approx(-1.5)
    assert slope(rows[:1], "n") is None
    assert slope(rows, "other") is None


def test_the_jackknife_of_a_mean_is_its_standard_error(rng):
    batches = list(rng.normal(size=(12, 5)))
    exact = np.std([batch.mean() for batch in batches], ddof=1) / np.sqrt(12)
    assert jackknife(lambda mean: float(np.mean(mean)), batches) == pytest.approx(exact)
