"""Shining polygons: tiny, huge, touching, on an axis or an equator, with corners that coincide.

The exact values are sums over edges at 50 digits: Lambert's formula, and for the lobe
∫ (1 − c^(n+1)) dφ / (n + 1) by tanh-sinh quadrature, both after cutting edge by edge.
"""

import mpmath
import numpy as np
import pytest
from exact import assert_within, f32, for_any, mp, mp_dot, mp_unit, numbers, rows, sizes
from hypothesis import strategies as st

# What area_light.py promises: absolute, relative. In float32 some twenty roundings for each of up
# to eight edges, and 4e-6 of Gauss's ten points; see tests/parity/test_area_light_twins.py.
FORM_FACTOR = {"f64": (2e-15, 1e-13), "f32": (4e-7, 5e-6)}
LOBE = {"f64": (2e-15, 1e-11), "f32": (4e-7, 2e-5)}
SIDES = 6
ORIGIN = np.zeros(3)


def cross(a, b):
    return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]


def cut(polygon, up):
    """The part above the plane of ``up`` (Sutherland & Hodgman)."""
    kept = []
    for a, b in zip(polygon, polygon[1:] + polygon[:1], strict=True):
        over, next_over = mp_dot(a, up), mp_dot(b, up)
        if over >= 0:
            kept.append(a)
        if over * next_over < 0:
            share = over / (over - next_over)
            kept.append([x + share * (y - x) for x, y in zip(a, b, strict=True)])
    return kept


def edges(polygon):
    """(a, b, unit normal) of every edge that is one, and does not lead through the point."""
    for a, b in zip(polygon, polygon[1:] + polygon[:1], strict=True):
        m = cross(a, b)
        if any(m):
            yield a, b, mp_unit(m)


def exact_form_factor(polygon, up):
    total = mpmath.mpf(0)
    for a, b, m in edges(cut(polygon, up)):
        angle = mpmath.atan2(mpmath.sqrt(mp_dot(*2 * [cross(a, b)])), mp_dot(a, b))
        total += mp_dot(m, up) * angle
    return abs(total) / (2 * mpmath.pi)


def exact_lobe(polygon, up, axis, exponent):
    power, total = mpmath.mpf(exponent) + 1, mpmath.mpf(0)
    for a, b, m in edges(cut(cut(polygon, up), axis)):
        h = mp_dot(m, axis)
        ahead = cross(m, axis)
        q = mpmath.sqrt(mp_dot(ahead, ahead))
        if abs(h) < 1e-40:  # through the axis: seen from there it has no width
            continue
        if q < 1e-40:  # along the equator, c = 0: the whole angle
            total += mpmath.atan2(mp_dot(cross(a, b), axis), mp_dot(a, b))
            continue
        start, end = (mpmath.atan2(mp_dot(p, ahead), mp_dot(p, axis)) for p in (a, b))

        def slope(t, h=h, q=q):
            cosine, sine = mpmath.cos(t), mpmath.sin(t)
            left = -mpmath.expm1(power * mpmath.log(q * cosine)) if cosine > 0 else 1
            return left * h / (h * h * cosine * cosine + sine * sine)

        scales = [s * x for s in (-1, 1) for x in (abs(h), 8 * abs(h), 1 / mpmath.sqrt(power))]
        inner = sorted(x for x in [0, *scales] if min(start, end) < x < max(start, end))
        places = [min(start, end), *inner, max(start, end)]
        total += mpmath.sign(end - start) * mpmath.quad(slope, places)
    return abs(total) / power


