"""Area lights: closed forms, brute force, and the laws that hold for any polygon."""

from itertools import pairwise

import numpy as np
import pytest

from playground.shading.area_light import form_factor, lobe_integral, lobe_integral_above
from playground.shading.phong import blinn_factor
from playground.shading.polygon import stretch_factor, stretched
from playground.shading.vector import dot, reflection, unit

UP = np.array([0.0, 0.0, 1.0])
ORIGIN = np.zeros(3)
SQUARE = np.array([(-1, -1, 1), (-1, 1, 1), (1, 1, 1), (1, -1, 1)], float)  # shines down
EXPONENTS = (0.0, 0.5, 1.0, 2.0, 5.0, 7.5, 20.0, 81.0, 1e3, 1e5)


def samples(corners, count):
    """Directions ω (M, 3) from the origin to a convex polygon, and dω: Gauss on each triangle."""
    g, w = np.polynomial.legendre.leggauss(count)
    u, v = np.meshgrid((1 + g) / 2, (1 + g) / 2, indexing="ij")
    weight = np.outer(w, w) / 4 * (1 - u)  # the square folded into a triangle (Duffy 1982)
    v = v * (1 - u)
    directions, solid = [], []
    for b, c in pairwise(corners[1:]):
        a = corners[0]
        x = a + u[..., None] * (b - a) + v[..., None] * (c - a)
        distance = np.linalg.norm(x, axis=-1)
        area = np.cross(b - a, c - a)
        directions.append((x / distance[..., None]).reshape(-1, 3))
        solid.append((np.abs(x @ area) * weight / distance**3).ravel())
    return np.concatenate(directions), np.concatenate(solid)


def random_polygon(rng, sides=5):
    """A convex polygon wholly above z = 0, seen from below, at a distance of about its size."""
    angle = np.sort(rng.uniform(0, 2 * np.pi, sides))
    u, v = unit(rng.normal(size=3)), unit(rng.normal(size=3))
    v = unit(np.cross(u, v))
    flat = np.cos(angle)[:, None] * u + np.sin(angle)[:, None] * v
    corners = flat + np.array([*rng.uniform(-1, 1, 2), rng.uniform(1.2, 3.0)])
    facing_away = np.dot(np.cross(u, v), corners[0]) > 0.0
    return corners[::-1] if facing_away else corners


def test_a_square_overhead_has_its_closed_form():
    """Howell C-9, four times: F = 4/(2π) · 2 · x/√(1+x²) · atan(y/√(1+x²)) with x = y = 1."""
    want = 4 / np.pi / np.sqrt(2) * np.arctan(1 / np.sqrt(2))
    np.testing.assert_allclose(form_factor(ORIGIN, UP, SQUARE, False), want, atol=2e-15)


def test_a_polygon_of_many_sides_is_a_disc():
    """F = R²/(R² + h²); n sides of an inscribed polygon lack 2π²/(3n²) of the area."""
    n = 4000
    angle = -2 * np.pi * np.arange(n) / n
    disc = np.stack([2 * np.cos(angle), 2 * np.sin(angle), np.ones(n)], axis=-1)
    got = form_factor(ORIGIN, UP, disc, False)
    assert abs(got - 4 / 5) < 2 * np.pi**2 / (3 * n**2)


@pytest.mark.parametrize("exponent", EXPONENTS)
def test_the_whole_hemisphere_holds_the_whole_lobe(exponent):
    """∫ cos^n over a hemisphere is 2π/(n + 1); a square 10^8 wide leaves a rim of 4·10^-8."""
    huge = SQUARE * (1e8, 1e8, 1.0)
    got = lobe_integral(ORIGIN, UP, huge, exponent, False)
    np.testing.assert_allclose(
        got * (exponent + 1) / (2 * np.pi), 1, atol=1e-11 + 5e-8 * (exponent < 1)
    )
    assert abs(form_factor(ORIGIN, UP, huge, False) - 1) < 1e-14


def test_brute_force_agrees_on_the_form_factor(rng):
    for _ in range(50):
        corners = random_polygon(rng)
        omega, solid = samples(corners, 60)
        np.testing.assert_allclose(
            form_factor(ORIGIN, UP, corners, False), np.sum(omega[:, 2] * solid) / np.pi, rtol=1e-9
        )


@pytest.mark.parametrize("exponent", EXPONENTS[:8])
def test_brute_force_agrees_on_the_lobe(rng, exponent):
    """Where the whole polygon is before the axis the integrand is smooth, and Gauss exact."""
    for _ in range(30):
        corners = random_polygon(rng)
        axis = unit(UP + 0.2 * rng.normal(size=3))
        if (corners @ axis).min() <= 0.05:
            continue
        omega, solid = samples(corners, 90)
        want = np.sum((omega @ axis) ** exponent * solid)
        got = lobe_integral(ORIGIN, axis, corners, exponent, False)
        np.testing.assert_allclose(got, want, rtol=1e-8, atol=1e-12)


