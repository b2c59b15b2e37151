"""A light in the surface, at the end of the world, in a cone without a penumbra."""

import mpmath
import numpy as np
from exact import (
    assert_within,
    f32,
    for_any,
    mp,
    mp_angle,
    mp_dot,
    mp_unit,
    numbers,
    rows,
    tiny,
    unit_roundoff,
    vectors,
)
from hypothesis import strategies as st

from playground.shading.light import SMALLEST, cone

N = 8
factor = st.one_of(st.just(0.0), numbers(2.0**-60, 2.0**60))


@for_any(position=vectors(N, -60, 100), offset=vectors(N, -60, 100), same=st.booleans())
def test_towards_a_light_however_near_or_far(formulas, position, offset, same):
    """The difference is off by u of itself, so the distance by 9 u, each component by 9 u."""
    light = position if same else f32(position + offset)
    u = unit_roundoff(formulas)
    direction, distance = formulas.light.toward(position, light)
    for g, d, p, q in zip(direction, distance, position, light, strict=True):
        exact = [b - a for a, b in zip(mp(p), mp(q), strict=True)]
        length = mpmath.sqrt(mp_dot(exact, exact))
        assert_within(d, length, 9 * u * length + 2 * tiny(formulas))
        if length == 0:
            assert not g.any()
        elif length > 2.0**-120:  # nearer, float32 has not enough digits left, and 0 is allowed
            bound = [9 * u * abs(w) + tiny(formulas) for w in mp_unit(exact)]
            assert_within(g, mp_unit(exact), bound)


@for_any(
    d=rows(st.one_of(st.just(0.0), numbers(2.0**-100, 2.0**120)), N),
    constant=rows(factor, N),
    linear=rows(factor, N),
    quadratic=rows(factor, N),
)
def test_attenuation_is_finite_everywhere(formulas, d, constant, linear, quadratic):
    """Nothing cancels: 4 roundings of Horner's form and 2.5 u of the division, relative.

    d² may be beyond float32, and all factors may be 0: then 1/2^-126, the largest that is sure.
    """
    u = unit_roundoff(formulas)
    got = formulas.light.attenuation(d, constant, linear, quadratic)
    for g, *k in zip(got, mp(d), mp(constant), mp(linear), mp(quadratic), strict=True):
        want = 1 / max(k[1] + k[2] * k[0] + k[3] * k[0] ** 2, mpmath.mpf(SMALLEST))
        # A product below 2^-126 may be lost where the sum is not much more: as much as the limit.
        lost = 3 * mpmath.mpf(SMALLEST) * want**2
        assert_within(g, want, 7 * u * want + lost + tiny(formulas))


@for_any(
    outer=numbers(2.0**-14, 3.140625),
    share=st.one_of(st.just(1.0), st.just(0.0), numbers(0.0, 1.0)),
)
def test_the_constants_of_a_cone(outer, share):
    """sin²(o/2) to 4 u; the difference as a product to 2 u + (π + 2) u of its factors."""
    inner = float(np.float32(outer * share))
    u = 2.0**-53
    edge, width = cone(inner, outer)
    o, i = mpmath.mpf(outer), mpmath.mpf(inner)
    a, b = mpmath.sin((o + i) / 2), mpmath.sin((o - i) / 2)
    assert_within(edge, mpmath.sin(o / 2) ** 2, 5 * u * mpmath.sin(o / 2) ** 2)
    assert_within(width, a * b, u * b * (mpmath.pi + 5 * a))
    assert (width == 0.0) == (inner == outer)


@for_any(
    axis=vectors(N, -60, 60).filter(lambda v: np.abs(v).max(axis=1).min() > 0.0),
    turn=rows(numbers(-1.5, 1.5), N, 3),
    outer=st.one_of(numbers(2.0**-13, 2.0**-8), numbers(2.0**-8, 3.0)),
    share=st.one_of(st.just(1.0), st.sampled_from([0.99999, 0.999, 0.9]), numbers(0.0, 1.0)),
)
def test_the_cone_from_the_thinnest_penumbra_to_none(formulas, axis, turn, outer, share):
    """smoothstep has slope 1.5: the error is 1.5/width of that of h = sin²(half the angle).

    h = |d|²/4 is off by |d|/2 · 4 u and 25 u² from the directions and 6 u h from its own
    arithmetic; ``edge`` and ``width`` are rounded to u. With no penumbra the step is right wherever
    h and the edge differ by more than that.
    """
    inner = float(np.float32(outer * share))
    length = np.linalg.norm(axis, axis=1, keepdims=True)
    to_point = f32(axis + turn * np.tan(min(outer, 1.5)) * length)
    to_point[~to_point.any(axis=1)] = [1.0, 0.0, 0.0]
    unit, u = formulas.vector.unit, unit_roundoff(formulas)
    edge, width = cone(inner, outer)
    got = formulas.light.spot_cone(unit(axis), unit(to_point), edge, width)
    o, i = mpmath.mpf(outer), mpmath.mpf(inner)
    wide = mpmath.sin((o + i) / 2) * mpmath.sin((o - i) / 2)
    for g, a, p in zip(got, axis, to_point, strict=True):
        half = mpmath.sin(mp_angle(mp(a), mp(p)) / 2)
        h = half**2
        off = 4 * u * half + 25 * u**2 + 6 * u * h + 2 * u * mpmath.sin(o / 2) ** 2
        inside = mpmath.sin(o / 2) ** 2 - h
        if wide == 0:
            assert g in (0.0, 1.0)
            if abs(inside) > off:
                assert g == (inside > 0)
            continue
        x = min(max(inside / wide, 0), 1)
        assert_within(g, x * x * (3 - 2 * x), 1.5 * off / wide + 12 * u, f"{a} {p}")


def test_a_point_on_the_edge_of_a_hard_cone_is_lit(formulas):
    """The axis itself lies in every cone, also in one of half-angle 0."""
    axis = [[0.0, 0.0, -1.0]]
    for angle in (0.0, 2.0**-13, 0.25, 1.5, 3.0):
        edge, width = cone(angle, angle)
        assert formulas.light.spot_cone(axis, axis, edge, width)[0] == 1.0
