"""Matrices of form factors with known laws: random ones, and a box of points."""

import numpy as np

from playground.render.radiosity.factor.matrix import FormFactors
from playground.render.radiosity.solver.solve import System
from playground.shading.form_factor import point_to_disc


def random_closed(rng, size, spread=0.5):
    """F (N, N) with row sums of 1 and A_i F_ij = A_j F_ji, and the areas A (N,).

    Symmetric positive numbers, scaled on both sides until each row sums to the area of its patch
    (Sinkhorn).
    """
    exchange = rng.random((size, size)) ** 3
    exchange += exchange.T
    np.fill_diagonal(exchange, 0.0)
    area = np.exp(spread * rng.normal(size=size))
    x = np.ones(size)
    for _ in range(500):
        x *= np.sqrt(area / (x * (exchange @ x)))
    factors = exchange * x * x[:, None] / area[:, None]
    assert np.max(np.abs(factors.sum(axis=1) - 1.0)) < 1e-13
    return factors, area


def disc_box(m):
    """The 6 m² patches of a unit cube, their F as discs on their axes, scaled to be closed."""
    middle = (np.arange(m) + 0.5) / m
    u, v = (x.ravel() for x in np.meshgrid(middle, middle))
    places, normals = [], []
    for axis in range(3):
        for side in (0.0, 1.0):
            place, normal = np.zeros((2, m * m, 3))
            place[:, axis], place[:, axis - 2], place[:, axis - 1] = side, u, v
            normal[:, axis] = 1.0 - 2.0 * side
            places.append(place)
            normals.append(normal)
    place, normal = np.concatenate(places), np.concatenate(normals)
    area = m**-2.0
    factors = point_to_disc(place[:, None], normal[:, None], place, normal, area)
    x = np.ones(len(place))
    for _ in range(200):
        x /= np.sqrt(x * (factors @ x))
    return factors * x * x[:, None], np.full(len(place), area)


def some_light(rng, size, rho=0.9, lamps=3):
    """Reflectance, emission and direct light (N, 3); the lamps are black."""
    reflectance = rng.uniform(0.3 * rho, rho, (size, 3))
    emission = np.zeros((size, 3))
    reflectance[:lamps], emission[:lamps] = 0.0, rng.random((lamps, 3))
    direct = 0.1 * rng.random((size, 3)) * (rng.random((size, 1)) < 0.5)
    return reflectance, emission, direct


class Areas:
    """The areas of patches of which nothing else is known."""

    def __init__(self, area):
        self.area = np.asarray(area, float)


def known(matrix, area, normalise=False):
    """Form factors (N, N) that are all known; closed where every row sums to 1 within 0.05."""
    closed = bool(np.all(np.abs(matrix.sum(axis=1) - 1.0) <= 0.05))
    rows = np.array(matrix, float)
    return FormFactors(lambda i: rows[i], Areas(area), normalise, closed=closed, dtype=np.float64)


def system_of(factors, area, reflectance, emission, direct=0.0, **keys):
    """A system of a known matrix, with fresh rows."""
    return System(known(factors, area, **keys), area, reflectance, emission, direct)


def eliminated(factors, reflectance, emission, direct=0.0):
    """The solution C (N, 3) by elimination, channel by channel."""
    first = emission + reflectance * direct
    unit = np.eye(len(factors))
    return np.stack(
        [np.linalg.solve(unit - reflectance[:, [c]] * factors, first[:, c]) for c in range(3)], 1
    )


def grey(size, value):
    """The same number everywhere, (N, 3)."""
    return np.full((size, 3), float(value))
