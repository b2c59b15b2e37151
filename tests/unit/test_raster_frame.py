"""Whole frames: depth, weights, draw order, culling; checked against rationals and other routes."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

import numpy as np
import pytest
from edge_distance import edge_distance
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from playground.errors import PlaygroundError
from playground.render.raster import rasterize as module
from playground.render.raster.depth import keep_nearest, perspective_weights
from playground.render.raster.rasterize import Frame, rasterize

Array = NDArray[np.float64]
ONE = np.array([[0, 1, 2]])
SIZE = (24, 18)
FULL = np.array([[-1.0, -1, 0, 1], [3, -1, 0, 1], [-1, 3, 0, 1]])


@pytest.fixture(autouse=True)
def strict() -> Iterator[None]:
    with np.errstate(all="raise"):
        yield


def ndc_of(column: int, row: int, size: tuple[int, int] = SIZE) -> tuple[Fraction, Fraction]:
    """Pixel centre in NDC, exact."""
    return Fraction(2 * column + 1, size[0]) - 1, 1 - Fraction(2 * row + 1, size[1])


def exact_weights(triangle: Array, x: Fraction, y: Fraction) -> tuple[list[Fraction], Fraction]:
    """Weights and depth in rationals: Cramer's rule for sum b_k (x_k, y_k, w_k) ~ (x, y, 1)."""
    p = [[Fraction(float(v)) for v in corner] for corner in triangle]

    def det(a: list[Fraction], b: list[Fraction], c: list[Fraction]) -> Fraction:
        (a0, a1, a2), (b0, b1, b2), (c0, c1, c2) = a, b, c
        return a0 * (b1 * c2 - b2 * c1) - a1 * (b0 * c2 - b2 * c0) + a2 * (b0 * c1 - b1 * c0)

    m = [[q[0], q[1], q[3]] for q in p]
    s = [x, y, Fraction(1)]
    share = [det(s, m[1], m[2]), det(m[0], s, m[2]), det(m[0], m[1], s)]
    b = [e / sum(share) for e in share]
    z = sum((bk * q[2] for bk, q in zip(b, p, strict=True)), Fraction(0))
    w = sum((bk * q[3] for bk, q in zip(b, p, strict=True)), Fraction(0))
    return b, (z / w + 1) / 2


def assert_matches_rationals(clip: Array, size: tuple[int, int], rel: float = 1e-11) -> int:
    """Every pixel drawn has the weights and the depth of the rational solution."""
    frame = rasterize(clip, np.arange(len(clip)).reshape(-1, 3), size)
    for row, column in np.argwhere(frame.drawn):
        triangle = clip[3 * frame.triangle[row, column] :][:3]
        weights, depth = exact_weights(triangle, *ndc_of(int(column), int(row), size))
        np.testing.assert_allclose(
            frame.weights[row, column], [float(b) for b in weights], rtol=rel, atol=rel
        )
        assert frame.depth[row, column] == pytest.approx(min(max(float(depth), 0), 1), abs=rel)
    return int(frame.drawn.sum())


@pytest.mark.parametrize(
    "clip",
    [
        FULL * [1, 1, 1, 1],
        FULL * [[9], [0.25], [2.0]],  # foreshortened: w from 0.25 to 9
        [[-1e4, -1e4, 9e3, 1e4], [1e4, -1e4, 9e3, 1e4], [0, 0.01, 0, 0.01]],  # w ratio 10^6
        [[-3, -2, -0.5, 1], [5, -4, 3, 4], [0, 4, 2, 3]],
    ],
)
def test_interpolation_is_perspective_correct(clip: list[list[float]]) -> None:
    assert assert_matches_rationals(np.array(clip, float), SIZE) > 50


@pytest.mark.parametrize(
    "third",
    [
        [0.5, -0.5, -2, 1.5],  # in front of the eye, behind the near plane
        [1, -3, -2, -1.5],  # behind the eye
        [2, 1, 0, 0],  # at infinity
        [1e6, 2e6, 0, 1],  # far beside the picture
    ],
)
def test_clipped_triangles_interpolate_their_source(third: list[float]) -> None:
    clip = np.array([[-0.75, -0.5, 0.25, 1], [-0.5, 0.75, 0.5, 1], third], float)
    assert assert_matches_rationals(clip, SIZE, rel=1e-9) > 20


