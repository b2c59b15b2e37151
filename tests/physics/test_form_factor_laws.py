"""Form factors: reciprocity, closure, sums, limits, and Nusselt's picture of them.

Bounds: a form factor of compact polygons is good to 1e-10 relative where they are apart and
to 1e-14 absolute where they are not.
"""

import numpy as np
import pytest

from playground.measure.cases.form_factor import box
from playground.measure.cases.formulas import NumPyFormulas
from playground.shading import form_factor_shapes as shapes
from playground.shading.area_light import form_factor
from playground.shading.flat_polygon import ball_around, polygon_area
from playground.shading.form_factor import point_to_disc, point_to_point
from playground.shading.polygon_pair import exchange_area, pair_form_factor
from playground.shading.vector import unit

EXACT = {"rtol": 1e-10, "atol": 1e-14}
SQUARE = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], float)


def turned(rng):
    """A random rotation and a shift: nothing lies along an axis."""
    rotation, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    rotation[:, 0] *= np.sign(np.linalg.det(rotation))
    return lambda points: points @ rotation.T + (3.0, -2.0, 5.0)


def room(size, parts):
    """The six faces of a box, seen from inside, each cut into parts × parts quads."""
    step = np.arange(parts) / parts
    s, t = (x.ravel()[:, None, None] for x in np.meshgrid(step, step))
    faces = []
    for axis in range(3):
        o, n = np.zeros(3), np.eye(3)[axis]
        u, v = np.eye(3)[(axis + 1) % 3], np.eye(3)[(axis + 2) % 3]
        cell = np.array([o, u, u + v, v]) / parts
        low = s * u + t * v + cell
        faces += [low, low[:, ::-1] + n]
    return np.concatenate(faces) * size


@pytest.mark.parametrize("size", [(1, 1, 1), (4, 2, 1), (1, 1, 1 / 64)])
def test_a_box_cut_into_quads_is_closed(rng, size):
    """All that leaves a patch arrives: every row sums to 1, however the box is turned."""
    quads = turned(rng)(room(size, 3))
    exchange = exchange_area(quads[:, None], quads[None])
    factors = exchange / polygon_area(quads)[:, None]
    np.testing.assert_allclose(factors.sum(axis=1), 1, atol=1e-10)
    np.testing.assert_array_equal(exchange.diagonal(), 0)


def test_the_closed_forms_of_a_box_are_those_of_its_polygons():
    size = np.array((3.0, 2.0, 1.0))
    quads = room(size, 1)
    factors = exchange_area(quads[:, None], quads[None]) / polygon_area(quads)[:, None]
    matrix = box({"size": size}, NumPyFormulas())["F"]
    np.testing.assert_allclose(factors, matrix, **EXACT)
    np.testing.assert_allclose(matrix.sum(axis=1), 1, atol=1e-14)
    area = polygon_area(quads)[:, None] * matrix
    np.testing.assert_allclose(area, area.T, rtol=1e-13)


def random_pair(rng):
    a, b = (rng.normal(size=(3, 3)) for _ in range(2))
    return a, b + rng.normal(size=3)


def test_reciprocity(rng):
    """A_a F_ab = A_b F_ba, to the last bit: both are the same sum."""
    seen = 0
    for _ in range(300):
        a, b = random_pair(rng)
        assert exchange_area(a, b) == exchange_area(b, a)
        seen += exchange_area(a, b) > 0
    assert seen > 50


def test_parts_add_up(rng):
    """F to a polygon is the sum of those to its parts, also where it touches or crosses."""
    for _ in range(100):
        a, b = random_pair(rng)
        middle = (b[0] + b[1]) / 2
        parts = np.array([(b[0], middle, b[2]), (middle, b[1], b[2])])
        whole = pair_form_factor(a, b)
        np.testing.assert_allclose(pair_form_factor(a, parts).sum(), whole, rtol=1e-9, atol=1e-13)


