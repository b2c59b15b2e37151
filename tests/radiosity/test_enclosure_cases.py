"""Enclosures with other numbers than the case file has, solved independently with 40 digits."""

import mpmath
import numpy as np
import pytest

from playground.measure.cases.formulas import FORMULAS
from playground.measure.cases.systems import SYSTEMS

mp = mpmath.mp.clone()
mp.dps = 40
BACKENDS = ["numpy", pytest.param("gl", marks=pytest.mark.gl)]
F32 = 2.0**-24


@pytest.fixture(params=BACKENDS)
def backend(request):
    if request.param == "gl":
        request.getfixturevalue("gl")
    return request.param


def answered(system, inputs, backend):
    with np.errstate(all="ignore"):
        return SYSTEMS[system].solve(inputs, FORMULAS[backend]())


def exact(matrix, rho, emission):
    """C of (1 − ρ F) C = E, LU with 40 digits."""
    size = len(rho)
    equations = mp.matrix(size, size)
    for i in range(size):
        for j in range(size):
            equations[i, j] = (1 if i == j else 0) - mp.mpf(rho[i]) * matrix[i][j]
    return [float(x) for x in mp.lu_solve(equations, mp.matrix([mp.mpf(e) for e in emission]))]


def close(got, want, relative):
    want = np.asarray(want, np.float64)
    off = np.abs(np.ravel(got) - np.ravel(want)).max() / np.linalg.norm(want)
    assert off <= relative, f"{off:.2e}: {got} != {want}"


def f32(*values):
    return [float(np.float32(value)) for value in values]


@pytest.mark.parametrize("rho", [0.3, 0.75, 0.995, 1 - 2.0**-16, 1 - 2.0**-22])
@pytest.mark.parametrize("bounces", [1, 4, 33, 700, 20_000])
def test_furnaces(backend, rho, bounces):
    (rho,) = f32(rho)
    got = answered("radiosity_furnace", {"emission": 0.7, "rho": rho, "bounces": bounces}, backend)
    e = mp.mpf(0.7) if backend == "numpy" else mp.mpf(f32(0.7)[0])
    limit = 4e-16 if backend == "numpy" else 32 * F32
    close(got["B"], float(e / (1 - mp.mpf(rho))), limit)
    close(got["irradiance"], float(e / (1 - mp.mpf(rho))), limit)
    series = sum((mp.mpf(rho) ** k for k in range(bounces + 1)), mp.mpf(0))
    # expm1 and log1p of 1 − ρ: the exponent moves the value by less than it is itself.
    close(got["B_after_bounces"], float(e * series), 4 * limit)


@pytest.mark.parametrize("size", [3, 8, 20])
@pytest.mark.parametrize("brightest", [0.5, 0.99, 1.0])
def test_any_matrix(backend, rng, size, brightest):
    """Closed or not, reciprocal or not, with F_ii; one black patch where others are white."""
    matrix = rng.random((size, size))
    matrix *= rng.uniform(0.3, 1.0, (size, 1)) / matrix.sum(axis=1, keepdims=True)
    rho, emission = rng.uniform(0.2, brightest, size), rng.random(size)
    rho[0], rho[1] = 0.0, brightest
    inputs = {"F": matrix.tolist(), "rho": rho.tolist(), "emission": emission.tolist()}
    got = answered("radiosity_solve", inputs, backend)
    close(got["B"], exact(matrix, rho, emission), 1e-13)


def opposite(a, b, c):
    """Howell C-11 as published."""
    x, y = mp.mpf(a) / c, mp.mpf(b) / c
    p, q = mp.sqrt(1 + x * x), mp.sqrt(1 + y * y)
    bracket = mp.log(mp.sqrt(p * p * q * q / (1 + x * x + y * y)))
    bracket += x * q * mp.atan(x / q) + y * p * mp.atan(y / p) - x * mp.atan(x) - y * mp.atan(y)
    return 2 * bracket / (mp.pi * x * y)


def adjacent(width, other, edge):
    """Howell C-14 as published."""
    w, h = mp.mpf(width) / edge, mp.mpf(other) / edge
    a, b = 1 + w * w, 1 + h * h
    c, r = 1 + w * w + h * h, mp.sqrt(w * w + h * h)
    logs = mp.log(a * b / c) + w * w * mp.log(w * w * c / (a * r * r))
    logs += h * h * mp.log(h * h * c / (b * r * r))
    angles = w * mp.atan(1 / w) + h * mp.atan(1 / h) - r * mp.atan(1 / r)
    return (angles + logs / 4) / (mp.pi * w)