@settings(deadline=None, max_examples=40)
@given(st.integers(0, 2**32 - 1))
def test_any_soup_is_interpolated_as_by_homogeneous_weights(seed: int) -> None:
    rng = np.random.default_rng(seed)
    clip = rng.normal([0, 0, 0, 0.8], [1.5, 1.5, 1, 1], (12, 4))
    faces = np.arange(12).reshape(4, 3)
    frame = rasterize(clip, faces, SIZE)
    row, column = np.nonzero(frame.drawn & np.isinf(edge_distance(clip, faces, SIZE)))
    ndc = np.stack([(2 * column + 1) / SIZE[0] - 1, 1 - (2 * row + 1) / SIZE[1]], axis=-1)
    weights, _ = perspective_weights(clip[faces][frame.triangle[row, column]], ndc)
    np.testing.assert_allclose(frame.weights[row, column], weights, atol=1e-9)
    assert np.isfinite(frame.weights).all()
    np.testing.assert_allclose(frame.weights.sum(axis=-1), frame.drawn, atol=1e-12)


def test_homogeneous_weights_of_corners_at_and_behind_the_eye() -> None:
    at_eye = np.array([[-1.0, -1, 0, 0], [4, -4, 0, 4], [0, 4, 0, 4]])
    behind = np.array([[-1.0, -1, 0, -0.5], [6, -4, 0, 4], [0, 5, 0, 4]])
    for triangle in (at_eye, behind):
        weights, one_over_w = perspective_weights(triangle, np.array([0.25, 0.125]))
        exact, _ = exact_weights(triangle, Fraction(1, 4), Fraction(1, 8))
        np.testing.assert_allclose(weights, [float(b) for b in exact], rtol=1e-14)
        assert 1 / one_over_w == pytest.approx(float(weights @ triangle[:, 3]))


def test_homogeneous_weights_edge_on_are_nan() -> None:
    line = np.array([[0.0, 0, 0, 1], [1, 1, 0, 1], [2, 2, 0, 1]])
    weights, one_over_w = perspective_weights(line, np.array([[0.5, 0.5], [0.25, 0.5]]))
    assert np.isnan(weights).all()
    assert np.isnan(one_over_w).all()


def test_needles_interpolate_inside() -> None:
    # Before rounding the corners are collinear or turned over: the drawn sliver has no plane.
    xy = np.array([[2.5, 3.5 - 1e-9], [20.5, 3.5 + 1e-9], [11.5, 3.5 + 0.6 / 256]])
    clip = np.array([[x / 12 - 1, 1 - y / 9, 0.08 * x - 1, 1] for x, y in xy])
    frame = rasterize(clip, ONE, SIZE)
    assert frame.drawn.sum() == 18
    assert (frame.weights[frame.drawn] >= 0).all()
    np.testing.assert_allclose(frame.weights[frame.drawn].sum(axis=-1), 1)
    assert frame.depth[frame.drawn].min() == pytest.approx(0.04 * 2.5)


def test_samples_beyond_the_horizon_stay_on_the_triangle() -> None:
    # Rounding moves the far edge up, onto the centres of row 4: they see just past the plane's end.
    y = 1 - (4.5 + 0.4 / 256) / 9
    clip = np.array([[-0.9, y, 0, 1], [0.9, y, 0, 1], [0, -0.9, 0, 1]]) * [[1e5], [1e5], [1e-2]]
    frame = rasterize(clip, ONE, SIZE)
    assert frame.drawn[4].sum() > 15
    assert (frame.weights >= 0).all()
    np.testing.assert_array_equal(frame.weights[4, :, 2], 0)  # the near corner has no part there
    np.testing.assert_allclose(frame.weights.sum(axis=-1), frame.drawn)


def test_equal_depth_keeps_the_first() -> None:
    frame = rasterize(FULL, np.repeat(ONE, 5, axis=0), SIZE, object_id=7)
    rasterize(FULL, ONE, SIZE, out=frame, object_id=8)
    assert (frame.triangle == 0).all()
    assert (frame.object == 7).all()
    nearer = FULL - [0, 0, 1e-12, 0]
    rasterize(nearer, ONE, SIZE, out=frame, object_id=9)
    assert (frame.object == 9).all()


