"""How prose, formulas and plots are written: numbers, units, degrees, axes."""

import re

import pytest

import playground as pg
from playground.lesson import plot
from playground.lesson.formula import svg
from playground.lesson.prose import filled, parse, written


@pytest.mark.parametrize(
    ("value", "form", "text"),
    [
        (9e-16, ".0e", "9·10⁻¹⁶"),
        (1e-7, ".0e", "10⁻⁷"),
        (-2.5e4, ".1e", "−2.5·10⁴"),
        (0.0, ".0e", "0"),
        (3.0, ".1e", "3.0"),
        (-0.25, ".2f", "−0.25"),
        (52100, ".3g", "5.21·10⁴"),
    ],
)
def test_numbers_are_written_as_one_writes_them(value, form, text):
    assert written(value, form) == text


def test_a_number_and_its_unit_stay_in_one_line():
    (block,) = parse("It is {share:.0f} % of 2 m, 3 cm or 4 more; `5 %` is code.")
    text = filled(block, {"share": 50}).text
    assert text == "It is 50\u00a0% of 2\u00a0m, 3\u00a0cm or 4 more; 5 % is code."


def width(formula):
    """The width of a typeset formula in em."""
    return float(re.search(r'style="width:([\d.]+)em', svg(formula))[1])


def test_a_degree_stands_close_and_a_function_does_not():
    assert width("30°") == width(r"30^\circ") < width(r"30 \circ")
    # A circle half an em wide in letters of 0.7, and the room of a thin space: 0.45 of our 1.18 em.
    # As an operator it would have 0.28 em more.
    assert 0.35 < width("30°") - width("30") < 0.6
    assert width(r"n \sin x") == width(r"n \, \sin x") > width(r"n") + width(r"\sin x")
    nested = width(r"\max(\, \max(a, b), c)") - width(r"\,")
    assert width(r"\max(\max(a, b), c)") == pytest.approx(nested, abs=0.002)  # three are rounded


def test_a_slanted_letter_is_as_wide_as_its_outline():
    drawn = svg("F")
    right = max(float(x) for x in re.findall(r"[MLQC]?([\d.]+) -?[\d.]+", drawn.split('d="')[1]))
    assert float(re.search(r'viewBox="0 \S+ (\S+)', drawn)[1]) >= right - 0.1  # rounded


def told(curves, log):
    """The words that a plot is labelled with: matplotlib says them in its comments."""
    made = plot(
        "A square.", x=("x", [1, 2, 4]), y="y", curves=curves, shows=lambda a: a[2] > 4, log=log
    )
    return re.findall(r"<!-- (.*?) -->", made.svg)


def test_logarithmic_axes_have_plain_numbers():
    words = told({"a": [1, 10, 100]}, "xy")
    assert {"1", "2", "4", "10", "100"} <= set(words)
    assert "1.5" not in words
    assert "1.5" in told({"a": [1, 10, 100]}, "")


@pytest.mark.parametrize(
    ("curves", "log", "said"),
    [
        ({"a": [0, 4, 16]}, "y", "positive numbers only"),
        ({"a": [1, 4, 16]}, "z", "allowed: x, y, xy"),
    ],
)
def test_what_has_no_logarithm_is_refused(curves, log, said):
    with pytest.raises(pg.PlaygroundError, match=said):
        told(curves, log)
