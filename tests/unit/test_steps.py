"""Generators that are taken to their end, watched, retold and dropped."""

import pytest

from playground.steps import finished, retold


def counting(ended):
    """Yields 1, 2, 3, returns their sum, and says when it is over."""
    try:
        total = 0
        for number in (1, 2, 3):
            yield number
            total += number
        return total
    finally:
        ended.append(True)


def test_the_result_comes_at_the_end_and_steps_are_watched():
    ended, seen = [], []
    assert finished(counting(ended), seen.append) == 6 and finished(counting([])) == 6
    assert seen == [1, 2, 3] and ended == [True]


def test_steps_are_retold_with_the_same_result():
    seen = []
    assert finished(retold(counting([]), str), seen.append) == 6
    assert seen == ["1", "2", "3"]


def test_who_drops_what_is_retold_drops_the_steps():
    ended = []
    steps = retold(counting(ended), str)
    assert next(steps) == "1" and not ended
    steps.close()
    assert ended == [True]


def test_a_watcher_that_fails_ends_the_steps():
    ended = []
    with pytest.raises(ZeroDivisionError):
        finished(counting(ended), lambda step: 1 / 0)
    assert ended == [True]