def test_plates_and_spheres(backend):
    limit = 1e-14 if backend == "numpy" else 32 * F32
    for rho1, rho2, e1, e2 in ((0.3, 0.8, 2.0, 0.5), (1 - 2.0**-14, 0.999, 0.0, 1.0)):
        rho, emission = f32(rho1, rho2), [e1, e2]
        inputs = {"enclosure": "parallel_plates_infinite", "rho": rho, "emission": emission}
        got = answered("radiosity_enclosure", inputs, backend)["B"]
        close(got, exact([[0, 1], [1, 0]], rho, emission), limit)
        for radii in ((0.25, 0.875), (0.0625, 2.0), (0.96875, 1.0)):
            back = (mp.mpf(radii[0]) / mp.mpf(radii[1])) ** 2
            inputs = {
                "enclosure": "concentric_spheres",
                "r_inner": radii[0],
                "r_outer": radii[1],
                "rho": rho,
                "emission": emission,
            }
            got = answered("radiosity_enclosure", inputs, backend)["B"]
            close(got, exact([[0, 1], [back, 1 - back]], rho, emission), limit)


def test_a_sphere_of_zones(backend):
    fractions = [0.5, 0.25, 0.125, 0.0625, 0.0625]
    for rho in ([0.1, 0.9, 0.4, 0.0, 0.7], [1 - 2.0**-12] * 5):
        rho, emission = f32(*rho), [0.0, 3.0, 0.0, 8.0, 0.5]
        inputs = {"enclosure": "sphere_zones", "area_fractions": fractions}
        got = answered("radiosity_enclosure", {**inputs, "rho": rho, "emission": emission}, backend)
        limit = 1e-14 if backend == "numpy" else 16 * F32
        close(got["B"], exact([fractions] * 5, rho, emission), limit)


@pytest.mark.parametrize("size", [(2.0, 2.0, 2.0), (1.0, 3.0, 0.5), (4.0, 0.03125, 1.5)])
def test_boxes(backend, size):
    matrix = [[mp.mpf(0)] * 6 for _ in range(6)]
    for i in range(6):
        for j in range(6):
            p, q = i // 2, j // 2
            if p != q:
                matrix[i][j] = adjacent(size[q], size[p], size[3 - p - q])
            elif i != j:
                matrix[i][j] = opposite(size[(p + 1) % 3], size[(p + 2) % 3], size[p])
    rho, emission = f32(0.9, 0.2, 0.7, 0.5, 0.95, 0.0), [0.0, 1.0, 0.0, 0.0, 0.0, 4.0]
    inputs = {"enclosure": "box_zonal", "size": size, "rho": rho, "emission": emission}
    got = answered("radiosity_enclosure", inputs, backend)
    # At most 1 / (1 − 0.95) times the error of a form factor.
    limit = 20 * (4e-15 if backend == "numpy" else 2 * F32)
    close(got["B"], exact(matrix, rho, emission), limit)


@pytest.mark.parametrize("sides", [(5.0, 12.0, 13.0), (1.0, 1.0, 1.0), (2.0, 1.0, 2.99951171875)])
def test_ducts(backend, sides):
    matrix = [
        [0 if i == j else (mp.mpf(sides[i]) + sides[j] - sides[3 - i - j]) / (2 * mp.mpf(sides[i]))
         for j in range(3)]
        for i in range(3)
    ]  # fmt: skip
    rho, emission = f32(0.6, 0.8, 0.1), [0.5, 0.0, 1.0]
    inputs = {"enclosure": "triangular_duct", "sides": sides, "rho": rho, "emission": emission}
    got = answered("radiosity_enclosure", inputs, backend)
    close(got["B"], exact(matrix, rho, emission), 1e-14 if backend == "numpy" else 8 * F32)


def test_pairs_of_rectangles(backend):
    limit = 1e-14 if backend == "numpy" else 8 * F32
    rho, emission = f32(0.8, 0.35), [0.25, 2.0]
    for a, b, c in ((2.0, 0.5, 0.25), (1.0, 3.0, 8.0)):
        inputs = {"enclosure": "two_opposed_rectangles", "abc": [a, b, c]}
        got = answered("radiosity_enclosure", {**inputs, "rho": rho, "emission": emission}, backend)
        factor = opposite(a, b, c)
        close(got["B"], exact([[0, factor], [factor, 0]], rho, emission), limit)
    for w, h, l in ((0.5, 2.0, 3.0), (4.0, 0.125, 1.0)):  # noqa: E741
        inputs = {"enclosure": "two_perpendicular_rectangles", "whl": [w, h, l]}
        got = answered("radiosity_enclosure", {**inputs, "rho": rho, "emission": emission}, backend)
        matrix = [[0, adjacent(w, h, l)], [adjacent(h, w, l), 0]]
        close(got["B"], exact(matrix, rho, emission), limit)


def test_an_unknown_enclosure_is_a_failed_case():
    with pytest.raises(ValueError, match="unknown kind: torus"):
        answered("radiosity_enclosure", {"enclosure": "torus"}, "numpy")
