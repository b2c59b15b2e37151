"""Closed forms of radiosity: GLSL against float64, on the same float32 inputs; u = 2^-24."""

import numpy as np
import pytest
from test_parity import U, assert_close, f32

from playground.render.gl import probe
from playground.shading import enclosure

pytestmark = pytest.mark.gl
N = 5000


def shares(rng):
    """Reflectances from 0 to 1 − 2^-24, many of them near 1."""
    near = 1.0 - 10.0 ** rng.uniform(-7.0, 0.0, N // 2)
    return np.minimum(f32(np.concatenate([rng.uniform(0.0, 1.0, N // 2), near])), 1.0 - U)


def emissions(rng):
    return f32(rng.uniform(0.0, 4.0, N))


def test_leaving(gl, rng):
    arguments = emissions(rng), shares(rng), emissions(rng)
    want = enclosure.leaving(*arguments)
    assert_close(probe.call("enclosure", "leaving", *arguments), want, 3 * U * want + 1e-37)


@pytest.mark.parametrize("name", ["furnace", "integrating_sphere"])
def test_quotients(gl, rng, name):
    arguments = emissions(rng), shares(rng) + (name == "integrating_sphere") * 2.0**-24
    arguments = tuple(map(f32, arguments))
    want = getattr(enclosure, name)(*arguments)
    # Below 1/2, 1 − ρ is rounded; the quotient has up to 2.5 ulp.
    assert_close(probe.call("enclosure", name, *arguments), want, 8 * U * want)


@pytest.mark.parametrize("bounces", [0.0, 1.0, 2.0, 7.0, 50.0, 1e3, 1e6])
def test_furnace_after(gl, rng, bounces):
    emission, rho = emissions(rng), shares(rng)
    rho[:4] = [0.0, 1.0, 0.5, 1.0 - U]
    got = probe.call("enclosure", "furnace_after", emission, rho, bounces)
    want = enclosure.furnace_after(emission, rho, bounces)
    # The logarithm has 6 roundings, h = ½ (k + 1) log ρ two more: 8 |h| u of e^h, whose absolute
    # value weighs less than what 1 − e^2h is; exp2 is off by 4 u, the series and the quotient
    # have 12 roundings.
    assert_close(got, want, 32 * U * want + 1e-37)


def test_facing(gl, rng):
    arguments = emissions(rng), emissions(rng), shares(rng), shares(rng)
    want = enclosure.facing(*arguments)
    # No subtraction but the exact or harmless 1 − s: 9 roundings.
    assert_close(probe.call("enclosure", "facing", *arguments), want, 12 * U * want + 1e-37)


def test_around_sphere(gl, rng):
    arguments = emissions(rng), emissions(rng), shares(rng), shares(rng), shares(rng)
    want = enclosure.around_sphere(*arguments)
    got = probe.call("enclosure", "around_sphere", *arguments)
    assert_close(got, want, 14 * U * want + 1e-37)  # 11 roundings


def test_duct_factor(gl, rng):
    own, other = f32(rng.uniform(0.5, 2.0, N)), f32(rng.uniform(0.5, 2.0, N))
    wide = rng.uniform(0.0, 1.0, N)
    wide[: N // 2] = 1.0 - 10.0 ** rng.uniform(-7.0, -1.0, N // 2)  # nearly flat
    third = f32(np.abs(own - other) + wide * 2.0 * np.minimum(own, other))
    got = probe.call("enclosure", "duct_factor", own, other, third)
    want = enclosure.duct_factor(own, other, third)
    # The first difference is rounded relative to itself, at most 2; the rest adds 4 roundings.
    assert_close(got, want, 4 * U * want + 0.5 * 2 * U / own)


def test_laws(rng):
    """Three ways to the same numbers, in float64."""
    rho, emission = rng.uniform(0.0, 0.999, 100), rng.uniform(0.1, 2.0, 100)
    everywhere = enclosure.furnace(emission, rho)
    assert enclosure.leaving(emission, rho, everywhere) == pytest.approx(everywhere, rel=1e-14)
    assert enclosure.facing(emission, emission, rho, rho) == pytest.approx(everywhere, rel=1e-13)
    inner = rng.uniform(0.0, 1.0, 100)
    around = enclosure.around_sphere(emission, emission, rho, rho, inner)
    assert around == pytest.approx(everywhere, rel=1e-13)
    sphere = enclosure.integrating_sphere(emission, 1.0 - rho)
    assert sphere == pytest.approx(everywhere, rel=1e-14)
    assert enclosure.furnace_after(emission, rho, 60_000) == pytest.approx(everywhere, rel=1e-13)
    bounces = enclosure.furnace_after(emission, rho, 3)
    assert bounces == pytest.approx(emission * (1 + rho + rho**2 + rho**3), rel=1e-14)
    sides = 3.0, 4.0, 5.0
    for k in range(3):
        own, other, third = np.roll(sides, k)
        both = enclosure.duct_factor(own, other, third) + enclosure.duct_factor(own, third, other)
        assert both == pytest.approx(1.0, rel=1e-15)