def test_random_sampling_agrees_within_its_error(rng):
    """10^6 random points, lobe and horizon cut as they come: within five standard errors."""
    corners = np.array([(1.0, -1.0, -1.0), (1.0, 1.0, -1.0), (1.0, 1.0, 1.0), (1.0, -1.0, 1.0)])
    axis, count = unit(np.array([1.0, 0.4, -0.3])), 1_000_000
    x = np.stack([np.ones(count), *rng.uniform(-1, 1, (2, count))], axis=-1)
    distance = np.linalg.norm(x, axis=-1)
    omega, solid = x / distance[:, None], 4.0 * x[:, 0] / distance**3
    for exponent in (0.0, 5.0, 40.0):
        values = np.maximum(omega @ axis, 0.0) ** exponent * solid
        for above in (False, True):
            seen = values * (omega[:, 2] > 0) if above else values
            got = (
                lobe_integral_above(ORIGIN, UP, axis, corners, exponent, True)
                if above
                else lobe_integral(ORIGIN, axis, corners, exponent, True)
            )
            assert abs(got - seen.mean()) < 5 * seen.std() / np.sqrt(count)
    seen = np.maximum(omega[:, 2], 0.0) * solid / np.pi
    got = form_factor(ORIGIN, UP, corners, True)
    assert abs(got - seen.mean()) < 5 * seen.std() / np.sqrt(count)


@pytest.mark.parametrize("exponent", [0.0, 0.5, 3.0, 20.0, 1e3])
def test_what_is_below_a_plane_does_not_count(rng, exponent):
    """A wall that goes below the horizon is worth as much as its upper part."""
    wall = np.array([(1, -1, -2), (1, 1, -2), (1, 1, 1), (1, -1, 1)], float)
    upper = np.array([(1, -1, 0), (1, 1, 0), (1, 1, 1), (1, -1, 1)], float)
    for _ in range(20):
        axis = unit(np.array([1.0, 0, 0.2]) + 0.5 * rng.normal(size=3))
        got = lobe_integral_above(ORIGIN, UP, axis, wall, exponent, True)
        want = lobe_integral_above(ORIGIN, UP, axis, upper, exponent, True)
        np.testing.assert_allclose(got, want, rtol=1e-11, atol=2e-15)
    for part in (wall, upper):
        np.testing.assert_allclose(
            form_factor(ORIGIN, UP, part, True), form_factor(ORIGIN, UP, upper, True), atol=2e-15
        )


@pytest.mark.parametrize("exponent", [0.0, 2.0, 7.5, 80.0, 1e4])
def test_two_halves_are_worth_the_whole(rng, exponent):
    for _ in range(40):
        whole = random_polygon(rng, 6)
        normal, axis = unit(rng.normal(size=(2, 3)))
        parts = whole[:4], whole[[0, 3, 4, 5]]
        for f in (
            lambda p, n=normal: form_factor(ORIGIN, n, p, False),
            lambda p, a=axis: lobe_integral(ORIGIN, a, p, exponent, False),
            lambda p, n=normal, a=axis: lobe_integral_above(ORIGIN, n, a, p, exponent, False),
        ):
            np.testing.assert_allclose(f(parts[0]) + f(parts[1]), f(whole), rtol=1e-11, atol=1e-14)


def test_a_notch_counts_as_nothing(rng):
    """Not convex: an arrow is a triangle without the notch in its base, wherever it is cut."""
    a, b, c, notch = np.array([(-1, -1, 1), (0, 1.5, 1), (1, -1, 1), (0.1, 0.3, 1)], float)
    for _ in range(40):
        normal, axis = unit(rng.normal(size=(2, 3)))
        for f in (
            lambda *p, n=normal: form_factor(ORIGIN, n, np.array(p), False),
            lambda *p, v=axis: lobe_integral(ORIGIN, v, np.array(p), 12.5, False),
            lambda *p, n=normal, v=axis: lobe_integral_above(
                ORIGIN, n, v, np.array(p), 12.5, False
            ),
        ):
            np.testing.assert_allclose(f(a, b, c, notch), f(a, b, c) - f(a, notch, c), atol=3e-15)


