"""Directions of any length: tiny, huge, zero, interpolated to almost nothing."""

import mpmath
import numpy as np
import pytest
from exact import (
    assert_within,
    exact,
    f32,
    for_any,
    mp,
    mp_dot,
    mp_unit,
    numbers,
    rows,
    tiny,
    to_mp,
    unit_roundoff,
    vectors,
)
from hypothesis import strategies as st

N = 8


@for_any(v=vectors(N, -105, 125))
def test_unit_at_any_length(formulas, v):
    """Each component is off by 8 u at most: 2.5 for a division, 3 in the root, 2 and 0.5 more.

    From 2^-126 to 2^126, where GLSL promises a division; |v|² over- or underflows in most of it.
    """
    u, got = unit_roundoff(formulas), formulas.vector.unit(v)
    for g, x in zip(got, v, strict=True):
        want = mp_unit(mp(x))
        assert_within(g, want, [8 * u * abs(w) + tiny(formulas) for w in want], f"v {x}")


@for_any(v=vectors(N, -105, 124))
def test_length_at_any_length(formulas, v):
    u, got = unit_roundoff(formulas), formulas.vector.length_any(v)
    want = [mpmath.sqrt(mp_dot(mp(x), mp(x))) for x in v]
    assert_within(got, want, [8 * u * w + tiny(formulas) for w in want])


@for_any(v=vectors(N, -45, 57))
def test_the_short_way_to_unit_in_its_range(gl, v):
    """The `unit_moderate` that fragments use: from 1e-15 to 1e18, as its comment promises."""
    from playground.render.gl import probe

    long_enough = np.linalg.norm(v, axis=1) > 1e-15
    got = probe.call("vector", "unit_moderate", v)
    want = [mp_unit(mp(x)) for x in v]
    for g, w in zip(got[long_enough], np.array(want)[long_enough], strict=True):
        # A square below 2^-126 may be lost: 1e-8 of the length where this is 1e-15.
        assert_within(g, list(w), 8 * 2.0**-24 + 1e-8)


def test_nothing_has_no_direction(formulas):
    zero = np.zeros((1, 3))
    assert not formulas.vector.unit(zero).any()
    assert not formulas.vector.length_any(zero).any()
    assert not formulas.vector.halfway([[0.0, 0.0, 1.0]], [[0.0, 0.0, -1.0]]).any()


@for_any(
    normals=rows(st.one_of(numbers(-1.0, 1.0), st.just(0.0)), N, 3, 3),
    weights=rows(numbers(0.0, 1.0), N, 3),
    opposite=st.booleans(),
)
def test_interpolated_normals_that_almost_vanish(formulas, normals, weights, opposite):
    """The sum of wᵢ nᵢ is off by 3 u of Σ wᵢ |nᵢ|, whatever is left of it; its unit by 8 u more."""
    if opposite:
        normals[:, 1], weights[:, 1] = -normals[:, 0], weights[:, 0]
    u, real = unit_roundoff(formulas), formulas.real
    total = (real(weights)[..., None] * real(normals)).sum(axis=1, dtype=real)
    got = formulas.vector.unit(total)
    for g, n, w in zip(got, normals, weights, strict=True):
        terms = [[a * b for a in exact(row)] for row, b in zip(n, exact(w), strict=True)]
        left = [to_mp(sum(column)) for column in zip(*terms, strict=True)]
        added = [3 * u * to_mp(sum(map(abs, column))) for column in zip(*terms, strict=True)]
        length = mpmath.sqrt(mp_dot(left, left))
        lost = mpmath.sqrt(mp_dot(added, added)) + 3 * tiny(formulas)
        assert np.isfinite(g).all()
        if length > 4 * lost:
            # A vector off by ε of its length turns by at most ε/(1 − ε) < 4/3 ε; so does its unit.
            assert_within(g, mp_unit(left), 8 * u + 4 * lost / length / 3, f"{n} {w}")
        else:
            assert np.linalg.norm(g) == 0.0 or abs(np.linalg.norm(g) - 1.0) < 16 * u


@for_any(n=vectors(N, -100, 100), l=vectors(N, -100, 100))
def test_reflection_of_raw_vectors(formulas, n, l):  # noqa: E741
    """r of unit vectors: 20 u from the length of n, 5 u from l, 9 u from the arithmetic."""
    unit, u = formulas.vector.unit, unit_roundoff(formulas)
    got = formulas.vector.reflection(unit(n), unit(l))
    for g, a, b in zip(got, n, l, strict=True):
        ea, eb = mp_unit(mp(a)), mp_unit(mp(b))
        cosine = mp_dot(ea, eb)
        assert_within(g, [2 * cosine * x - y for x, y in zip(ea, eb, strict=True)], 34 * u)


ANY = st.one_of(st.just(0.0), numbers(-(2.0**126), 2.0**126), numbers(-(2.0**-90), 2.0**-90))


@for_any(
    normal=rows(ANY, N, 3),
    position=rows(ANY, N, 3),
    light=rows(ANY, N, 3),
    eye=rows(ANY, N, 3),
    same=st.booleans(),
    sh=st.sampled_from([0.0, 1.0, 80.0, 1e6]),
)
def test_no_input_makes_a_colour_that_is_no_number(
    formulas, normal, position, light, eye, same, sh
):
    """Vanished normals, a light in the surface, an eye in the light: every factor stays in [0, 1].

    Rounding may lift a factor above 1 by its own error: 16 u for n·l, sh · 64 u of the lobe,
    which is clamped to what a cosine of 1 gives.
    """
    if same:
        light = position
    unit, u = formulas.vector.unit, unit_roundoff(formulas)
    n = unit(normal)
    with np.errstate(over="ignore"):
        l, distance = formulas.light.toward(position / 4, light / 4)  # noqa: E741
        v = unit(eye / 4 - position / 4)
    factors = [
        formulas.phong.diffuse_factor(n, l),
        formulas.phong.specular_factor(n, l, v, sh),
        formulas.phong.blinn_factor(n, l, v, sh),
        formulas.light.attenuation(distance, 1.0, 0.0, 1.0),
    ]
    for factor in factors:
        assert np.isfinite(factor).all()
        assert (factor >= 0.0).all() and (factor <= 1.0 + 64 * u * max(sh, 1.0)).all()
    if same:
        assert not factors[0].any() and not formulas.phong.gate(n, l).any()


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_highlight_below_the_horizon_is_gated(formulas, sign):
    """n·l <= 0: the gate closes exactly; the literal formula goes on shining."""
    n = [[0.0, 0.0, 1.0]]
    l = f32([[0.99, 0.0, sign * 0.05]])  # noqa: E741
    v = f32([[-0.99, 0.0, 0.05]])
    unit = formulas.vector.unit
    assert formulas.phong.gate(unit(n), unit(l))[0] == (sign > 0.0)
    assert formulas.phong.specular_factor(unit(n), unit(l), unit(v), 5.0)[0] > 0.9
