"""Every method for form factors, against closed forms, against laws, and against the others."""

import numpy as np
import pytest
from plates import BELOW, adjacent_plates, cube, facing_plates, patches_of, rectangle, room

from playground.render.radiosity.factor.closed_form import ClosedForm, closed_form
from playground.render.radiosity.factor.form_factors import METHODS, open_rows
from playground.render.radiosity.factor.hemisphere import hemisphere, nusselt
from playground.render.radiosity.factor.pairs import exact, near
from playground.scene.settings import FORM_FACTORS, Settings
from playground.shading.area_light import form_factor

# Unit squares that face each other at distance 1, and that share an edge at a right angle: Howell,
# A Catalogue of Radiation Heat Transfer Configuration Factors, C-11 and C-14
FACING, ADJACENT = 0.19982489569838738, 0.20004377607540316
PLATES = [(facing_plates, FACING), (adjacent_plates, ADJACENT)]
THREE_POINTS = 1e-4  # of a factor: 3 × 3 points from `NEAR` on, see pairs.py


def whole(patches, method="closed-form", **knobs):
    return METHODS[method](patches, np.arange(len(patches)), **knobs)


def from_plate_to_plate(patches, factors):
    """The factor of the first plate to the second, of those of their patches."""
    half = len(patches) // 2
    return np.sum(patches.area[:half, None] * factors[:half, half:]) / patches.area[:half].sum()


def test_there_is_every_method_that_settings_know():
    assert set(METHODS) == set(FORM_FACTORS)


@pytest.mark.parametrize(("plates", "expected"), PLATES)
def test_two_plates_are_exact(plates, expected):
    # As near as this they are computed edge by edge, see polygon_pair: errors of 1e-15
    factors = whole(plates())
    np.testing.assert_allclose(factors, expected * (1.0 - np.eye(2)), rtol=1e-13)


@pytest.mark.parametrize("m", [2, 5])
@pytest.mark.parametrize(("plates", "expected"), PLATES)
def test_divided_plates_add_up(plates, expected, m):
    patches = plates(m)
    found = from_plate_to_plate(patches, whole(patches))
    assert found == pytest.approx(expected, rel=THREE_POINTS)


# From one point to the whole of the other side; distances in sides of the squares. Computed by
# Gauss's rule with 24 × 24 points on either square.
@pytest.mark.parametrize(
    ("distance", "too_much"), [(1.0, 0.593), (2.0, 0.160), (3.0, 0.0727), (5.0, 0.0265)]
)
def test_point_to_point_is_too_much_close_by(distance, too_much):
    patches = facing_plates(1, distance)
    ratio = whole(patches, "point-to-point")[0, 1] / whole(patches)[0, 1]
    assert ratio - 1.0 == pytest.approx(too_much, rel=5e-3)  # three digits are given


def test_point_to_polygon_is_exact_for_the_centre():
    patches = room(2, 1)
    found = whole(patches, "point-to-polygon", occlusion=False)
    for i in (0, 9, 30):
        seen = form_factor(patches.centre[i], patches.normal[i], patches.polygon, False)
        np.testing.assert_allclose(found[i], seen, atol=1e-15)


@pytest.mark.parametrize("method", FORM_FACTORS)
def test_patches_that_do_not_face_each_other_exchange_nothing(method):
    patches = patches_of([BELOW, BELOW + np.array([2, 0, 0]), BELOW[::-1]], [(2, 2)] * 3)
    assert not whole(patches, method).any()


@pytest.mark.parametrize("method", FORM_FACTORS)
def test_rows_do_not_depend_on_which_are_asked_for(method):
    patches = room(2, 1)
    rows = whole(patches, method)
    chosen = [30, 3, 3, 17]
    found = METHODS[method](patches, chosen)
    assert found.shape == (4, len(patches))
    np.testing.assert_allclose(found, rows[chosen], atol=1e-15)
    assert METHODS[method](patches, []).shape == (0, len(patches))


@pytest.mark.parametrize(("method", "error"), [("point-to-polygon", 1e-13), ("hemisphere", 1e-13)])
def test_from_a_point_in_a_closed_box_everything_is_seen_once(method, error):
    np.testing.assert_allclose(whole(cube(3), method).sum(axis=1), 1.0, rtol=error)


@pytest.mark.parametrize("points", [3, 4, 6])
def test_rows_of_a_closed_box_sum_to_one(points):
    # The error of g × g points falls as the square of the radius over the distance, per point:
    # (1 / 1.25²)² per point more at the worst; measured it falls faster.
    allowed = THREE_POINTS / (1.25**4) ** (points - 3)
    np.testing.assert_allclose(whole(cube(4), points=points).sum(axis=1), 1.0, rtol=allowed)


def with_triangles(m):
    """The cube with walls that are cut into triangles, pieces of unlike sizes."""
    walls = cube(1).polygon
    pairs = [(wall[[0, 1, 2, 2]], wall[[0, 2, 3, 3]]) for wall in walls[:3]]
    parents = [*(piece for pair in pairs for piece in pair), *walls[3:]]
    return patches_of(parents, [(m, m)] * 6 + [(m + 1, m)] * 3)


def test_triangles_and_quads_together_sum_to_one():
    # Long triangles are nearer, by their size, than squares: five times the error
    patches = with_triangles(3)
    np.testing.assert_allclose(whole(patches).sum(axis=1), 1.0, rtol=5.0 * THREE_POINTS)


@pytest.mark.parametrize("patches", [room(3, 2), with_triangles(2)], ids=["room", "triangles"])
def test_closed_form_is_reciprocal_to_the_last_digits(patches):
    power = whole(patches) * patches.area[:, None]
    np.testing.assert_allclose(power, power.T, rtol=1e-14)