@pytest.mark.parametrize("degrees", [15, 45, 90, 135, 175])
@pytest.mark.parametrize("shift", [0.0, 0.5, 1.0])
def test_parts_along_a_common_edge_add_up(rng, degrees, shift):
    """Squares hinged along an edge, whole, half or only at a corner; in halves across the hinge."""
    place = turned(rng)
    x, z = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    other = np.add([(0, 0, 0), (0, 1, 0), (x, 1, z), (x, 0, z)], (0, shift, 0))
    half = SQUARE * (1, 0.5, 1)
    parts = np.array([half, np.add(half, (0, 0.5, 0))])
    whole = exchange_area(place(SQUARE), place(other))
    np.testing.assert_allclose(exchange_area(place(parts), place(other)).sum(), whole, **EXACT)
    assert whole > 0


def test_what_a_polygon_sees_is_the_mean_of_what_its_points_see(rng):
    """F_ab = 1/A_a ∫ F_xb dA: Gauss's points on polygons apart, point by point exact."""
    nodes, weights = np.polynomial.legendre.leggauss(24)
    s, t = np.meshgrid((nodes + 1) / 2, (nodes + 1) / 2)
    points = np.stack([s, t, 0 * s], axis=-1)
    count = 0
    for _ in range(60):
        b = rng.normal(size=(3, 3)) * 0.5 + (0.5, 0.5, 2.5)
        seen = form_factor(points, (0.0, 0.0, 1.0), b, False)
        if (seen > 0).all() and b[:, 2].min() > 1:  # wholly in front of one another
            mean = np.sum(np.outer(weights, weights) / 4 * seen)
            np.testing.assert_allclose(pair_form_factor(SQUARE, b), mean, **EXACT)
            count += 1
    assert count > 10


def test_far_away_only_areas_and_angles_count(rng):
    """F → cos cos A/(π r²), off by the square of size over distance."""
    for distance in (1e2, 1e3, 1e5):
        direction = unit((0.3, -0.4, 0.8))
        b = SQUARE[::-1] @ np.diag((2.0, 1.0, 1.0)) + distance * direction
        normals = (0.0, 0.0, 1.0), (0.0, 0.0, -1.0)
        centre = b.mean(axis=0)
        want = 2.0 * point_to_point((0.5, 0.5, 0.0), normals[0], centre, normals[1])
        got = pair_form_factor(SQUARE, b)
        assert abs(got / want - 1) < 10 / distance**2 + 1e-10
        disc = point_to_disc((0.5, 0.5, 0.0), normals[0], centre, normals[1], 2.0)
        assert abs(got / disc - 1) < 10 / distance**2 + 1e-10


def test_scale_does_not_matter(rng):
    a, b = SQUARE, np.add(SQUARE[::-1], (0.5, 0.25, 0.75))
    want = pair_form_factor(a, b)
    for scale in (1e-30, 1e-6, 1e6, 1e30):
        np.testing.assert_allclose(pair_form_factor(a * scale, b * scale), want, rtol=1e-13)


def test_polygons_without_area_exchange_nothing():
    point, line = np.zeros((4, 3)), np.outer((0, 0.25, 0.5, 1), (1, 1, 2))
    for flat in (point, np.add(line, (0, 0, 1))):
        assert exchange_area(SQUARE, flat) == 0.0
        assert exchange_area(flat, SQUARE) == 0.0


def test_a_repeated_corner_changes_nothing(rng):
    a, b = SQUARE, np.array([(0, 0, 1), (0, 1, 1.5), (1, 0, 1)])
    want = pair_form_factor(a, b)
    for again in ([0, 1, 2, 2], [0, 0, 1, 2], [0, 1, 1, 1, 2]):
        np.testing.assert_allclose(pair_form_factor(a, b[again]), want, rtol=1e-12)


