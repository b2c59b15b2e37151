"""Form factors of every size and distance: what the textbook's formulas lose, these keep.

The exact values are the textbook's own formulas at 70 digits; rectangles in parallel and
perpendicular planes are sums over their corners (Howell C-13, C-15, after Gross, Spindler & Hahne,
Shape-Factor Equations for Radiation Heat Transfer Between Plane Rectangular Surfaces, 1981).
"""

import mpmath
import numpy as np
import pytest
from exact import f32, unit_roundoff

from playground.measure.cases import form_factor as cases

mp = mpmath.mp.clone()
mp.dps = 70


def exact(*values):
    return [mp.mpf(float(v)) for v in values]


def opposite(a, b, c):
    x, y = a / c, b / c
    u, w = mp.sqrt(1 + x * x), mp.sqrt(1 + y * y)
    total = mp.log(u * u * w * w / (1 + x * x + y * y)) / 2
    total += x * w * mp.atan(x / w) - x * mp.atan(x) + y * u * mp.atan(y / u) - y * mp.atan(y)
    return 2 * total / (mp.pi * x * y)


def adjacent(a, b, c):
    w, h = a / c, b / c
    r = mp.sqrt(w * w + h * h)
    total = sum(s * x * mp.atan(1 / x) for s, x in ((1, w), (1, h), (-1, r)))
    logs = mp.log((1 + w * w) * (1 + h * h) / (1 + r * r))
    for x in (w, h):
        logs += x * x * mp.log(x * x * (1 + r * r) / ((1 + x * x) * r * r))
    return (total + logs / 4) / (mp.pi * w)


def discs(r1, r2, h):
    x = 1 + (h * h + r2 * r2) / (r1 * r1)
    return (x - mp.sqrt(x * x - 4 * (r2 / r1) ** 2)) / 2


def element_disc(h, a, r):
    return (
        1 - (h * h + a * a - r * r) / mp.sqrt((h * h + a * a + r * r) ** 2 - (2 * r * a) ** 2)
    ) / 2


def sphere_rectangle(d, a, b):
    return mp.atan(a * b / (d * mp.sqrt(a * a + b * b + d * d))) / (4 * mp.pi)


# kind, exact formula, library, function. All promise at most 40 roundings, relative; an element
# under the inside of a disc, where F is near 1, is absolute in that.
LENGTHS = {
    "opposite": (opposite, "form_factor", "opposite_rectangles"),
    "adjacent": (adjacent, "form_factor", "adjacent_rectangles"),
    "discs": (discs, "form_factor_shapes", "coaxial_discs"),
    "sphere": (sphere_rectangle, "form_factor_shapes", "sphere_to_rectangle"),
    "element": (element_disc, "form_factor_shapes", "element_to_disc"),
}


@pytest.mark.parametrize("kind", LENGTHS)
def test_lengths_of_any_ratio(formulas, rng, kind):
    function, library, name = LENGTHS[kind]
    given = f32(10.0 ** rng.uniform(-3, 3, (3, 250)))
    got = getattr(getattr(formulas, library), name)(*given)
    for row, value in zip(given.T, got, strict=True):
        want = function(*exact(*row))
        under = kind == "element" and row[1] < row[2]  # ½ (1 − Q/P), Q of both signs
        bound = 40 * unit_roundoff(formulas) * (1 if under else want)
        assert abs(mp.mpf(float(value)) - want) <= bound, row


def test_nearly_flat_strips(formulas, rng):
    """Sine and cosine come from the CPU, so the angle may be next to π."""
    angles = [*rng.uniform(0.01, 3.14, 100), *(np.pi - 10.0 ** rng.uniform(-6, -1, 100))]
    for angle in f32(angles):
        a, b = f32(10.0 ** rng.uniform(-3, 3, 2))
        got = cases.strips({"a": a, "b": b, "angle": angle}, formulas)
        p, q, theta = exact(a, b, angle)
        far = mp.sqrt(p * p + q * q - 2 * p * q * mp.cos(theta))
        for key, own in (("F12", p), ("F21", q)):
            want = (p + q - far) / (2 * own)
            # 16 roundings; near π the cosine of half an angle, in float64, has 2^-53/cosine more.
            bound = 16 * unit_roundoff(formulas) + 2.0**-52 / float(mp.cos(theta / 2))
            assert abs(mp.mpf(float(got[key])) - want) <= bound * want, (a, b, angle)


def textbook_sphere(d, r, cosine):
    h = d / r
    c = cosine * h
    if abs(c) >= 1:
        return max(cosine, mp.mpf(0)) / h**2
    q, sine = mp.sqrt(h * h - 1), mp.sqrt(1 - cosine * cosine)
    seen = mp.mpf(1) / 2 - mp.asin(q / (h * sine)) / mp.pi
    seen += cosine * mp.acos(-q * cosine / sine) / (mp.pi * h * h)
    return seen - q * mp.sqrt(1 - c * c) / (mp.pi * h * h)


def test_spheres_on_the_horizon(formulas, rng):
    """Far ones, too: there the textbook's three terms leave nothing of float32."""
    u = unit_roundoff(formulas)
    distance = f32(1 + 10.0 ** rng.uniform(-3, 3, 300))
    c = rng.uniform(-0.95, 1.05, 300)
    cosine = f32(np.clip(c / distance, -1, 1))
    got = formulas.form_factor_shapes.element_to_sphere(distance, np.ones(300), cosine)
    for d, x, value in zip(distance, cosine, got, strict=True):
        want = textbook_sphere(mp.mpf(d), mp.mpf(1), mp.mpf(x))
        # Cut, F is at least of the order of its largest term, 1/H³, times (1 + c)^(5/2), whose
        # slope turns the rounding of c into 5/2 of it; a near sphere's terms are of order 1.
        largest = 1.0 if d < 3 else d**-3.0
        assert abs(mp.mpf(float(value)) - want) <= 40 * u * (want + largest), (d, x)
        assert value >= 0


