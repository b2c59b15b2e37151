"""Area lights: GLSL against the float64 twin, on the same float32 inputs.

The promises of float32. Form factor: 4e-7 + 5e-6 F, from some twenty roundings of 6e-8 in
each of up to six edges, F being a difference of them. Lobe: (4e-7 + 2e-5 M) · 2π/(n + 1), the
same in angles around the axis, plus Gauss's ten points, 4e-6 at worst.
"""

import numpy as np
import pytest

from playground.render.gl import probe
from playground.shading import arc, area_light, polygon
from playground.shading.vector import dot, unit

pytestmark = pytest.mark.gl
U = 2.0**-24
SQUARE = np.array([(-1, -1, 1), (-1, 1, 1), (1, 1, 1), (1, -1, 1)], float)
ARROW = np.array([(-1, -1, 1), (0, 1.5, 1), (1, -1, 1), (0.125, 0.25, 1)], float)
TWICE = np.array([(-1, -1, 1), (-1, -1, 1), (0, 1, 2), (0.5, 0.5, 1.75), (1, 0, 1.5)], float)
OUTLINES = {"square": SQUARE, "arrow": ARROW, "doubled corner": TWICE}


def f32(a):
    return np.asarray(a, dtype=np.float32).astype(np.float64)


def directions(rng, n):
    return f32(unit(rng.normal(size=(n, 3))))


def places(rng, n):
    """Points all around a polygon near the origin, from 10^-3 of its size to 30 times it."""
    return f32(rng.normal(size=(n, 3)) * 10.0 ** rng.uniform(-3, 1.5, (n, 1)))


def assert_within(got, want, bound):
    assert np.isfinite(got).all()
    excess = np.abs(got - want) / bound
    worst = np.argmax(excess)
    assert excess[worst] <= 1.0, f"row {worst}: {got[worst]} != {want[worst]}"


@pytest.mark.parametrize("two_sided", [False, True])
@pytest.mark.parametrize("name", OUTLINES)
def test_form_factor(gl, rng, name, two_sided):
    position, normal, corners = places(rng, 5000), directions(rng, 5000), OUTLINES[name]
    got = probe.call("area_light", "form_factor", position, normal, corners, two_sided)
    want = area_light.form_factor(position, normal, corners, two_sided)
    assert_within(got, want, 4e-7 + 5e-6 * want)
    assert (want > 0).sum() > 500


@pytest.mark.parametrize("exponent", [0.0, 0.5, 1.0, 5.0, 7.5, 20.0, 80.0, 1e3, 1e4, 1e6])
@pytest.mark.parametrize("name", OUTLINES)
def test_lobe_integral(gl, rng, name, exponent):
    position, normal, corners = places(rng, 5000), directions(rng, 5000), OUTLINES[name]
    to_middle = corners.mean(axis=0) - position
    axis = f32(unit(unit(to_middle) + 0.5 * rng.normal(size=position.shape)))
    whole = 2 * np.pi / (exponent + 1)
    got = probe.call("area_light", "lobe_integral", position, axis, corners, exponent, True)
    want = area_light.lobe_integral(position, axis, corners, exponent, True)
    # The axis itself is rounded: it is no unit vector by up to U, which sh raises.
    bound = 4e-7 * max(whole, 1.0) + (2e-5 + 2 * U * exponent) * np.maximum(want, whole * 0.1)
    assert_within(got, want, bound)
    arguments = position, normal, axis, corners, exponent, True
    got = probe.call("area_light", "lobe_integral_above", *arguments)
    want = area_light.lobe_integral_above(*arguments)
    assert_within(got, want, bound)


