"""The specular term where textbook code fails: sh up to 10^6 next to r·v = 1, 0^0, r·v < 0."""

import mpmath
import numpy as np
import pytest
from exact import (
    assert_within,
    f32,
    for_any,
    mp,
    mp_angle,
    numbers,
    rows,
    tiny,
    unit_roundoff,
    vectors,
)
from hypothesis import strategies as st

N = 8
shininess = st.one_of(
    st.sampled_from([0.0, 1.0, 5.0, 10.0, 20.0, 80.0, 1e3, 1e4, 1e5, 1e6]), numbers(0.0, 2.0**20)
)
# Bases in (0, 1): 1 − 2^-k m crowds next to 1, where the exponent magnifies every error.
near_one = st.builds(
    lambda k, m: float(np.float32(1.0 - m * 2.0**-k)), st.integers(0, 23), st.integers(1, 15)
).filter(lambda x: 0.0 < x < 1.0)
base = st.one_of(near_one, numbers(2.0**-100, 1.0))


def power_error(value, u):
    """The relative error of exp2(y), y = sh·log2 x: 5 roundings of y count y ln 2 each, 8 the rest.

    log2 x: s = (m − 1)/(m + 1) has 3.5 roundings, the polynomial ends in 2, its fit is off
    by 7e-10; the product with sh is the last. exp2 itself may err by 4 u.
    """
    exponent = abs(mpmath.log(value, 2)) if value else 0
    return value * (8 + 5 * exponent) * u


@for_any(x=rows(base, N), sh=rows(shininess, N))
def test_a_power_is_accurate_to_its_own_exponent(formulas, x, sh):
    got = formulas.power.power(x, sh)
    want = [mpmath.power(a, b) for a, b in zip(mp(x), mp(sh), strict=True)]
    u = unit_roundoff(formulas)
    assert_within(got, want, [power_error(w, u) + tiny(formulas) for w in want])


@for_any(gap=rows(st.one_of(numbers(2.0**-60, 0.25), numbers(0.25, 0.5)), N), sh=rows(shininess, N))
def test_what_is_left_of_one_decides(formulas, gap, sh):
    """(1 − t)^sh from t: at t = 2^-60 the base rounds to 1, and yet the result is right."""
    cosine = (formulas.real(1.0) - formulas.real(gap)).astype(formulas.real)
    got = formulas.power.power_below_one(cosine, gap, sh)
    want = [mpmath.power(1 - t, n) for t, n in zip(mp(gap), mp(sh), strict=True)]
    u = unit_roundoff(formulas)
    # Where the logarithm reads the rounded cosine, from t = 0.29, u/cosine is magnified by sh.
    read = [n * u * w / (1 - t) for t, n, w in zip(mp(gap), mp(sh), want, strict=True)]
    far = [r if t > 0.29 else 0 for t, r in zip(gap, read, strict=True)]
    bound = [power_error(w, u) + 2 * r + tiny(formulas) for w, r in zip(want, far, strict=True)]
    assert_within(got, want, bound)


@for_any(x=rows(st.one_of(st.just(0.0), numbers(-2.0, 2.0)), N))
def test_anything_to_the_power_0_is_1(formulas, x):
    assert np.array_equal(formulas.power.power(x, 0.0), np.ones(N))
    gap = formulas.real(1.0) - formulas.real(x)
    assert np.array_equal(formulas.power.power_below_one(x, gap, 0.0), np.ones(N))


@for_any(x=rows(numbers(-2.0, 0.0), N), sh=rows(numbers(2.0**-20, 2.0**20), N))
def test_nothing_shines_behind(formulas, x, sh):
    """max(x, 0)^sh is 0 for x <= 0 and sh > 0, never NaN."""
    assert not formulas.power.power(x, sh).any()
    assert not formulas.power.power_below_one(x, formulas.real(1.0) - formulas.real(x), sh).any()


def angle_bound(angle, slack, sh, u):
    """How far max(cos, 0)^sh moves if the angle does by ``slack``, and the power's own error.

    This is as good as it gets: the angle itself is not known better.
    """

    def value(at):
        cosine = mpmath.cos(min(max(at, 0), mpmath.pi))
        return mpmath.power(cosine, sh) if cosine > 0 else mpmath.mpf(sh == 0)

    middle = value(angle)
    moved = max(abs(value(angle - slack) - middle), abs(value(angle + slack) - middle))
    return middle, moved + power_error(value(max(angle - slack, 0)), u)


