"""The rivals of the experiments do what they are said to do."""

from contextlib import closing

import numpy as np
import pytest

from playground.measure import area_samples as light
from playground.measure.experiments import EXPERIMENTS, find
from playground.measure.experiments.anti_aliasing import reference_batches
from playground.measure.experiments.area_light import CASES, SHININESS, _closed, judged, reference
from playground.measure.experiments.specular_power import EVALUATIONS
from playground.measure.power_methods import (
    TO_EYE,
    TO_LIGHT,
    blinn,
    exact,
    fitted_exponent,
    methods,
    normals,
)
from playground.shading.area_light import form_factor
from playground.shading.vector import unit

SIDE = 48


@pytest.mark.gl
@pytest.mark.parametrize("quick", [True, False])
@pytest.mark.parametrize("name", EXPERIMENTS)
def test_all_candidates_of_a_case_take_turns(name, quick, gl):
    """What is compared is timed round by round, so that a slower machine slows all of it."""
    groups = [{candidate.case for candidate in group} for group in find(name).groups(quick)]
    assert sum(map(len, groups)) == len(set.union(*groups))


@pytest.mark.parametrize("shininess", [1, 5, 20, 63, 1000])
def test_squaring_is_the_power(shininess):
    found = {m.name: m for m in methods(shininess, (16,))}
    got = found["repeated squaring"].numpy(normals(SIDE))
    # Each of at most 2 log2(n) products rounds once, and squaring doubles what was lost: n eps.
    want = exact(normals(SIDE), shininess)
    np.testing.assert_allclose(got, want, rtol=4 * shininess * 2.0**-53, atol=1e-300)


def test_schlick_touches_the_power_at_both_ends():
    found = {m.name: m for m in methods(20, (16,))}["Schlick"]
    values, want = found.numpy(normals(SIDE)), exact(normals(SIDE), 20)
    assert (values >= want - 1e-12).all()  # x/(n − (n − 1)x) lies above x^n on [0, 1]
    assert values.max() <= 1.0


def test_a_table_errs_as_the_square_of_its_step():
    errors = []
    for method in methods(20, (64, 128, 256)):
        if method.name == "lookup texture":
            wrong = np.abs(method.numpy(normals(SIDE)) - exact(normals(SIDE), 20))
            step = 1.0 / (method.texels - 1)
            assert wrong.max() <= 20 * 19 / 8 * step**2  # max |f''|/8 · step²
            errors.append(wrong.max())
    assert errors[0] > 2 * errors[1] > 4 * errors[2]


@pytest.mark.parametrize("shininess", [5, 80])
def test_no_other_exponent_fits_better(shininess):
    best, steps = fitted_exponent(shininess), np.linspace(0.8, 1.2, 41)
    points = normals(64)
    base = np.maximum(points @ unit(TO_LIGHT + TO_EYE), 0.0)
    wrong = [np.mean((base**e - exact(points, shininess)) ** 2) for e in best * steps]
    assert int(np.argmin(wrong)) == len(steps) // 2
    got = blinn(shininess).numpy(points)
    np.testing.assert_allclose(got, base**best, rtol=1e-12, atol=1e-300)


@pytest.mark.gl
def test_the_pass_computes_what_numpy_does(gl):
    from playground.measure.power_pass import PowerPass

    for method in methods(20, (64, 256)):
        drawn = PowerPass(method, SIDE)
        values = drawn.values()
        drawn.run(EVALUATIONS)
        drawn.close()
        # float32: the cosine is off by some 8 · 2^-24, which the exponent multiplies; the weights
        # of a texture unit have 8 bits, of a step of at most 20/64.
        exponent = fitted_exponent(20) if method.name.startswith("Blinn") else 20
        slack = 20 / 64 / 256 if method.texels else 0.0
        want = method.numpy(normals(SIDE))
        np.testing.assert_allclose(values, want, rtol=0, atol=exponent * 8 * 2.0**-24 + slack)


def test_samples_of_the_square_are_right_on_average(rng):
    points = light.floor((6, 4))
    runs = [
        light.sampled(points, light.diffuse(points), 16, stratified, rng)
        for stratified in (False, True)
        for _ in range(200)
    ]
    want = form_factor(points, np.broadcast_to(light.UP, points.shape), light.CORNERS, False)
    for some in (runs[:200], runs[200:]):
        error = np.std(some, axis=0, ddof=1) / np.sqrt(200)
        # 24 points, 5 standard errors: one failure in 70 000 runs, and the seed is fixed.
        assert (np.abs(np.mean(some, axis=0) - want) < 5 * error).all()
    assert np.std(runs[200:], axis=0).max() < np.std(runs[:200], axis=0).max()


@pytest.mark.parametrize("case", CASES)
def test_the_closed_forms_agree_with_quadrature(case):
    want = reference(case, (8, 6))
    # What `playground.shading.area_light` promises: 2e-15 + 1e-11 of a factor.
    np.testing.assert_allclose(_closed(case, (8, 6)), want, rtol=1e-11, atol=2e-15)


@pytest.mark.gl
@pytest.mark.parametrize(("integral", "case"), [("diffuse", CASES[0]), ("highlight", CASES[1])])
def test_the_shader_sums_what_numpy_sums(gl, integral, case):
    from playground.measure.area_pass import AreaPass

    size, runs = (8, 6), 200
    want = reference(case, size)
    with closing(AreaPass(integral, "closed", 0, SHININESS, size)) as drawn:
        # What the float32 twin promises, and the axis rounded: 2^-23, which the exponent raises.
        rtol = 2e-5 + 20 * 2.0**-23
        np.testing.assert_allclose(drawn.values(), want, rtol=rtol, atol=4e-7)
    spread = []
    for method in ("uniform", "stratified"):
        with closing(AreaPass(integral, method, 16, SHININESS, size)) as drawn:
            some = np.array([drawn.values(seed) for seed in range(runs)], np.float64)
        error = np.std(some, axis=0, ddof=1) / np.sqrt(runs)
        # 48 points, 5 standard errors, and the seeds are fixed; 4e-7 of rounding.
        assert (np.abs(np.mean(some, axis=0) - want) < 5 * error + 4e-7).all()
        spread.append(error.max())
    assert spread[1] < spread[0]


def test_the_errors_of_runs_are_their_mean_with_its_standard_error():
    want = np.full((12, 12), 2.0)
    found = judged([want + 0.2, want - 0.4], want)
    assert found.rmse == pytest.approx(0.15)  # the mean of 0.1 and 0.2
    assert found.uncertainty["rmse"] == pytest.approx(0.05)
    assert judged([want + 0.2], want).uncertainty == {}


def test_the_batches_of_the_reference_are_independent():
    batches = np.array(reference_batches((24, 18), 1))
    assert len(np.unique(batches.reshape(len(batches), -1), axis=0)) == len(batches)
    assert reference_batches((24, 18), 1) is reference_batches((24, 18), 1)
