"""The delta form factors of the hemicube, in both languages."""

import mpmath as mp
import numpy as np
import pytest

from playground.errors import PlaygroundError
from playground.render.gl import probe
from playground.render.radiosity.factor.hemicube_view import (
    delta_form_factors,
    faces_of,
    mended,
    unfolded,
)
from playground.shading import hemicube
from playground.shading.area_light import form_factor
from tests.parity.test_parity import U, assert_close, f32

SIZES = (2, 6, 16, 62, 128, 512)


def pixels(rng, size, side, count=300):
    """Random pixels of a face, with those in its corners."""
    rows = size // 2 if side else size
    column, row = rng.integers(0, size, count), rng.integers(0, rows, count)
    column[:4], row[:4] = (0, size - 1, 0, size - 1), (0, 0, rows - 1, rows - 1)
    return column.astype(np.float64), row.astype(np.float64)


def exact(column, row, size, side):
    """The integral over a pixel from its antiderivative, at 40 digits."""

    def over(x, y):
        """Over the rectangle from the axis to (x, y)."""
        across, up = mp.sqrt(1 + x * x), mp.sqrt(1 + y * y)
        if side:
            return (mp.atan(x) - mp.atan(x / up) / up) / (2 * mp.pi)
        return (x / across * mp.atan(y / across) + y / up * mp.atan(x / up)) / (2 * mp.pi)

    with mp.workdps(40):
        low = 0 if side else size
        x0, x1 = (mp.mpf(2 * int(column) - size + d) / size for d in (0, 2))
        y0, y1 = (mp.mpf(2 * int(row) - low + d) / size for d in (0, 2))
        return over(x1, y1) - over(x0, y1) - over(x1, y0) + over(x0, y0)


@pytest.mark.parametrize("side", [False, True])
@pytest.mark.parametrize("size", SIZES)
def test_the_integral_over_a_pixel(rng, size, side):
    column, row = pixels(rng, size, side, 12)
    got = hemicube.exact_delta_form_factor(column, row, float(size), side)
    for value, i, j in zip(got, column, row, strict=True):
        # The rule leaves 32^-10 = 1e-15 of the integrand; 25 products and their sum 60 roundings.
        assert abs(value / exact(i, j, size, side) - 1) < 2e-14


@pytest.mark.parametrize("size", SIZES)
def test_exact_delta_form_factors_sum_to_1(size):
    assert delta_form_factors(size).sum() == pytest.approx(1.0, abs=1e-13)


def test_those_of_the_midpoint_rule_exceed_1_by_half_over_the_square_of_the_resolution():
    # The midpoint rule is off by h²/24 times the integral of the Laplacian, h = 2/N.
    for size in (16, 64, 256):
        excess = delta_form_factors(size, exact=False).sum() - 1.0
        assert excess * size**2 == pytest.approx(0.542, abs=0.002)


@pytest.mark.parametrize("face", range(5))
def test_a_face_receives_what_its_polygon_would(face):
    """Each face of the table against Lambert's formula for the square or half square."""
    square = np.array([[-1.0, -1.0, 1.0], [1.0, -1.0, 1.0], [1.0, 1.0, 1.0], [-1.0, 1.0, 1.0]])
    if face:
        square[:2, 1] = 0.0
    local = np.array([[hemicube.face_coordinates(e, face)] for e in np.eye(3)])[:, 0]
    corners = square @ local.T  # the axes are orthonormal: the transpose leads back
    want = form_factor(np.zeros(3), np.array([0.0, 0.0, 1.0]), corners, True)
    got = faces_of(delta_form_factors(16))[face].sum()
    assert got == pytest.approx(float(want), abs=1e-14)


def test_the_faces_look_five_ways_and_turn_alike():
    axes = [np.array([hemicube.face_coordinates(e, f) for e in np.eye(3)]).T for f in range(5)]
    ahead = [a[2].tolist() for a in axes]
    assert ahead == [[0, 0, 1], [1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0]]
    assert all(a[1].tolist() == [0, 0, 1] for a in axes[1:])
    assert all(np.linalg.det(a) == pytest.approx(1.0, abs=1e-15) for a in axes)


def test_a_pixel_of_nothing_is_mended_only_among_patches():
    column = np.tile(np.arange(1, 9), (24, 1))  # N = 8: the top is 8 rows, each side 4
    lost = column.copy()
    lost[3, 1] = lost[9, 4] = 0  # alone: on the top, and on the first side
    assert mended(lost)[3, 1] == 1
    assert mended(lost)[9, 4] == 4
    assert np.count_nonzero(mended(lost) != column) == 2
    for kept in ((slice(3, 5), 1), (0, 3), (7, 3), (8, 3), (11, 3), (23, 3), (3, 0), (3, 7)):
        column[:] = np.arange(1, 9)
        column[kept] = 0  # two together, or at the border of a face
        assert np.array_equal(mended(column), column)
    assert mended(np.ones((24, 8), dtype=np.uint16)).dtype == np.uint16


