"""Area lights in float64 on the GPU against NumPy: formulas, then pictures."""

import numpy as np
import pytest
from test_gpu import SHADINGS, SIZE, assert_exact

import playground as pg
from playground.render.gl import probe
from playground.render.gl.renderer import GLRenderer
from playground.shading import arc, area_light
from playground.shading.vector import unit

pytestmark = pytest.mark.gl
E = 2.0**-53
SQUARE = np.array([(-1, -1, 1), (-1, 1, 1), (1, 1, 1), (1, -1, 1)], float)
ARROW = np.array([(-1, -1, 1), (0, 1.5, 1), (1, -1, 1), (0.125, 0.25, 1)], float)
TWICE = np.array([(-1, -1, 1), (-1, -1, 1), (0, 1, 2), (0.5, 0.5, 1.75), (1, 0, 1.5)], float)
OUTLINES = {"square": SQUARE, "arrow": ARROW, "doubled corner": TWICE, "tiny": 1e-4 * SQUARE}
ABOVE = pg.RectangleLight(position=(1.2, 2, 1.5), facing=(-1, -1.2, -1))
BESIDE = pg.PolygonLight(vertices=((-2, -1, 1), (-2, -1, -1), (-2, 2, 0)), two_sided=True)


def call(library, name, *arguments):
    return probe.call(library, name, *arguments, precision="float64")


def test_angle_of(gl, rng):
    """atan(y, x): three halvings of 4 roundings, the series and the octant: 16 roundings."""
    sizes = 10 ** rng.uniform(-8, 8, (2, 20_000)) * rng.choice([-1, 1], (2, 20_000))
    y, x = np.hstack([sizes, [[0, 0, 1, -1, 3, -3], [1, -1, 0, 0, 3, -3]]])
    want = np.arctan2(y, x)
    assert (np.abs(call("arc", "angle_of", y, x) - want) <= 16 * E * np.abs(want)).all()


def test_one_less_exp(gl, rng):
    y = -(10 ** rng.uniform(-12, 2, 20_000))
    want = -np.expm1(y)
    assert (np.abs(call("arc", "one_less_exp", y) - want) <= 8 * E * want).all()


def places(rng, n):
    """Points all around a polygon near the origin, from 10^-3 of its size to 30 times it."""
    return rng.normal(size=(n, 3)) * 10.0 ** rng.uniform(-3, 1.5, (n, 1))


@pytest.mark.parametrize("two_sided", [False, True])
@pytest.mark.parametrize("name", OUTLINES)
def test_form_factor(gl, rng, name, two_sided):
    """Each of the two promises 2e-15 + 1e-13 F."""
    position, normal, corners = places(rng, 3000), unit(rng.normal(size=(3000, 3))), OUTLINES[name]
    got = call("area_light", "form_factor", position, normal, corners, two_sided)
    want = area_light.form_factor(position, normal, corners, two_sided)
    assert (np.abs(got - want) <= 2 * (2e-15 + 1e-13 * want)).all()
    assert (want > 0).sum() > 300


@pytest.mark.parametrize("exponent", [0.0, 0.5, 1.0, 5.0, 7.5, 80.0, 1e4, 1e6])
@pytest.mark.parametrize("name", OUTLINES)
def test_lobes(gl, rng, name, exponent):
    """Each of the two promises 2e-15 + 1e-11 of it."""
    position, normal, corners = places(rng, 3000), unit(rng.normal(size=(3000, 3))), OUTLINES[name]
    toward = unit(corners.mean(axis=0) - position)
    axis = unit(toward + 0.5 * rng.normal(size=position.shape))
    arguments = axis, corners, exponent, True
    for function, before in (("lobe_integral", ()), ("lobe_integral_above", (normal,))):
        got = call("area_light", function, position, *before, *arguments)
        want = getattr(area_light, function)(position, *before, *arguments)
        assert (np.abs(got - want) <= 2 * (2e-15 + 1e-11 * want)).all(), function


def test_better_than_float32(gl, rng):
    """The limits, points and functions are those of double: 10^-7 is left by none of them."""
    a = rng.normal(size=(2000, 3))
    b, axis = a + rng.normal(size=a.shape), unit(a + rng.normal(size=a.shape))
    for power in (1.0, 21.0, 1e5):
        want = arc.lobe_arc(a, b, axis, power)
        assert np.abs(call("arc", "lobe_arc", a, b, axis, power) - want).max() <= 1e-11
        assert np.abs(probe.call("arc", "lobe_arc", a, b, axis, power) - want).max() > 1e-8


@pytest.mark.parametrize("highlight", ["phong", "blinn"])
@pytest.mark.parametrize("shading", SHADINGS)
def test_pictures(gl, shading, highlight):
    """As without area lights."""
    for gate in (False, True):
        setup = pg.load("sphere").with_(
            shading=shading, highlight=highlight, gate=gate, lights=(ABOVE, BESIDE)
        )
        assert_exact(setup)


def test_a_still_scene_turned_into_constants(gl):
    setup = pg.load("sphere").with_(precision="float64", lights=(ABOVE,))
    with GLRenderer(SIZE) as renderer:
        first = renderer.render(setup).pixels
        for _ in range(10):
            later = renderer.render(setup).pixels
        assert renderer._baked
    assert np.abs(first - later).max() <= 2.0**-24 * max(
        1.0, first.max()
    )  # one rounding to float32