def test_keep_nearest_takes_the_earliest_of_the_nearest() -> None:
    buffer = np.array([1.0, 0.2, 1.0])
    pixel = np.array([0, 1, 0, 2, 0, 2])
    depth = np.array([0.5, 0.2, 0.3, 1.0, 0.3, 0.9])
    assert keep_nearest(buffer, pixel, depth).tolist() == [2, 5]
    assert buffer.tolist() == [0.3, 0.2, 0.9]


def test_draw_order_does_not_matter_at_different_depths() -> None:
    rng = np.random.default_rng(2)
    clip = np.concatenate([rng.uniform(-1.2, 1.2, (90, 2)), rng.uniform(-1, 1, (90, 1))], axis=1)
    clip = np.concatenate([clip, np.ones((90, 1))], axis=1)
    faces = np.arange(90).reshape(-1, 3)
    frame, order = rasterize(clip, faces, SIZE), rng.permutation(30)
    shuffled = rasterize(clip, faces[order], SIZE)
    np.testing.assert_array_equal(frame.depth, shuffled.depth)
    drawn = frame.drawn
    np.testing.assert_array_equal(frame.triangle[drawn], order[shuffled.triangle[drawn]])
    np.testing.assert_array_equal(frame.weights, shuffled.weights)


def test_culling_and_front() -> None:
    faces = np.array([[0, 2, 1], [0, 1, 2]])  # clockwise first: a back face
    both = rasterize(FULL, faces, SIZE)
    assert (both.triangle == 0).all()
    assert not both.front.any()
    only_front = rasterize(FULL, faces, SIZE, cull="back")
    assert (only_front.triangle == 1).all()
    assert only_front.front.all()
    only_back = rasterize(FULL, faces[::-1], SIZE, cull="front")
    assert (only_back.triangle == 1).all()


def test_nothing_drawn_leaves_the_frame_empty() -> None:
    empty = Frame.empty(SIZE)
    for clip, faces in [
        (FULL, np.empty((0, 3), int)),
        (FULL - [0, 0, 0, 9], ONE),
        (np.full((3, 4), np.nan), ONE),
        (np.zeros((3, 4)), ONE),
        (FULL[[0, 0, 1]], ONE),
        (FULL - [0, 0, -1, 0], ONE),  # on the far plane: not nearer than the cleared depth
    ]:
        frame = rasterize(clip, faces, SIZE)
        assert not frame.drawn.any()
        np.testing.assert_array_equal(frame.depth, empty.depth)
        np.testing.assert_array_equal(frame.weights, 0)


def test_offset_moves_the_sample() -> None:
    clip = np.array([[-0.7, -0.8, 0.1, 1], [1.4, -0.6, 0.3, 2], [0.2, 0.9, 0.2, 1]])
    moved = clip.copy()
    moved[:, 0] += 0.25 * 2 / SIZE[0] * clip[:, 3]
    moved[:, 1] -= 0.125 * 2 / SIZE[1] * clip[:, 3]
    here, there = rasterize(clip, ONE, SIZE, offset=(0.25, 0.375)), rasterize(moved, ONE, SIZE)
    sure = np.isinf(edge_distance(moved, ONE, SIZE))
    np.testing.assert_array_equal(here.triangle[sure], there.triangle[sure])
    np.testing.assert_allclose(here.weights[sure], there.weights[sure], atol=1e-12)


def test_blocks_do_not_show(monkeypatch: pytest.MonkeyPatch) -> None:
    rng = np.random.default_rng(4)
    clip = rng.normal([0, 0, 0, 1.5], 1, (300, 4))
    faces = rng.integers(0, 300, (200, 3))
    whole = rasterize(clip, faces, SIZE)
    monkeypatch.setattr(module, "BLOCK", 9)
    pieces = rasterize(clip, faces, SIZE)
    for name in ("depth", "triangle", "object", "weights", "front"):
        np.testing.assert_array_equal(getattr(whole, name), getattr(pieces, name))


@pytest.mark.parametrize(
    "wrong",
    [{"size": (0, 4)}, {"size": (4, 2**16)}, {"cull": "both"}, {"offset": (1.0, 0.5)}],
)
def test_mistakes_are_told(wrong: dict[str, object]) -> None:
    with pytest.raises(PlaygroundError):
        rasterize(FULL, ONE, **({"size": SIZE} | wrong))  # type: ignore[arg-type]
    with pytest.raises(PlaygroundError):
        rasterize(FULL, ONE, (8, 8), out=Frame.empty(SIZE))