@pytest.mark.parametrize("size", [1e-2, 1e-4, 1e-6])
def test_small_lights(gl, rng, size):
    """Where the edges cancel, a quadrature keeps 2e-5 of the value itself, however small."""
    normal = directions(rng, 2000)
    position = np.zeros((2000, 3))
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    centre = f32(turn @ (0.25, -0.5, 2.0))
    corners = f32(size * SQUARE @ turn.T) + centre - f32(size * turn[:, 2])
    corners = f32(corners)
    want = area_light.form_factor(position, normal, corners, True)
    high = np.abs(dot(normal, unit(centre))) > 0.1
    got = probe.call("area_light", "form_factor", position, normal, corners, True)
    assert_within(got[high], want[high], 2e-5 * want[high] + 1e-37)
    axis = f32(unit(unit(centre) + 0.1 * rng.normal(size=(2000, 3))))
    got = probe.call("area_light", "lobe_integral", position, axis, corners, 20.0, True)
    want = area_light.lobe_integral(position, axis, corners, 20.0, True)
    assert_within(got, want, 2e-5 * want)


def arcs(rng, n=5000):
    """Ends (n, 3) of arcs of all lengths, float32."""
    a = rng.normal(size=(n, 3))
    return f32(a), f32(a + rng.normal(size=(n, 3)) * 10.0 ** rng.uniform(-3, 1, (n, 1)))


def test_lambert_arc(gl, rng):
    a, b = arcs(rng)
    normal = directions(rng, len(a))
    # Tilt and angle have some ten roundings each; the angle is at most π.
    want = arc.lambert_arc(a, b, normal)
    angle = np.arctan2(np.linalg.norm(np.cross(a, b), axis=1), dot(a, b))
    assert_within(probe.call("arc", "lambert_arc", a, b, normal), want, 24 * U * angle)


def test_turn_arc(gl, rng):
    a, b = arcs(rng)
    axis = directions(rng, len(a))
    # What is left of a vector beside the axis may be short: roundings count by that.
    beside = [np.linalg.norm(np.cross(v, axis), axis=1) / np.linalg.norm(v, axis=1) for v in (a, b)]
    want, got = arc.turn_arc(a, b, axis), probe.call("arc", "turn_arc", a, b, axis)
    apart = np.abs(np.angle(np.exp(1j * (got - want))))  # −π and π are one angle
    assert_within(apart, 0 * want, 24 * U / (beside[0] * beside[1]))


@pytest.mark.parametrize("power", [1.0, 2.0, 8.5, 21.0, 1001.0, 1e5])
def test_lobe_arc(gl, rng, power):
    a, b = arcs(rng)
    axis = f32(
        unit(unit(a + b) + 10.0 ** rng.uniform(-3, 0, (len(a), 1)) * rng.normal(size=a.shape))
    )
    ahead = (dot(a, axis) > 0.05 * np.linalg.norm(a, axis=1)) & (
        dot(b, axis) > 0.05 * np.linalg.norm(b, axis=1)
    )
    a, b, axis = a[ahead], b[ahead], axis[ahead]
    got, want = probe.call("arc", "lobe_arc", a, b, axis, power), arc.lobe_arc(a, b, axis, power)
    # The distance h of the arc from the axis is good to some 10 U/|b − a|, in widths of the lobe.
    short = np.linalg.norm(np.cross(a, b), axis=1) / (dot(a, a) + dot(b, b))
    wide = 10 * U * np.sqrt(power) / np.maximum(short, 1e-3)
    assert_within(got, want, 1e-5 + wide)


def test_stretched(gl, rng):
    offset, normal = f32(rng.normal(size=(5000, 3))), directions(rng, 5000)
    axis = f32(unit(normal + 0.5 * rng.normal(size=(5000, 3))))
    factor = polygon.stretch_factor(normal, axis)
    got = probe.call("polygon", "stretch_factor", normal, axis)
    assert_within(got, factor, 6 * U * np.ones(len(got)))
    got, want = (
        probe.call("polygon", "stretched", offset, normal, axis),
        polygon.stretched(offset, normal, axis),
    )
    # n × r has 4 roundings of its own, which count by 1/|n × r|; the stretch is up to 1/cos θ − 1.
    sine = np.linalg.norm(np.cross(normal, axis), axis=1)
    length = np.linalg.norm(offset, axis=1)
    bound = U * length * (4 + (1 / factor - 1) * (12 / sine + 8 / factor))
    assert_within(np.linalg.norm(got - want, axis=1), 0 * sine, bound)
