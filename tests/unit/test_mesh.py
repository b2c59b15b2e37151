"""A mesh is sound whatever it was made from: no NaN, no degenerate triangle, no surprise."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from playground.errors import PlaygroundError
from playground.scene.mesh import Mesh
from playground.scene.normals import (
    angle_weighted_normals,
    corner_angles,
    face_normals,
    flat,
    smooth,
)

SQUARE = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
HALVES = [[0, 1, 2], [0, 2, 3]]
CORNER = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
TETRAHEDRON = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
NAN, INF = float("nan"), float("inf")


def test_arrays_have_their_types_and_are_locked():
    positions = np.array(SQUARE, dtype=np.float32)
    mesh = Mesh.create(positions, HALVES, texcoords=positions[:, :2], name="square")
    expected = {
        "positions": "float32",
        "normals": "float32",
        "faces": "int32",
        "texcoords": "float32",
    }
    for field, dtype in expected.items():
        array = getattr(mesh, field)
        assert array.dtype == dtype and array.flags.c_contiguous and not array.flags.writeable
    positions[0] = 9.0
    assert mesh.positions[0].tolist() == [0.0, 0.0, 0.0]


def test_direct_construction_locks_too():
    positions = np.array(SQUARE, dtype=np.float32)
    mesh = Mesh(positions, np.tile(np.float32([0, 0, 1]), (4, 1)), np.int32(HALVES))
    assert positions.flags.writeable and not mesh.positions.flags.writeable


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"positions": [[0, 0, 0], [1, NAN, 0], [0, 1, 0]]}, ["positions[1][1]", "nan"]),
        ({"positions": [[0, 0, 0], [1, 0, 0], [0, INF, 0]]}, ["positions[2][1]", "inf"]),
        (
            {"positions": [[0, 0, 0], [1e39, 0, 0], [0, 1, 0]]},
            ["positions[1][0]", "1e+39", "3.4e38"],
        ),
        ({"positions": [[0, 0], [1, 0], [0, 1]]}, ["positions", "(3, 2)", "(N, 3)"]),
        ({"positions": [["a", 0, 0]] * 3}, ["positions", "numbers"]),
        ({"positions": [[0, 0, 0], [1, 0]]}, ["positions", "numbers"]),
        ({"faces": [[0, 1, 3]]}, ["faces[0][2]", "got 3", "0 to 2"]),
        ({"faces": [[0, 1, -1]]}, ["faces[0][2]", "got -1"]),
        ({"faces": np.zeros((0, 3), int)}, ["faces", "(0, 3)", "at least one triangle"]),
        ({"faces": [[0, 1, 2, 0]]}, ["faces", "(1, 4)"]),
        ({"faces": [[0.0, 1.0, 2.0]]}, ["faces", "float64"]),
        ({"faces": [[0, 1, 2], [0, 1]]}, ["faces"]),
        ({"faces": [[0, 1, 1], [0, 0, 0]]}, ["no triangle with an area", "2 degenerate"]),
        ({"normals": [[0, 0, 1]]}, ["normals", "(1, 3)", "(3, 3)"]),
        ({"texcoords": [[0, 0, 1]] * 3}, ["texcoords", "(3, 3)", "(3, 2)"]),
        ({"texcoords": [[0, 0], [0, NAN], [0, 0]]}, ["texcoords[1][1]", "nan"]),
    ],
)
def test_flaws_are_named(arguments, words):
    sound = {"positions": CORNER[:3], "faces": [[0, 1, 2]], "name": "thing"}
    with pytest.raises(PlaygroundError) as caught:
        Mesh.create(**(sound | arguments))
    for word in ["thing", *words]:
        assert word in str(caught.value)


@pytest.mark.parametrize("scale", [1e-30, 1e-12, 1.0, 1e12, 1e30])
def test_degenerate_triangles_are_dropped_at_every_scale(scale):
    positions = np.array([*SQUARE, [0.5, 0.5, 0], [0, 0, 0]]) * scale
    faces = [[0, 1, 1], [0, 4, 2], [0, 5, 1], [2, 0, 4], *HALVES]
    mesh = Mesh.create(positions, faces)
    assert mesh.faces.tolist() == HALVES
    assert mesh.triangle_normals.tolist() == [[0, 0, 1], [0, 0, 1]]
    assert mesh.radius == pytest.approx(np.sqrt(0.5) * scale, rel=1e-6)


def test_needles_are_kept():
    # Corners 1e-30 apart beside edges of length 1: thin, but a triangle
    mesh = Mesh.create([[1, 0, 0], [1, 1e-30, 0], [0, 0, 0]], [[0, 1, 2]])
    np.testing.assert_allclose(mesh.triangle_normals, [[0, 0, 1]], atol=1e-15)


def test_collinear_corners_are_dropped_although_float64_rounds():
    # (1, 3, 7) / 10 has no exact float32, yet its multiples by 2 are exact multiples
    ray = np.float32([0.1, 0.3, 0.7])
    positions = np.array([0 * ray, ray, 2 * ray, [1, 0, 0]], dtype=np.float32)
    assert Mesh.create(positions, [[0, 1, 2], [0, 1, 3]]).faces.tolist() == [[0, 1, 3]]


def test_given_normals_become_unit_and_bad_ones_are_replaced():
    given_normals = [[0, 0, 1e-30], [0, 3e30, 0], [NAN, 0, 1], [0, 0, 0], [INF, 0, 0], [0, 0, 0]]
    mesh = Mesh.create([*SQUARE, [2, 0, 0], [9, 9, 9]], [*HALVES, [1, 4, 2]], given_normals)
    up = [0, 0, 1]
    assert mesh.normals.tolist() == [up, [0, 1, 0], up, up, up, up]


def test_unit_normals_are_kept_to_the_bit():
    normals = np.float32([[0.6, 0.8, 0], [0.48, 0.6, 0.64], [0, 0, 1], [1, 0, 0]])
    mesh = Mesh.create(SQUARE, HALVES, normals)
    assert np.array_equal(mesh.normals, normals)


def test_bounds_ignore_vertices_no_face_uses():
    mesh = Mesh.create([*SQUARE, [100, 100, 100]], HALVES)
    low, high = mesh.bounds
    assert low.tolist() == [0, 0, 0] and high.tolist() == [1, 1, 0]
    assert mesh.centre.tolist() == [0.5, 0.5, 0.0]
    assert mesh.radius == pytest.approx(np.sqrt(0.5), rel=1e-15)
    np.testing.assert_allclose(mesh.triangle_centres, [[2 / 3, 1 / 3, 0], [1 / 3, 2 / 3, 0]])


def test_closed_means_each_edge_twice_in_opposite_directions():
    def closed(faces):
        return Mesh.create(CORNER, faces).closed

    flipped = [TETRAHEDRON[0][::-1], *TETRAHEDRON[1:]]
    assert closed(TETRAHEDRON)
    assert not closed(TETRAHEDRON[:3])
    assert not closed(flipped)
    assert not closed(TETRAHEDRON + TETRAHEDRON)
    assert flat(Mesh.create(CORNER, TETRAHEDRON)).closed, "split vertices weld by position"


def test_an_inside_out_solid_is_closed_but_not_cullable():
    solid = Mesh.create(CORNER, TETRAHEDRON)
    inside_out = Mesh.create(CORNER, [face[::-1] for face in TETRAHEDRON])
    assert solid.cullable and solid.volume == pytest.approx(1 / 6)
    assert inside_out.closed and not inside_out.cullable


def test_negative_zero_is_the_same_place():
    positions = np.array(CORNER)[np.array(TETRAHEDRON)].reshape(-1, 3).astype(np.float32)
    positions[::2] *= np.where(positions[::2] == 0, np.float32(-1), np.float32(1))
    assert Mesh.create(positions, np.arange(12).reshape(4, 3)).closed


def test_no_loop_over_triangles_finds_out_what_is_closed():
    n = 708
    i, j = np.divmod(np.arange(n * n), n)
    a, b, c, d = (((i + p) % n) * n + (j + q) % n for p, q in ((0, 0), (1, 0), (1, 1), (0, 1)))
    faces = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
    x, y = 2 * np.pi * i / n, 2 * np.pi * j / n
    ring = np.stack([(2 + np.cos(y)) * np.cos(x), (2 + np.cos(y)) * np.sin(x), np.sin(y)], 1)
    mesh = Mesh(np.float32(ring), np.float32(ring), np.int32(faces))
    lines = 0

    def counted(*_):
        nonlocal lines
        lines += 1
        return counted

    before = sys.gettrace()
    sys.settrace(counted)
    try:
        closed = mesh.closed
    finally:
        sys.settrace(before)
    assert closed
    assert 5 < lines < 1000  # of Python, for a million triangles


def test_angle_weights_do_not_depend_on_the_diagonals():
    # A cube's corner has three right angles, cut in two or not: the mean is (1, 1, 1) / sqrt 3
    cube = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    for turn in range(2):
        faces = []
        for number, four in enumerate(quads):
            a, b, c, d = np.roll(four, turn if number % 2 else 0)
            faces += [(a, b, c), (a, c, d)]
        normals = angle_weighted_normals(cube, np.array(faces))
        np.testing.assert_allclose(normals, (2 * cube - 1) / np.sqrt(3), atol=1e-15)


def test_corner_angles_sum_to_pi_even_for_needles():
    positions = np.random.default_rng(1).normal(size=(300, 3)) * [1, 1e-4, 1e-8]
    angles = corner_angles(positions, np.arange(300).reshape(-1, 3))
    np.testing.assert_allclose(angles.sum(axis=1), np.pi, rtol=1e-14)


def test_welding_smooths_over_split_vertices():
    split = flat(Mesh.create(CORNER, TETRAHEDRON))
    assert len(split.positions) == 12
    np.testing.assert_allclose(split.normals[::3], split.triangle_normals, atol=6e-8)
    joined = smooth(split)
    expected = angle_weighted_normals(CORNER, np.array(TETRAHEDRON))
    np.testing.assert_allclose(joined.normals, expected[np.ravel(TETRAHEDRON)], atol=6e-8)
    assert np.array_equal(joined.positions, split.positions)


def test_two_sides_of_a_sheet_cancel_without_nan():
    faces = np.array(HALVES + [face[::-1] for face in HALVES])
    normals = angle_weighted_normals(np.array(SQUARE), faces)
    assert np.abs(normals).tolist() == [[0, 0, 1]] * 4


def test_degenerate_faces_have_the_zero_normal():
    assert face_normals(np.array(SQUARE), np.array([[0, 0, 1]])).tolist() == [[0, 0, 0]]


@settings(max_examples=200, deadline=None)
@given(
    positions=arrays(
        np.float32, (8, 3), elements=st.floats(width=32, allow_nan=False, allow_infinity=False)
    ),
    faces=arrays(np.int64, (6, 3), elements=st.integers(0, 7)),
    normals=st.none() | arrays(np.float32, (8, 3), elements=st.floats(width=32)),
    factor=st.sampled_from([1e-30, 1e-3, 1.0]),
)
def test_garbage_never_gives_nan(positions, faces, normals, factor):
    with np.errstate(all="raise", under="ignore"):
        try:
            mesh = Mesh.create(positions.astype(float) * factor, faces, normals)
        except PlaygroundError as error:
            assert "no triangle with an area" in str(error)
            return
        for version in (mesh, flat(mesh), smooth(mesh)):
            length = np.linalg.norm(version.normals.astype(float), axis=1)
            assert np.abs(length - 1).max() < 2e-7
            length = np.linalg.norm(version.triangle_normals, axis=1)
            assert np.abs(length - 1).max() < 1e-15 * 4
        derived = [*mesh.bounds, mesh.centre, mesh.radius, mesh.triangle_centres, mesh.volume]
        assert all(np.isfinite(value).all() for value in derived)
        assert mesh.closed in (True, False)


def test_the_module_imports_nothing_heavy():
    code = (
        "import sys, playground.scene.mesh, playground.scene.shapes, playground.scene.mesh_file;"
        "print([m for m in ('trimesh', 'PIL', 'moderngl', 'scipy') if m in sys.modules])"
    )
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert found.stdout.strip() == "[]"