def test_near_pairs_include_all_that_touch():
    patches = room(4, 2)
    i, j = (x.ravel() for x in np.indices((len(patches), len(patches))))
    corners = np.round(patches.polygon, 9)
    common = (corners[i][:, :, None] == corners[j][:, None]).all(axis=-1).any(axis=(1, 2))
    assert common.sum() > 4 * len(patches)
    assert near(patches, i, j)[common].all()


def test_few_points_do_where_they_are_used():
    # Neighbours of touching patches, the nearest that are not computed edge by edge
    patches = adjacent_plates(4)
    i, j = (x.ravel() for x in np.meshgrid(np.arange(16), np.arange(16, 32), indexing="ij"))
    far = ~near(patches, i, j)
    found = whole(patches)[i, j][far]
    correct = exact(patches, i, j)[far] / patches.area[i][far]
    np.testing.assert_allclose(found, correct, rtol=THREE_POINTS)
    assert 0 < far.sum() < len(far)


def test_what_is_known_is_not_computed_again():
    patches = cube(2)
    asked = []

    def pairs(rows, columns):
        asked.append((len(rows), len(columns)))
        return np.ones((len(rows), len(columns))), np.ones((len(rows), len(columns)))

    rows = ClosedForm(patches, gpu=pairs)
    first = rows(np.arange(10))
    np.testing.assert_array_equal(rows([3, 3, 12])[:2], first[[3, 3]])
    rows(np.arange(24))
    assert asked == [(10, 24), (1, 14), (13, 13)]


def test_the_error_of_the_hemisphere_falls_as_stated():
    # Standard error below √(P/5) n^(-3/4); the projection is convex on the unit disc, P < 2π.
    patches = cube(3)
    chosen = np.arange(0, len(patches), 2)
    exact_ = METHODS["point-to-polygon"](patches, chosen)
    for samples in (64, 1024, 16384):
        error = hemisphere(patches, chosen, samples=samples) - exact_
        seen = exact_ > 0.0
        rms = np.sqrt(np.mean(error[seen] ** 2))
        assert rms < np.sqrt(2.0 * np.pi / 5.0) * samples**-0.75
        # n random rays have √(F (1 − F)/n): from 1024 on it is far more
        if samples >= 1024:
            assert rms < 0.5 * np.sqrt(np.mean((exact_ * (1.0 - exact_))[seen]) / samples)


def test_without_occlusion_a_ray_counts_for_every_patch_along_it():
    patches = room(2, 1)
    expected = METHODS["point-to-polygon"](patches, [0, 5, 20], occlusion=False)
    found = hemisphere(patches, [0, 5, 20], occlusion=False, samples=16384)
    # Four standard errors, for 126 factors
    np.testing.assert_allclose(found, expected, atol=4.0 * np.sqrt(2 * np.pi / 5) * 16384**-0.75)
    assert found.sum() > 3.1


def test_the_nusselt_projection_covers_the_form_factor_of_the_base():
    # Many points along the edges of a square, and the shoelace formula
    square = rectangle((0.3, -0.2, 0.4), (0.5, 0.1, 0.3), (-0.2, 0.7, 0.1))[::-1]
    normal = np.array([0.36, 0.48, 0.8])
    share = np.arange(1000)[:, None] / 1000.0
    edges = [a + share * (b - a) for a, b in zip(square, np.roll(square, -1, axis=0), strict=True)]
    x, y = nusselt((0, 0, 0), normal, np.concatenate(edges)).T
    area = 0.5 * abs(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))
    # A chord instead of an arc of h leaves out less than h³/12, h below 1.5/1000 for 4000 of them
    expected = form_factor((0, 0, 0), normal, square, True)
    assert area / np.pi == pytest.approx(float(expected), abs=4000 * 1.5e-3**3 / 12)


def test_the_gpu_agrees_without_occlusion(gl):
    patches = with_triangles(3)
    rows = open_rows(patches, Settings(form_factors="closed-form", occlusion=False), "gl", gl)
    try:
        assert rows.renderer == "gl"
        found = rows(np.arange(len(patches)))
        # What float32 promises for a point and a polygon: 5e-6 of the whole, see area_light.glsl
        np.testing.assert_allclose(found, whole(patches, occlusion=False), atol=5e-6)
    finally:
        rows.close()


def test_the_gpu_agrees_on_what_is_hidden(gl):
    patches = room(4, 2)
    rows = open_rows(patches, Settings(form_factors="closed-form"), "gl", gl)
    try:
        found = np.concatenate([rows([k]) for k in range(len(patches))])
    finally:
        rows.close()
    expected = whole(patches)
    same = np.abs(found - expected) < 5e-6
    # A segment may pass an edge of a block nearer than float32 can tell; one in a thousand does not
    assert same.mean() > 0.999
    assert (found > 0.0).sum() == pytest.approx((expected > 0.0).sum(), rel=1e-3)


def test_rows_say_where_they_were_computed():
    patches = cube(1)
    for method in FORM_FACTORS:
        rows = open_rows(patches, Settings(form_factors=method), "numpy")
        assert rows.renderer == "numpy"
        np.testing.assert_allclose(rows([0, 1]), whole(patches, method)[:2], atol=1e-15)
        rows.close()


def test_the_closed_form_of_a_single_row_needs_no_other(rng):
    patches = room(3, 1)
    i = int(rng.integers(len(patches)))
    np.testing.assert_array_equal(closed_form(patches, [i])[0], whole(patches)[i])