def parallel_rectangles(a, b):
    """π × 2 A_a F_ab of rectangles (x0, x1, y0, y1) in planes a distance apart."""
    (x, y), (p, q, z) = (a[:2], a[2:]), (b[:2], b[2:4], b[4])
    total = mp.mpf(0)
    for i, j, k, m in np.ndindex(2, 2, 2, 2):
        u, v = x[i] - p[k], y[j] - q[m]
        s, t = mp.sqrt(u * u + z * z), mp.sqrt(v * v + z * z)
        part = v * s * mp.atan(v / s) + u * t * mp.atan(u / t)
        part -= z * z / 2 * mp.log(u * u + v * v + z * z)
        total += (-1) ** (i + j + k + m) * part
    return total


def perpendicular_rectangles(a, b):
    """The same in the planes z = 0 and x = 0: (x0, x1, y0, y1) and (y0, y1, z0, z1)."""
    total = mp.mpf(0)
    for i, j, k, m in np.ndindex(2, 2, 2, 2):
        v, squared = a[2 + j] - b[k], a[i] ** 2 + b[2 + m] ** 2
        s, whole = mp.sqrt(squared), squared + v * v
        part = v * s * mp.atan(v / s) if s else mp.mpf(0)
        part -= (squared - v * v) / 4 * mp.log(whole) if whole else 0
        total -= (-1) ** (i + j + k + m + 1) * part
    return total


def size(rng, low, high):
    return float(f32(10.0 ** rng.uniform(low, high)))


PARALLEL = {  # extents of a and of b, the corner of b, the gap: exponents of 10 or ranges
    "close": ((-0.5, 0.5), None, (0, 0), (-4, -1.5)),
    "over": ((-0.5, 0.5), None, (0, 0), (-1, 0.5)),
    "far": ((-0.5, 0.5), None, (-3, 3), (1, 3.5)),
    "aside": ((-0.5, 0.5), (-0.5, 0.5), (-3, 3), (-0.5, 0.5)),
    "tiny under huge": ((-3, -1.5), (0.5, 1.5), (-1, 0), (-0.5, 0.3)),
}


# Compact polygons: 2e-11 in float64; in float32 5e-6, as each of the 64 points promises of what it
# sees, and their 4e-7 absolute, which as a mean of 64 roundings are an eighth of that.
def assert_pair(formulas, a, b, want, a_area):
    u = unit_roundoff(formulas)
    relative, absolute = (5e-6, 5e-8) if u > 1e-10 else (2e-11, 0.0)
    bound = relative * want + absolute * a_area
    got = cases.pair({"A": a, "B": b}, formulas)
    assert abs(mp.mpf(float(got["F_AB"])) * a_area - want) <= bound, (a, b)
    assert abs(mp.mpf(float(got["F_BA"])) * exact(got["area_B"])[0] - want) <= bound, (b, a)


@pytest.mark.parametrize("kind", PARALLEL)
def test_parallel_rectangles(formulas, rng, kind):
    mine, other, corner, gap = PARALLEL[kind]
    for _ in range(6 if formulas.precision == "f32" else 40):
        w, h = size(rng, *mine), size(rng, *mine)
        p, q = (w, h) if other is None else (size(rng, *other), size(rng, *other))
        x, y = f32(rng.uniform(*corner, 2)) * (p if kind == "tiny under huge" else 1.0)
        x, y, z = float(f32(x)), float(f32(y)), size(rng, *gap)
        end_x, end_y = float(f32(x + p)), float(f32(y + q))
        a = [[0, 0, 0], [w, 0, 0], [w, h, 0], [0, h, 0]]
        b = [[x, y, z], [x, end_y, z], [end_x, end_y, z], [end_x, y, z]]
        want = parallel_rectangles(exact(0, w, 0, h), exact(x, end_x, y, end_y, z)) / (2 * mp.pi)
        assert_pair(formulas, a, b, want, mp.mpf(w) * mp.mpf(h))


PERPENDICULAR = ["hinged", "thin", "long", "corner", "half", "apart"]


@pytest.mark.parametrize("kind", PERPENDICULAR)
def test_perpendicular_rectangles(formulas, rng, kind):
    for _ in range(6 if formulas.precision == "f32" else 40):
        x0, y0, z0 = 0.0, 0.0, 0.0
        w, h, d = (size(rng, -0.5, 0.5) for _ in range(3))
        y1 = h
        if kind == "thin":
            w = size(rng, -3.5, -2)
        if kind == "long":
            w, d = size(rng, 1, 2), size(rng, -2, -1)
        if kind == "corner":
            y0, y1 = h, float(f32(2 * h))
        if kind == "half":
            y0, y1 = float(f32(0.375 * h)), float(f32(1.25 * h))
        if kind == "apart":
            x0, z0 = size(rng, -1, 0.3), size(rng, -1, 0.3)
        x1, z1 = float(f32(x0 + w)), float(f32(z0 + d))
        a = [[x0, 0, 0], [x1, 0, 0], [x1, h, 0], [x0, h, 0]]
        b = [[0, y0, z0], [0, y1, z0], [0, y1, z1], [0, y0, z1]]
        want = perpendicular_rectangles(exact(x0, x1, 0, h), exact(y0, y1, z0, z1)) / (2 * mp.pi)
        assert_pair(formulas, a, b, want, (mp.mpf(x1) - mp.mpf(x0)) * mp.mpf(h))
