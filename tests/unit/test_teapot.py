"""The Utah teapot against its known measures and against finite differences."""

from __future__ import annotations

import numpy as np
import pytest

from playground.scene.normals import direction, face_normals, weld
from playground.scene.shapes_lattice import lattice
from playground.scene.teapot import MIDDLE_HEIGHT, SCALE, control_points, evaluate, teapot

RIM, BODY, LID, BOTTOM = range(4), range(4, 12), range(20, 28), range(28, 32)


def newell(points):
    """Our coordinates back in Newell's: z up, spout to +x."""
    x, y, z = np.moveaxis(np.asarray(points, dtype=float) / SCALE, -1, 0)
    return np.stack([x, -z, y + MIDDLE_HEIGHT], axis=-1)


def surface(patch, u, v):
    """A patch by de Casteljau's algorithm, which shares nothing with our evaluation."""

    def halve(points, t):
        while len(points) > 1:
            points = points[:-1] * (1 - t) + points[1:] * t
        return points[0]

    return halve(np.array([halve(row, u) for row in patch]), v)


def test_there_are_32_patches_within_newells_box():
    points = newell(control_points())
    assert points.shape == (32, 4, 4, 3)
    np.testing.assert_allclose(points.min(axis=(0, 1, 2)), [-3.0, -2.0, 0.0], atol=1e-12)
    np.testing.assert_allclose(points.max(axis=(0, 1, 2)), [3.525, 2.0, 3.15], atol=1e-12)


def test_numbers_agree_with_the_other_archive():
    # Schneider's list of 1990 (as quoted by freeglut) divides by 3.525 and stands on z = 0.15
    points = newell(control_points()) - [0, 0, 0.15]
    theirs = {
        (0, 0, 1): (0.397163, 0.638298, -0.222411),
        (12, 0, 2): (-0.425532, 0.595745, -0.0851064),
        (14, 2, 2): (-0.751773, 0.223404, -0.0851064),
        (14, 3, 3): (-0.539007, 0.12766, 0.0),
        (16, 1, 2): (0.879433, 0.191489, -0.187234),
        (18, 1, 3): (1.0, 0.664894, 0.0),
        (18, 2, 2): (0.978723, 0.670213, -0.0425532),
        (18, 3, 2): (0.907801, 0.638298, -0.0425532),
        (20, 1, 2): (0.12766, 0.851064, -0.22695),
        (24, 2, 1): (0.368794, 0.680851, -0.206525),
    }
    for place, (x, z, y) in theirs.items():
        np.testing.assert_allclose(points[place] / 3.525, [x, y, z], atol=6e-7)


def test_rings_are_bezier_circles():
    # The inner points of each ring stand 0.56 R out; only the knob's widest ring has 0.5625 R
    for number in [*RIM, *BODY, *LID, *BOTTOM]:
        rings = newell(control_points()[number])
        for row, ring in enumerate(rings):
            radius = np.hypot(ring[0, 0], ring[0, 1])
            inner = 0.5625 if number < 24 and number in LID and row == 1 else 0.56
            np.testing.assert_allclose(
                np.hypot(ring[1, 0], ring[1, 1]), radius * np.hypot(1, inner), atol=1e-12
            )
            assert np.ptp(ring[:, 2]) < 1e-12


@pytest.mark.parametrize(
    ("number", "row", "radius", "height"),
    [
        (0, 0, 1.4, 2.4),
        (0, -1, 1.5, 2.4),
        (4, -1, 2.0, 0.9),
        (8, -1, 1.5, 0.15),
        (20, 0, 0.0, 3.15),
        (20, -1, 0.2, 2.7),
        (24, -1, 1.3, 2.4),
        (28, 0, 0.0, 0.0),
        (28, -1, 1.5, 0.15),
    ],
)
def test_radii_of_the_rings(number, row, radius, height):
    positions, _ = evaluate(control_points()[number], 16)
    ring = newell(positions[row])
    # A cubic arc with inner points at 0.56 R is round to 0.6 percent (0.5523 would do 0.03)
    np.testing.assert_allclose(np.hypot(ring[:, 0], ring[:, 1]), radius, rtol=6e-3, atol=1e-12)
    np.testing.assert_allclose(ring[:, 2], height, atol=1e-12)