def test_many_pairs_at_once_are_the_same_as_one_by_one(rng):
    """Blocks are seams of the computation alone."""
    a = rng.normal(size=(9000, 4, 3))
    b = rng.normal(size=(9000, 3, 3))
    a[:, 3] = a[:, 2]
    many = exchange_area(a, b)
    for k in range(0, 9000, 500):
        np.testing.assert_allclose(exchange_area(a[k], b[k]), many[k], rtol=1e-9, atol=1e-15)


def test_nusselt(rng):
    """F from a point is the share of the base under the projection onto the hemisphere."""
    b = np.array([(1, 0, 1), (0, 1, 1.5), (1, 1, 0.5)], float)
    if form_factor((0, 0, 0), (0, 0, 1), b, False) == 0.0:
        b = b[::-1]
    n = 400
    s, t = ((np.arange(n) + 0.5) / n for _ in range(2))
    s, t = np.meshgrid(s, t)
    inside = s + t < 1 - 0.5 / n
    x = b[0] + s[..., None] * (b[1] - b[0]) + t[..., None] * (b[2] - b[0])
    base = unit(x)[..., :2]  # straight down from the hemisphere
    du, dv = np.gradient(base, axis=1), np.gradient(base, axis=0)
    area = np.abs(du[..., 0] * dv[..., 1] - du[..., 1] * dv[..., 0])[inside].sum()
    got = form_factor((0, 0, 0), (0, 0, 1), b, False)
    assert abs(area / np.pi - got) < 3 / n * got  # half a cell along the slanted side


def test_a_disc_is_the_mean_of_its_elements():
    """F₂₁ = 1/A₂ ∫ F dA over rings of elements: Howell C-41 from B-13."""
    nodes, weights = np.polynomial.legendre.leggauss(60)
    ring = (nodes + 1) / 2 * 1.5
    seen = shapes.element_to_disc(0.7, ring, 1.1)
    mean = np.sum(weights / 2 * 1.5 * 2 * np.pi * ring * seen) / (np.pi * 1.5**2)
    np.testing.assert_allclose(shapes.coaxial_discs(1.5, 1.1, 0.7), mean, rtol=1e-12)


def test_many_sided_polygons_are_discs():
    """Inscribed n-gons lack 2π²/(3n²) of the area each."""
    angle = 2 * np.pi * np.arange(96) / 96
    ring = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=-1)
    got = exchange_area(ring * 2, np.add(ring[::-1], (0, 0, 1))) / np.pi
    np.testing.assert_allclose(got, shapes.coaxial_discs(1, 2, 1), rtol=2 * np.pi**2 / 96**2)


def test_a_sphere_seen_from_all_sides():
    """The mean of F over all directions of the normal is the sphere's solid angle over 4π.

    For the mean of max(cos, 0) over a sphere is 1/4, and F = 1/π ∫ cos dω. With sin α = r/d that is
    ½ (1 − cos α). The midpoint rule in the cosine is off by some 1/n² where the horizon cuts.
    """
    n = 20000
    cosine = (np.arange(n) + 0.5) / n * 2 - 1
    for distance in (1.01, 2.0, 50.0):
        mean = shapes.element_to_sphere(distance, 1.0, cosine).mean()
        np.testing.assert_allclose(mean, (1 - np.sqrt(1 - 1 / distance**2)) / 2, rtol=100 / n**2)


def test_the_inside_of_a_sphere_is_closed():
    parts = np.array((0.25, 0.5, 1.25))
    assert shapes.sphere_to_zone(1.0, parts).sum() == 1.0
    inner, outer = 0.75, 1.5
    back, itself = shapes.outer_to_inner_sphere(inner, outer), shapes.outer_to_itself(inner, outer)
    assert back + itself == 1.0


def test_balls_hold_their_polygons(rng):
    corners = rng.normal(size=(100, 5, 3))
    centre, radius = ball_around(corners)
    away = np.linalg.norm(corners - centre[:, None], axis=-1)
    np.testing.assert_allclose(away.max(axis=1), radius, rtol=1e-14)
