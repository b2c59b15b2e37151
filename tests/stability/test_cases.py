"""Every case of tests/stability/open_cases.json, and the rule by which it is judged.

The file holds 427 problems of 47 kinds, each chosen because a textbook method fails on it,
with answers to 34 digits. What code exists for must pass all of its cases on both backends.
"""

import math
from pathlib import Path

import numpy as np
import pytest

from playground.measure.cases import systems
from playground.measure.cases.case_file import read_cases
from playground.measure.cases.formulas import FORMULAS
from playground.measure.cases.rule import judge, judge_output
from playground.measure.check import check

FILE = Path(__file__).with_name("open_cases.json")
WAITING = {name for name, system in systems.SYSTEMS.items() if system.solve is None}


@pytest.fixture
def cases():
    return read_cases(FILE, "f64")


def all_pass(backend):
    report = check(read_cases(FILE, FORMULAS[backend].precision), backend)
    total = report.total()
    assert [failure.to_dict() for failure in report.failures] == []
    assert total["passed"] + total["unsupported"] == total["cases"] == 427
    for name, tally in report.systems.items():
        if name in WAITING:
            ids = [case_id for reason in tally.unsupported.values() for case_id in reason]
            assert len(set(ids)) == tally.cases and all(tally.unsupported), name
        else:
            assert tally.passed == tally.cases and tally.worst <= 1.0, name


def test_all_cases_pass_in_float64():
    all_pass("numpy")


@pytest.mark.gl
def test_all_cases_pass_in_float32_on_the_gpu(gl):
    all_pass("gl")


def test_every_kind_of_case_is_in_the_file(cases):
    assert {case.system for case in cases} == set(systems.SYSTEMS)


def test_a_textbook_formula_fails(cases, monkeypatch):
    """x^sh as exp(sh log x) of the rounded float32 logarithm: the error that GPUs have."""

    def textbook(inputs, formulas):
        with np.errstate(all="ignore"):
            return {"value": np.exp(inputs["sh"] * np.float64(np.log(np.float32(inputs["x"]))))}

    monkeypatch.setitem(systems.SYSTEMS, "phong_pow", systems.System(textbook))
    chosen = [case for case in cases if case.system == "phong_pow"]
    tally = check(chosen, "numpy").systems["phong_pow"]
    assert tally.failed >= 10 and tally.passed + tally.failed == 18


@pytest.mark.parametrize(
    ("outputs", "ratio"),
    [
        ({"value": math.nan}, math.inf),
        ({"value": math.inf}, math.inf),
        ({"value": [0.5, 0.5]}, math.inf),
        ({"value": "0.5"}, math.inf),
        ({"value": None}, math.inf),
        ({}, math.inf),
    ],
)
def test_no_nonsense_passes(cases, monkeypatch, outputs, ratio):
    monkeypatch.setitem(systems.SYSTEMS, "phong_pow", systems.System(lambda *_: outputs))
    chosen = [case for case in cases if case.system == "phong_pow"]
    report = check(chosen, "numpy")
    assert report.total()["failed"] == 18
    assert {failure.ratio for failure in report.failures} == {ratio}


def test_a_solver_that_breaks_fails_its_case_alone(cases, monkeypatch):
    good = systems.SYSTEMS["phong_pow"].solve

    def breaks_once(inputs, formulas):
        if inputs["x"] == 0.5 and inputs["sh"] == 126.0:
            raise ZeroDivisionError("no number")
        return good(inputs, formulas)

    monkeypatch.setitem(systems.SYSTEMS, "phong_pow", systems.System(breaks_once))
    chosen = [case for case in cases if case.system == "phong_pow"]
    (failure,) = check(chosen, "numpy").failures
    assert failure.id == "POW-O011" and failure.got == "ZeroDivisionError: no number"


# got, expected, tolerance, passes, ratio. ‖(3, 4)‖ = 5: the tolerance of 0.5 + 0.1·5 is 1.
RULE = [
    ([3.0, 5.0], [3.0, 4.0], {"abs": 0.5, "rel": 0.1}, True, 1.0),
    ([2.0, 5.0], [3.0, 4.0], {"abs": 0.5, "rel": 0.1}, True, 1.0),
    ([3.0, 5.5], [3.0, 4.0], {"abs": 0.5, "rel": 0.1}, False, 1.5),
    ([3.0, math.nan], [3.0, 4.0], {"abs": 0.5, "rel": 0.1}, False, math.inf),
    ([3.0], [3.0, 4.0], {"abs": 0.5, "rel": 0.1}, False, math.inf),
    (0.0, 0.0, {"abs": 0.0, "rel": 1e-6}, True, 0.0),
    (1e-300, 0.0, {"abs": 0.0, "rel": 1e-6}, False, math.inf),
    (np.array([[1, 2], [3, 4]]), [[1, 2], [3, 4]], "exact", True, 0.0),
    ([1, 2, 3, 5], [1, 2, 3, 4], "exact", False, math.inf),
    (np.bool_(True), True, "exact", True, 0.0),
    (1e200, 2e200, {"abs": 0.0, "rel": 0.5}, True, 1.0),  # the squares overflow, the norm does not
    (1e-200, 2e-200, {"abs": 0.0, "rel": 0.5}, True, 1.0),  # nor do they vanish
    (1e200, 4e200, {"abs": 0.0, "rel": 0.5}, False, 1.5),
]


@pytest.mark.parametrize(("got", "expected", "tolerance", "passes", "ratio"), RULE)
def test_the_rule(got, expected, tolerance, passes, ratio):
    assert judge(got, expected, tolerance) == (passes, ratio)


@pytest.mark.parametrize(("singular", "passes"), [(True, True), (False, False)])
def test_the_normal_of_a_flattened_surface_has_no_side(singular, passes):
    expected = {"winding_normal": [0.0, 0.0, 1.0], "singular": singular}
    tolerance = {"abs": 0.0, "rel": 1e-6}
    got = judge_output("winding_normal", [0.0, 0.0, -1.0], expected, tolerance)
    assert got[0] is passes