def test_unfolded_the_faces_meet_at_the_edges_of_the_top():
    """Coordinates as colours: laid flat, neighbours across an edge show neighbouring places."""
    size = 8
    centre = (2.0 * np.arange(size) + 1.0) / size - 1.0
    up = (2.0 * np.arange(size // 2) + 1.0) / size
    column = np.zeros((3 * size, size, 3))
    for f, face in enumerate(faces_of(column)):
        v, u = np.meshgrid(up if f else centre, centre, indexing="ij")
        axes = np.array([hemicube.face_coordinates(e, f) for e in np.eye(3)])
        face[...] = np.stack([u, v, np.ones_like(u)], axis=-1) @ axes.T
    flat = np.stack([unfolded(column[..., k], outside=np.nan) for k in range(3)], axis=-1)
    cross_shape = np.isfinite(flat[..., 0])
    assert cross_shape.sum() == 3 * size**2
    for axis in (0, 1):
        step = np.abs(np.diff(flat, axis=axis)).max(axis=-1)
        both = np.isfinite(step)
        # Within a face neighbours are 2/N apart, across an edge 1/N in two coordinates.
        assert step[both].max() == pytest.approx(2.0 / size)
    assert flat[size, -1] == pytest.approx([1.0, 1.0 / size, 1.0 / size])  # right: the tangent
    assert flat[-1, size] == pytest.approx([1.0 / size, 1.0, 1.0 / size])


@pytest.mark.parametrize("far", [(1.0, 1.0), (0.7, 1.6), (2.5, 0.8), (0.6, 0.55)])
def test_a_place_on_a_quad_is_found_again(rng, far):
    s, t = rng.uniform(size=(2, 1000))
    place = np.stack([s * (1 + t * (far[0] - 1)), t * (1 + s * (far[1] - 1))], axis=-1)
    found = hemicube.place_on_quad(place, far)
    # The determinant of the bilinear mean is at least far_x + far_y - 1 = 0.15 here.
    assert np.abs(found - np.stack([s, t], axis=-1)).max() < 20 * 2.0**-53 / 0.15


@pytest.mark.parametrize("resolution", [0, -4, 5000])
def test_a_resolution_that_makes_no_sense(resolution):
    with pytest.raises(PlaygroundError, match="1 to 4096"):
        delta_form_factors(resolution)


def test_an_odd_resolution_is_the_next_even_one():
    assert delta_form_factors(9).shape == (30, 10)


@pytest.mark.gl
@pytest.mark.parametrize("side", [False, True])
@pytest.mark.parametrize("size", SIZES)
def test_parity_of_delta_form_factors(gl, rng, size, side):
    pixel = (*pixels(rng, size, side), np.full(300, float(size)))
    for name, roundings in (("delta_form_factor", 12), ("exact_delta_form_factor", 30)):
        # Coordinates up to 1, off by one rounding, are squared twice: 6 roundings, and 6 more for
        # the products. The exact one adds those of the nodes, and of ten sums.
        want = getattr(hemicube, name)(*pixel, side)
        assert_close(probe.call("hemicube", name, *pixel, side), want, roundings * U * want)


@pytest.mark.gl
def test_parity_of_the_rest(gl, rng):
    u, v, height = f32(rng.uniform(-1, 1, (3, 1000)))
    want = hemicube.delta_density(u, v, height)
    assert_close(probe.call("hemicube", "delta_density", u, v, height), want, 10 * U * np.abs(want))
    local, face = f32(rng.normal(size=(1000, 3))), rng.integers(0, 5, 1000).astype(np.float64)
    got = probe.call("hemicube", "face_coordinates", local, face)
    assert np.array_equal(got, hemicube.face_coordinates(local, face))  # no arithmetic at all
    s, t = rng.uniform(size=(2, 1000))
    far = f32(np.full((1000, 2), (0.7, 1.6)))
    place = f32(np.stack([s * (1 + t * (far[:, 0] - 1)), t * (1 + s * (far[:, 1] - 1))], axis=-1))
    want = hemicube.place_on_quad(place, far)
    # Twenty roundings of numbers up to 2, over a determinant of at least 0.7.
    got = probe.call("hemicube", "place_on_quad", place, far)
    assert_close(got, want, 20 * U * 2 / 0.7)