@pytest.mark.parametrize("number", range(32))
def test_positions_and_normals_by_de_casteljau_and_finite_differences(number):
    n, step = 5, 1e-5
    patch = control_points()[number]
    positions, normals = evaluate(patch, n)
    for i in range(n + 1):
        for j in range(n + 1):
            u, v = j / n, i / n
            np.testing.assert_allclose(positions[i, j], surface(patch, u, v), atol=1e-15)
            # A collapsed row has no tangent along u: step off it, the limit changes by O(step)
            w = max(v, 1e-4)
            du = surface(patch, u + step, w) - surface(patch, u - step, w)
            dv = surface(patch, u, w + step) - surface(patch, u, w - step)
            np.testing.assert_allclose(
                normals[i, j], direction(np.cross(du, dv)), atol=2e-3 if v == 0 else 1e-7
            )


def test_poles_look_straight_up_and_down():
    for number, y in [(20, 1.0), (21, 1.0), (23, 1.0), (28, -1.0), (31, -1.0)]:
        _, normals = evaluate(control_points()[number], 9)
        assert np.array_equal(normals[0], np.tile([0.0, y, 0.0], (10, 1)))


@pytest.mark.parametrize("tessellation", [1, 2, 5, 10])
def test_mirror_symmetry_is_exact(tessellation):
    mesh = teapot(tessellation)

    def vertices(sign):
        mirror = np.float32([1, 1, sign])
        rows = np.concatenate(
            [mesh.positions * mirror, mesh.normals * mirror], axis=1
        ) + np.float32(0)
        return {tuple(row) for row in rows.tolist()}

    assert vertices(1) == vertices(-1)


@pytest.mark.parametrize("tessellation", [1, 2, 3, 10, 64])
def test_counts(tessellation):
    n, mesh = tessellation, teapot(tessellation)
    flat_lip = 4 if n == 1 else 0
    assert len(mesh.faces) == 64 * n * n - 8 * n - flat_lip
    # Cells share corners within a patch; poles have one vertex per cell
    assert len(mesh.positions) == 32 * (n + 1) ** 2 - 8


@pytest.mark.parametrize("tessellation", [2, 7, 10, 33])
def test_shared_borders_agree_to_the_bit(tessellation):
    places = np.unique(teapot(tessellation).positions, axis=0).astype(float)
    gaps = np.linalg.norm(np.diff(places, axis=0), axis=1)
    # Near misses would be neighbours in this order, 6e-8 apart
    assert gaps.min() > 1e-5


def test_the_only_borders_are_rim_lid_spout_and_handle():
    n = 6
    mesh = teapot(n)
    faces = weld(mesh.positions)[mesh.faces]
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    directed = {tuple(edge) for edge in edges.tolist()}
    assert len(directed) == len(edges), "no edge is walked twice in one direction"
    border = [edge for edge in directed if edge[::-1] not in directed]
    # Inner rim and lid: 4 n each; two ends each of spout and handle: 2 n each
    assert len(border) == 2 * 4 * n + 4 * 2 * n


def test_triangles_agree_with_the_exact_normals():
    for patch in control_points():
        n = 24
        positions, normals = evaluate(patch, n)
        collapsed = bool((patch[0] == patch[0, 0]).all())
        faces = lattice(n, n, first_is_point=collapsed)[:, ::-1]
        geometric = face_normals(positions.reshape(-1, 3), faces)
        middle = direction(normals.reshape(-1, 3)[faces].sum(axis=1))
        assert np.einsum("mi,mi->m", geometric, middle).min() > 0.95


def test_normals_look_outwards():
    mesh = teapot(10)
    # The pot's outer skin looks away from its axis
    body = [evaluate(control_points()[k], 8) for k in BODY]
    for positions, normals in body:
        assert ((positions * normals)[..., [0, 2]].sum(axis=-1) > 0).all()
    assert mesh.volume > 0.9


def test_size_and_place():
    low, high = teapot(32).bounds
    np.testing.assert_allclose(low, [-1, -0.525, -2 / 3], atol=1e-7)
    np.testing.assert_allclose(high, [1.1447, 0.525, 2 / 3], atol=1e-4)


def test_seams_inside_the_pot_are_smooth():
    # Neighbouring rings join with one tangent plane: the normals at a shared place agree
    groups = [*BODY, *BOTTOM]
    points, normals = zip(*(evaluate(control_points()[k], 6) for k in groups), strict=True)
    points, normals = np.concatenate(points).reshape(-1, 3), np.concatenate(normals).reshape(-1, 3)
    place = weld(points)
    first = np.full(place.max() + 1, -1)
    first[place[::-1]] = np.arange(len(place))[::-1]
    np.testing.assert_allclose(normals, normals[first[place]], atol=1e-12)
