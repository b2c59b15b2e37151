"""Clipping: cuts are exact, shared edges stay shared, nothing at or behind the eye survives."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from playground.render.raster.clip import (
    FAR,
    NEAR,
    clip_segment,
    clip_triangles,
    frustum_planes,
    plane_distance,
)

SIZE = (64, 48)
ONE = np.array([[0, 1, 2]])


@pytest.fixture(autouse=True)
def strict() -> Iterator[None]:
    with np.errstate(all="raise"):
        yield


@pytest.mark.parametrize(
    ("a", "b", "t"),
    [
        ([1, 2, 3, 2], [0, 1, -4, 1], 5 / 8),  # ordinary crossing
        ([1, 0, 2, 4], [3, 1, -1, -1], 6 / 8),  # the other end is behind the eye
        ([0, 0, -4, 1], [0, 2, 1, 2], 1 / 2),  # entering instead of leaving
        ([1, 1, 0, 0], [1, 0, -8, 0], 0.0),  # starts on the plane, at infinity
    ],
)
def test_segment_crosses_near_plane(a: list[float], b: list[float], t: float) -> None:
    cut = clip_segment(np.array(a, float), np.array(b, float))
    assert cut.clipped
    assert cut.visible
    assert cut.t == t
    np.testing.assert_allclose(cut.point, (1 - t) * np.array(a) + t * np.array(b), atol=1e-15)
    assert plane_distance(cut.point, NEAR) == pytest.approx(0, abs=1e-15)


def test_segment_cut_next_to_its_end_matches_rationals() -> None:
    a, b = [0.5, 0.0, 3e5, 3e5], [0.25, 0.0, -1.0 - 2.0**-21, 1.0]
    d_a, d_b = (Fraction(p[2]) + Fraction(p[3]) for p in (a, b))
    share = d_a / (d_a - d_b)
    cut = clip_segment(np.array(a), np.array(b))
    assert abs(Fraction(float(cut.t)) - share) < Fraction(1, 10**15)
    for got, u, v in zip(cut.point, a, b, strict=True):
        exact = (1 - share) * Fraction(u) + share * Fraction(v)
        assert abs(Fraction(float(got)) - exact) <= max(abs(exact), Fraction(1)) / 10**12


def test_segment_inside_or_outside_is_not_clipped() -> None:
    inside = clip_segment(np.array([0.0, 0, -2, 2]), np.array([1.0, 0, 1, 5]))
    outside = clip_segment(np.array([0.0, 0, -3, 2]), np.array([1.0, 0, -9, 5]))
    assert (bool(inside.clipped), bool(inside.visible)) == (False, True)
    assert (bool(outside.clipped), bool(outside.visible)) == (False, False)


def test_triangle_inside_is_returned_untouched() -> None:
    clip = np.array([[0.1, 0.2, 0.3, 1], [0.7, 0, 0, 2], [0, 0.9, -0.5, 3]])
    piece = clip_triangles(clip, np.array([[2, 0, 1]]), frustum_planes(SIZE))
    np.testing.assert_array_equal(piece.position[0], clip[[2, 0, 1]])
    np.testing.assert_array_equal(piece.weights[0], np.eye(3))
    assert not piece.cut[0]


@pytest.mark.parametrize(("behind", "pieces"), [(0, 1), (1, 2), (2, 1), (3, 0)])
def test_number_of_pieces(behind: int, pieces: int) -> None:
    clip = np.array([[0.0, 0, 0, 1], [1, 0, 0, 1], [0, 1, 0, 1]])
    clip[:behind, 2] = -2
    assert len(clip_triangles(clip, ONE, frustum_planes(SIZE)).source) == pieces


@pytest.mark.parametrize(
    "vertex",
    [
        [0, 0, 0, 0],
        [1, 1, 0, 0],
        [0, 0, -1, 0],
        [1, 0, 0, -1],
        [np.nan, 0, 0, 1],
        [np.inf, 0, 0, 1],
    ],
)
def test_impossible_vertices_leave_only_proper_pieces(vertex: list[float]) -> None:
    clip = np.array([[0.0, 0, 0, 1], [1, 0, 0, 1], vertex])
    piece = clip_triangles(clip, ONE, frustum_planes(SIZE))
    assert np.isfinite(piece.position).all()
    assert (piece.position[..., 3] > 0).all()
    if not np.isfinite(vertex).all():
        assert len(piece.source) == 0


coordinate = st.floats(-4, 4).map(lambda x: round(x * 16) / 16)


@settings(deadline=None, max_examples=60)
@given(st.lists(coordinate, min_size=24, max_size=24))
def test_pieces_lie_inside_and_weights_rebuild_them(numbers: list[float]) -> None:
    clip = np.array(numbers).reshape(6, 4)
    faces = np.array([[0, 1, 2], [3, 4, 5]])
    planes = frustum_planes(SIZE)
    piece = clip_triangles(clip, faces, planes)
    rebuilt = np.einsum("kij,kjc->kic", piece.weights, clip[faces][piece.source])
    np.testing.assert_allclose(rebuilt, piece.position, atol=1e-12)
    np.testing.assert_allclose(piece.weights.sum(axis=-1), 1, atol=1e-14)
    assert (piece.weights >= 0).all()
    assert (plane_distance(piece.position, NEAR) >= -1e-14).all()
    assert (plane_distance(piece.position, FAR) >= -1e-14).all()
    assert (np.diff(piece.source) >= 0).all()


def test_neighbours_share_their_cuts_to_the_last_bit() -> None:
    rng = np.random.default_rng(3)
    clip = rng.normal([0, 0, 0, 0.7], 1, (400, 4))
    a, b, c, d = np.arange(400).reshape(4, 100)
    left, right = np.stack([a, b, c], axis=1), np.stack([c, b, d], axis=1)

    # Every corner on the common edge b-c (no weight on the third vertex) must occur on both sides.
    corners = []
    for faces, third in ((left, 0), (right, 2)):
        piece = clip_triangles(clip, faces, frustum_planes(SIZE))
        on_edge = piece.weights[..., third] == 0
        corners.append({row.tobytes() for row in piece.position[on_edge]})
    assert corners[0] == corners[1]
    assert len(corners[0]) > 50


def test_guard_band_bounds_the_window() -> None:
    clip = np.array([[0.0, 0, 0, 1], [1e30, 3, 0, 1], [5, -1e25, 0, 1]])
    piece = clip_triangles(clip, ONE, frustum_planes(SIZE))
    window = piece.position[..., :2] / piece.position[..., 3:] * 0.5 * np.array(SIZE)
    assert len(piece.source) > 0
    assert (np.abs(window) < 2**20 + 1).all()