@st.composite
def polygons(draw):
    """A flat polygon of up to `SIDES` corners, convex or not, some of them twice; float32."""
    count = draw(st.integers(3, SIDES))
    turns = sorted(draw(st.lists(st.integers(0, 63), min_size=count, max_size=count, unique=True)))
    radii = draw(st.lists(st.sampled_from([1.0, 1.0, 0.5, 0.125]), min_size=count, max_size=count))
    frame, _ = np.linalg.qr(draw(rows(numbers(-1.0, 1.0), 3, 3)) + np.diag([3.0, 4.0, 5.0]))
    away = draw(sizes(-6, 3)) * frame[2] + draw(sizes(-8, 1)) * frame[0]
    angle = np.array(turns) * np.pi / 32.0
    flat = np.array(radii)[:, None] * (
        np.cos(angle)[:, None] * frame[0] + np.sin(angle)[:, None] * frame[1]
    )
    corners = f32(draw(sizes(-12, 12)) * (flat * draw(sizes(-10, 6)) + away))
    repeated = draw(st.lists(st.integers(0, count - 1), max_size=2))
    return np.insert(corners, repeated, corners[repeated], axis=0)


directions = rows(numbers(-1.0, 1.0), 3).filter(lambda v: v @ v > 0.01)
kinds = st.sampled_from(["anywhere", "corner", "equator", "near equator"])


def axis_of(kind, corners, anywhere, nudge):
    """Any direction, that of a corner, or one with an edge on its equator, or almost."""
    a, b = corners[0], corners[-1]
    around = np.cross(a, b) / max(np.linalg.norm(a) * np.linalg.norm(b), 1e-30)
    if kind == "corner":
        return f32(a / np.linalg.norm(a))
    if kind == "anywhere" or np.linalg.norm(around) < 1e-3:
        return f32(anywhere)
    return f32(around / np.linalg.norm(around) + (kind != "equator") * nudge * anywhere)


def in_both(formulas, vector):
    """The unit vector as a formula sees it: what float32 makes of it is the problem itself."""
    return np.asarray(formulas.vector.unit(vector), np.float64)


@for_any(corners=polygons(), up=directions)
def test_the_form_factor(formulas, corners, up):
    absolute, relative = FORM_FACTOR[formulas.precision]
    up = in_both(formulas, up)
    got = formulas.area_light.form_factor(ORIGIN, up, corners, True)
    want = exact_form_factor([mp(c) for c in corners], mp_unit(mp(up)))
    assert_within(got, want, absolute + relative * want)


@for_any(
    corners=polygons(),
    up=directions,
    anywhere=directions,
    kind=kinds,
    nudge=sizes(-26, -3),
    exponent=st.sampled_from([0.0, 0.01, 0.3, 0.5, 1.0, 2.0, 7.5, 20.0]),
)
def test_the_lobe(formulas, corners, up, anywhere, kind, nudge, exponent):
    absolute, relative = LOBE[formulas.precision]
    up, axis = in_both(formulas, up), axis_of(kind, corners, anywhere, nudge)
    axis = in_both(formulas, axis)
    got = formulas.area_light.lobe_integral_above(ORIGIN, up, axis, corners, exponent, True)
    polygon = [mp(c) for c in corners]
    want = exact_lobe(polygon, mp_unit(mp(up)), mp_unit(mp(axis)), exponent)
    assert_within(got, want, absolute * 2 * np.pi / (exponent + 1) + relative * want)


@pytest.mark.parametrize("exponent", [0.0, 1.0, 7.5])
def test_a_corner_given_twice_on_the_axis_itself(formulas, exponent):
    """a·b − (a·n)(b·n) is all rounding there, and an angle of π would count 8.5 lobes."""
    corner = np.array([-0.10000687092542648, 2.0429043769836426, -0.7108782529830933])
    others = [
        [-0.10630373656749725, 2.0433452129364014, -0.7096992135047913],
        [-0.09585892409086227, 2.038259983062744, -0.7177593111991882],
    ]
    axis = in_both(formulas, corner)
    once, thrice = np.array([corner, *others]), np.array([corner, corner, corner, *others])
    each = [
        formulas.area_light.lobe_integral(ORIGIN, axis, shape, exponent, True)
        for shape in (once, thrice)
    ]
    # No more than the lobe's height times the solid angle of the triangle, 4.84e-6.
    np.testing.assert_allclose(each, 4.84e-6, rtol=1e-2, atol=LOBE[formulas.precision][0])
