"""Which texels triangles need, and which point each of them stands for, against dense samples."""

import numpy as np
import pytest

from playground.render.lightmap.cover import INSET, cover, nearest_weights

SIZE = 24
DENSE = 60  # samples along an edge


def inside(rng, count):
    """Barycentric weights (count, 3) all over a triangle, its border and corners included."""
    weights = rng.dirichlet((1.0, 1.0, 1.0), count)
    along = np.linspace(0.0, 1.0, DENSE)
    for k in range(3):
        edge = np.zeros((DENSE, 3))
        edge[:, k], edge[:, (k + 1) % 3] = 1.0 - along, along
        weights = np.concatenate([weights, edge])
    return weights


def triangles(rng):
    return rng.uniform(3.0, SIZE - 3.0, (40, 3, 2))


def read_by(points):
    """Column and row of the texels that bilinear lookups at points (P, 2) weigh above zero."""
    low = np.floor(points - 0.5).astype(int)
    share = points - 0.5 - low
    found = set()
    for x in (0, 1):
        for y in (0, 1):
            weight = np.abs(1 - x - share[:, 0]) * np.abs(1 - y - share[:, 1])
            found |= {tuple(t) for t in (low + np.array([x, y]))[weight > 1e-9]}
    return found


def test_every_texel_that_a_lookup_reads_is_covered(rng):
    for triangle in triangles(rng):
        found = cover(triangle[None], SIZE)
        covered = set(zip(found.column.tolist(), found.row.tolist(), strict=True))
        assert read_by(inside(rng, 4000) @ triangle) <= covered


def test_no_texel_more_than_those(rng):
    """A covered texel is less than one texel away, along u and along v, from some point."""
    for triangle in triangles(rng):
        found = cover(triangle[None], SIZE)
        centre = np.stack([found.column, found.row], axis=1) + 0.5
        points = inside(rng, 4000) @ triangle
        apart = np.abs(points[None] - centre[:, None]).max(axis=2).min(axis=1)
        step = np.abs(np.roll(triangle, 1, axis=0) - triangle).max() / (DENSE - 1)
        assert (apart < 1.0 + step).all()


def test_nearest_points(rng):
    for triangle in triangles(rng):
        at = rng.uniform(0.0, SIZE, (200, 2))
        weights = nearest_weights(np.repeat(triangle[None], 200, axis=0), at)
        assert np.abs(weights.sum(axis=1) - 1.0).max() < 1e-12 and weights.min() >= 0.0
        distance = np.linalg.norm(weights @ triangle - at, axis=1)
        sampled = np.linalg.norm(inside(rng, 2000) @ triangle - at[:, None], axis=2).min(axis=1)
        assert (distance <= sampled + 1e-12).all()


def test_texels_belong_to_the_nearest_triangle():
    """Two halves of a square: each texel inside goes to the half that its centre is in."""
    a, b, c, d = [4.5, 4.5], [14.5, 4.5], [14.5, 14.5], [4.5, 14.5]
    found = cover(np.array([[a, b, c], [a, c, d]]), SIZE)
    assert len(found.column) == 11 * 11  # edges through middles of texels read none beyond
    below = found.column > found.row
    above = found.column < found.row
    assert (found.triangle[below] == 0).all() and (found.triangle[above] == 1).all()


def test_points_keep_off_the_edges():
    square = np.array([[[4.5, 4.5], [14.5, 4.5], [14.5, 14.5]]])
    found = cover(square, SIZE)
    point = np.einsum("tc,tcx->tx", found.weights, square[found.triangle])
    height = np.stack(
        [point[:, 1] - 4.5, 14.5 - point[:, 0], (point[:, 0] - point[:, 1]) / np.sqrt(2.0)]
    )
    # Moved by INSET, and then scaled so that the weights sum to 1: that takes less than a tenth
    # (three weights below 0.01 each were added).
    assert height.min() > 0.9 * INSET
    inner = height.min(axis=0) > 1.0
    centre = np.stack([found.column, found.row], axis=1) + 0.5
    assert np.abs(point - centre)[inner].max() < 1e-12


@pytest.mark.parametrize("corners", [[[5, 5], [5, 5], [5, 5]], [[5, 5], [9, 5], [7, 5]]])
def test_triangles_without_area(corners):
    found = cover(np.array([corners], dtype=float), SIZE)
    assert len(found.column) > 0 and np.isfinite(found.weights).all()