def test_corners_that_coincide_or_lie_on_an_edge_change_nothing(rng):
    more = SQUARE[[0, 0, 1, 2, 2, 3]]
    more = np.insert(more, 3, (SQUARE[1] + SQUARE[2]) / 2, axis=0)
    position = rng.normal(size=(200, 3)) * (1, 1, 0.3)
    normal, axis = unit(rng.normal(size=(2, 200, 3)))
    for f in (
        lambda p: form_factor(position, normal, p, True),
        lambda p: lobe_integral(position, axis, p, 20.0, True),
        lambda p: lobe_integral_above(position, normal, axis, p, 20.0, True),
    ):
        np.testing.assert_allclose(f(more), f(SQUARE), rtol=1e-12, atol=2e-15)


def test_lights_that_touch_leave_no_seam():
    """Two halves of a square meet under the sight line: F is smooth across the seam."""
    left, right = SQUARE * (0.5, 1, 1) - (0.5, 0, 0), SQUARE * (0.5, 1, 1) + (0.5, 0, 0)
    x = np.linspace(-1e-6, 1e-6, 41)
    position = np.stack([x, 0.3 + 0 * x, 1 - 1e-5 + 0 * x], axis=-1)
    halves = sum(form_factor(position, UP, part, False) for part in (left, right))
    np.testing.assert_allclose(halves, form_factor(position, UP, SQUARE, False), atol=4e-15)


def test_sides():
    """From behind a light is dark, unless it has two sides; in its plane it is seen edge-on."""
    below, above, beside = np.array([(0, 0, 0), (0, 0, 2), (3, 0, 1)], float)
    assert form_factor(below, UP, SQUARE, False) == form_factor(below, UP, SQUARE, True) > 0.5
    assert form_factor(above, -UP, SQUARE, False) == 0.0
    assert lobe_integral(above, -UP, SQUARE, 5.0, False) == 0.0
    np.testing.assert_allclose(
        form_factor(above, -UP, SQUARE, True), form_factor(below, UP, SQUARE, True)
    )
    assert form_factor(beside, UP, SQUARE, True) < 2e-15
    assert form_factor(below, -UP, SQUARE, True) == 0.0


@pytest.mark.parametrize("size", [1e-2, 1e-4, 1e-8, 1e-12])
def test_a_small_light_is_a_point_light_of_its_solid_angle(rng, size):
    """F = n·l Ω/π and the lobe (r·l)^sh Ω; the rest is of second order in the size."""
    centre = np.array([0.3, -0.4, 2.0])
    corners = centre + size * (SQUARE - (0, 0, 1))
    to_light, squared = unit(centre), float(centre @ centre)
    solid = 4 * size**2 * to_light[2] / squared
    axis = unit(to_light + 0.1 * rng.normal(size=3))
    bound = 30 * size**2 + 2e-15 / size  # the corners themselves are rounded to 4e-16
    np.testing.assert_allclose(
        form_factor(ORIGIN, UP, corners, False), to_light[2] * solid / np.pi, rtol=bound
    )
    got = lobe_integral(ORIGIN, axis, corners, 20.0, False)
    np.testing.assert_allclose(got, dot(axis, to_light) ** 20 * solid, rtol=20 * bound)


# The measured error of Blinn's highlight, relative to the brightest, at incidences of 0, 30, 60
# and 75 degrees; without the stretch it is 1, 6, 36 and 76 % for a shininess of 20.
BLINN = {20.0: (0.01, 0.031, 0.083, 0.09), 80.0: (0.006, 0.011, 0.021, 0.034)}


@pytest.mark.parametrize("shininess", BLINN)
@pytest.mark.parametrize("tilt", [0, 30, 60, 75])
def test_blinns_highlight_is_approximated(tilt, shininess):
    """The stretched lobe against (n·h)^sh summed over lights around the mirror direction."""
    worst = BLINN[shininess][[0, 30, 60, 75].index(tilt)]
    eye = unit(np.array([np.sin(np.radians(tilt)), 0.0, np.cos(np.radians(tilt))]))
    axis = reflection(UP, eye)
    side, along = np.array([0.0, 1.0, 0.0]), np.cross(axis, [0.0, 1.0, 0.0])
    found, wanted = [], []
    for shift in np.linspace(-0.6, 0.6, 9):
        middle = 3.0 * axis + 3.0 * shift * side
        corners = np.array(
            [middle + 0.4 * (i * side + j * along) for i, j in ((-1, -1), (-1, 1), (1, 1), (1, -1))]
        )
        omega, solid = samples(corners, 30)
        shine = blinn_factor(UP, omega, eye, shininess)
        wanted.append(np.sum(shine * solid))
        lobe = lobe_integral(ORIGIN, axis, stretched(corners, UP, axis), shininess / 4.0, True)
        found.append(lobe * stretch_factor(UP, axis))
    error = np.max(np.abs(np.subtract(found, wanted))) / np.max(wanted)
    assert error <= worst
