"""The formulas in float16 and float32: in the type of their arguments, as exact as it can be.

u = 2^-11 is the rounding of float16, tiny = 2^-25 that of its denormal numbers.
"""

import numpy as np
import pytest

from playground.shading import light, phong, power, vector
from playground.shading.floats import floats

U, TINY = 2.0**-11, 2.0**-25
N = 20_000


def half(a):
    return np.asarray(a, dtype=np.float16)


def directions(rng, n=N):
    v = rng.normal(size=(n, 3))
    return v / np.linalg.norm(v, axis=1, keepdims=True)


def test_the_type_is_that_of_the_arrays():
    assert floats([1, 2], 3.0, np.arange(3))[0].dtype == np.float64
    assert {a.dtype for a in floats(half([1]), 2.0, [3])} == {np.dtype(np.float16)}
    assert {a.dtype for a in floats(half([1]), np.float32(2))} == {np.dtype(np.float32)}
    assert np.isinf(floats(half([1]), 1e6)[1])


@pytest.mark.parametrize("dtype", [np.float16, np.float32, np.float64])
def test_no_formula_changes_the_type(rng, dtype):
    n, l, v = (directions(rng, 50).astype(dtype) for _ in range(3))  # noqa: E741
    x = rng.uniform(0.1, 1.0, 50).astype(dtype)
    results = [
        vector.dot(n, l),
        vector.length_any(n),
        vector.unit(n),
        vector.reflection(n, l),
        vector.halfway(n, l),
        vector.turned_to_eye(n, v),
        power.power(x, 5),
        power.power_below_one(x, 1 - x, 5),
        power.lobe(n, l, 20.0),
        light.attenuation(x, 1.0, 0.1, 0.2),
        *light.toward(n, l),
        light.spot_cone(n, l, 0.1, 0.05),
        light.spot_cone(n, l, 0.1, 0.0),
        phong.component_filter(n, l),
        phong.diffuse_factor(n, l),
        phong.specular_factor(n, l, v, 20),
        phong.blinn_factor(n, l, v, 20),
        phong.gate(n, l),
        phong.diffuse_term(x, n),
        phong.specular_term(x, n),
        phong.emissive_term(n),
        phong.weighted_sum(n, n, n, n),
    ]
    assert {result.dtype for result in results} == {np.dtype(dtype)}


def test_the_diffuse_term_in_float16(rng):
    n, l = half(directions(rng)), half(directions(rng))  # noqa: E741
    m = half(rng.uniform(0, 2, (N, 3)))
    got = phong.diffuse_term(phong.diffuse_factor(n, l), m)
    exact = [np.asarray(a, np.float64) for a in (n, l, m)]
    want = phong.diffuse_term(phong.diffuse_factor(*exact[:2]), exact[2])
    # A component of n·l meets three roundings (its product, two sums), relative to Σ|n_i l_i|;
    # the product with m one more, relative to the result. Second order: (1 + u)^4 < 1 + 4.01u.
    size = np.sum(np.abs(exact[0] * exact[1]), axis=1, keepdims=True)
    bound = 4.01 / 4 * U * (3 * size * exact[2] + want) + 4 * TINY * (1 + exact[2])
    assert (np.abs(got - want) <= bound).all()


@pytest.mark.parametrize("shininess", [5.0, 20.0, 80.0, 1000.0])
def test_the_lobe_in_float16(rng, shininess):
    axis = directions(rng)
    sideways = rng.normal(size=(N, 3)) * 2.0 / np.sqrt(shininess) * rng.uniform(0, 1, (N, 1))
    direction = half(axis + sideways)
    direction, axis = half(vector.unit(direction.astype(np.float64))), half(axis)
    got = power.lobe(direction, axis, shininess).astype(np.float64)
    want = power.lobe(direction.astype(np.float64), axis.astype(np.float64), shininess)
    # t = d·d/2 has 6 roundings relative to it, log1p and the product with sh two more, the
    # shininess none: s = sh·t is off by 8u·s, the value by 8u·s·e^-s <= 8u/e, exp adds u. Where
    # t >= 1/2 the cosine is below 1/2 and off by 3u: sh·3u·2^(1-sh), less than u from sh = 5 on.
    # log1p(-t) instead of -t makes s larger by up to 1.4, which 8/e + 1 + 1 covers.
    assert np.abs(got - want).max() <= (8 / np.e + 2) * U
    naive = power.power(vector.dot(direction, axis), shininess).astype(np.float64)
    if shininess >= 80:  # the dot product's rounding, relative to 1, times the shininess
        assert np.abs(naive - want).max() > 5 * np.abs(got - want).max()


def test_constants_fit_the_type():
    """A guard against division by zero that was 0 in float16 would guard nothing."""
    zero = half([0.0])
    assert np.isfinite(light.attenuation(zero, 0.0, 0.0, 0.0)).all()
    assert not vector.unit(half([[0.0, 0.0, 0.0]])).any()
    small = vector.unit(half([[6e-8, 0.0, 0.0]]))  # the smallest denormal number of all
    assert np.array_equal(small, half([[1.0, 0.0, 0.0]]))
    large = vector.length_any(half([[3e4, 0.0, 4e4]]))
    assert abs(float(large[0]) - 5e4) <= 4 * U * 5e4