@for_any(
    axis=vectors(N, -60, 60).filter(lambda v: np.abs(v).max(axis=1).min() > 0.0),
    turn=rows(numbers(-4.0, 4.0), N, 3),
    sh=st.sampled_from([0.0, 0.5, 1.0, 5.0, 20.0, 80.0, 1e3, 1e4, 1e5, 1e6]),
    width=st.booleans(),
)
def test_the_lobe_at_any_shininess(formulas, axis, turn, sh, width):
    """Raw directions, made unit length and compared: the angle is known to 16 roundings.

    unit: largest component, division, inversesqrt: a component is off by 2 u, the length by 5 u;
    the difference of two units is then off by 4 u across and 10 u along, the latter only
    to second order; d·d has 5 roundings, relative to itself: 3 u of an angle of at most 1.
    """
    spread = 1.0 / np.sqrt(max(sh, 1.0)) if width else 1.0
    length = np.linalg.norm(axis, axis=1, keepdims=True)
    direction = f32(axis + turn * spread * length)
    direction[~direction.any(axis=1)] = [1.0, 0.0, 0.0]
    unit, u = formulas.vector.unit, unit_roundoff(formulas)
    got = formulas.power.lobe(unit(direction), unit(axis), sh)
    for g, r, v in zip(got, direction, axis, strict=True):
        want, bound = angle_bound(mp_angle(mp(r), mp(v)), 16 * u, sh, u)
        assert_within(g, want, bound + tiny(formulas), f"r {r}, v {v}, sh {sh}")


@for_any(
    normal=vectors(N, -60, 60).filter(lambda v: np.abs(v).max(axis=1).min() > 0.0),
    to_light=vectors(N, -60, 60).filter(lambda v: np.abs(v).max(axis=1).min() > 0.0),
    turn=rows(numbers(-3.0, 3.0), N, 3),
    sh=st.sampled_from([1.0, 5.0, 20.0, 80.0, 1e3, 1e4, 1e5, 1e6]),
)
def test_the_highlight_from_raw_vectors(formulas, normal, to_light, turn, sh):
    """max(r·v, 0)^sh from n, l, v of any length: ρ is known to 64 roundings.

    Of r across: 10 u from the length of n, 4 u and 2 u from the directions of n and l,
    6 u from the arithmetic, 2 u from v: 24 u; along: 36 u, which counts at most as an angle.
    In float32 a highlight of sh = 10^6 is off by 0.61 √sh · 64 u = 0.0023 at most, below 1/255.
    """
    l_exact = [mp(v) for v in to_light]
    n_exact = [mp(v) for v in normal]
    mirrored = []
    for n, l in zip(n_exact, l_exact, strict=True):  # noqa: E741
        length = mpmath.sqrt(sum(x * x for x in l))
        factor = 2 * sum(a * b for a, b in zip(n, l, strict=True)) / sum(x * x for x in n)
        mirrored.append([(factor * a - b) / length for a, b in zip(n, l, strict=True)])
    near = np.array([[float(x) for x in r] for r in mirrored])
    to_eye = f32(near + turn / np.sqrt(sh))
    to_eye[~to_eye.any(axis=1)] = [1.0, 0.0, 0.0]
    unit, u = formulas.vector.unit, unit_roundoff(formulas)
    got = formulas.phong.specular_factor(unit(normal), unit(to_light), unit(to_eye), sh)
    for g, r, v in zip(got, mirrored, to_eye, strict=True):
        want, bound = angle_bound(mp_angle(r, mp(v)), 64 * u, sh, u)
        assert_within(g, want, bound + tiny(formulas), f"v {v}, sh {sh}")


@pytest.mark.parametrize("sh", [1e3, 1e4, 1e5, 1e6])
def test_the_textbook_form_fails_where_ours_does_not(formulas, rng, sh):
    """max(dot, 0)^sh in float32: rounding the dot product by u moves the lobe by sh u."""
    v = rng.normal(size=(2000, 3))
    v /= np.linalg.norm(v, axis=1, keepdims=True)
    r = v + rng.normal(size=(2000, 3)) / np.sqrt(sh)
    r = f32(r / np.linalg.norm(r, axis=1, keepdims=True))
    v = f32(v)
    angle = np.array([float(mp_angle(mp(a), mp(b))) for a, b in zip(r, v, strict=True)])
    want = np.exp(sh * np.log(np.cos(angle)))
    cosine = np.minimum(np.sum((r * v).astype(np.float32), axis=1, dtype=np.float32), 1.0)
    textbook = np.max(np.abs(np.power(cosine, np.float32(sh)) - want))
    ours = np.max(np.abs(formulas.power.lobe(r, v, sh) - want))
    # Directions off by 5 u move the lobe by 0.61 √sh · 5 u: 1.8e-4 at sh = 10^6.
    assert ours < 2e-4 and textbook > 10.0 * ours
