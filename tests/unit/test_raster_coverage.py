"""Coverage: exact, every pixel of a mesh once; checked against rationals and a displaced sample."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from playground.render.raster import coverage
from playground.render.raster.coverage import covered_pixels, doubled_area, snap, to_window

Array = NDArray[np.float64]
Pixels = set[tuple[int, int, int]]


@pytest.fixture(autouse=True)
def strict() -> Iterator[None]:
    with np.errstate(all="raise"):
        yield


def slow_pixels(triangles: Array, size: tuple[int, int], offset: tuple[float, float]) -> Pixels:
    """Reference in rationals: pixels (triangle, column, row) whose sample lies inside.

    Instead of a fill rule the sample is displaced by (e, e^2) with infinitesimal e, so that it
    never lies on an edge: the sign of an edge function is that of (E, dE/dx, dE/dy), in this order.
    """
    found = set()
    for index, triangle in enumerate(triangles):
        p = [tuple(Fraction(round(Fraction(v) * 256), 256) for v in corner) for corner in triangle]
        for row in range(size[1]):
            for column in range(size[0]):
                x, y = column + Fraction(offset[0]), row + Fraction(offset[1])
                sides = []
                for (ax, ay), (bx, by) in zip(p, p[1:] + p[:1], strict=True):
                    edge = (bx - ax) * (y - ay) - (by - ay) * (x - ax)
                    sides.append((edge, ay - by, bx - ax))
                zero = (Fraction(0),) * 3
                if all(s > zero for s in sides) or all(s < zero for s in sides):
                    found.add((index, column, row))
    return found


def as_set(fragments: coverage.Fragments) -> Pixels:
    pixels = list(zip(*(field.tolist() for field in fragments), strict=True))
    assert len(set(pixels)) == len(pixels)
    return set(pixels)


def times_drawn(triangles: Array, size: tuple[int, int]) -> NDArray[np.int64]:
    """(h, w): how many triangles cover each pixel."""
    fragments = covered_pixels(triangles, size)
    drawn = np.bincount(fragments.row * size[0] + fragments.column, minlength=size[0] * size[1])
    return drawn.reshape(size[1], size[0])


def fan(centre: tuple[float, float], rim: list[tuple[float, float]]) -> Array:
    return np.array([[centre, p, q] for p, q in zip(rim, rim[1:] + rim[:1], strict=True)])


def lattice(xs: Array, ys: Array, move: Array, flip: NDArray[np.bool_]) -> Array:
    """Triangles of a grid whose inner vertices are displaced, each cell split along a diagonal."""
    points = np.stack(np.meshgrid(xs, ys), axis=-1)
    points[1:-1, 1:-1] += move
    a, b, c, d = points[:-1, :-1], points[:-1, 1:], points[1:, 1:], points[1:, :-1]
    cell = flip[..., None, None]
    first = np.where(cell, np.stack([a, b, d], axis=2), np.stack([a, b, c], axis=2))
    second = np.where(cell, np.stack([b, c, d], axis=2), np.stack([a, c, d], axis=2))
    return np.concatenate([first.reshape(-1, 3, 2), second.reshape(-1, 3, 2)])


@pytest.mark.parametrize("step", [0.5, 0.25, 1 / 256, 1e-3])
@pytest.mark.parametrize("offset", [(0.5, 0.5), (0.0, 0.0), (0.375, 0.875)])
def test_agrees_with_rationals(step: float, offset: tuple[float, float]) -> None:
    rng = np.random.default_rng(5)
    triangles = np.round(rng.uniform(-4, 16, (40, 3, 2)) / step) * step
    size = (12, 10)
    got = as_set(covered_pixels(triangles, size, offset=offset))
    assert got == slow_pixels(triangles, size, offset)
    assert len(got) > 300


def test_square_on_pixel_centres_is_shared_fairly() -> None:
    a, b = 2.5, 12.5
    square = np.array([[[a, a], [b, a], [b, b]], [[a, a], [b, b], [a, b]]])
    drawn = times_drawn(square, (20, 20))
    assert drawn.max() == 1
    assert drawn.sum() == 100
    assert drawn[2:12, 2:12].all()  # left and top edges belong to it, right and bottom ones do not
    per_triangle = np.bincount(covered_pixels(square, (20, 20)).piece)
    assert per_triangle.tolist() == [55, 45]


@pytest.mark.parametrize("centre", [(8.5, 7.5), (8.0, 7.0), (8.25, 7.125)])
def test_fan_covers_its_centre_once(centre: tuple[float, float]) -> None:
    x, y = centre
    rim = [(x + 6, y), (x + 3, y + 5), (x - 3, y + 5), (x - 6, y), (x - 3, y - 5), (x + 3, y - 5)]
    drawn = times_drawn(fan(centre, rim), (18, 16))
    assert drawn.max() == 1
    hexagon = fan(rim[0], rim[1:])[:-1]
    np.testing.assert_array_equal(drawn, times_drawn(hexagon, (18, 16)))


@pytest.mark.parametrize(("tip", "pixels"), [(1 / 256, 50), (-1 / 256, 0), (1 / 1024, 0)])
def test_slivers_keep_only_their_top_edge(tip: float, pixels: int) -> None:
    sliver = np.array([[[3.5, 2.5], [53.5, 2.5], [53.5, 2.5 + tip]]])
    assert len(covered_pixels(sliver, (64, 6)).piece) == pixels


def test_collapsed_triangles_draw_nothing() -> None:
    line, point = [[1, 1], [4, 4], [9, 9]], [[2.5, 2.5]] * 3
    nearly = [[1.5, 1.5], [9.5, 9.5], [5.5 + 1e-3, 5.5]]
    fragments = covered_pixels(np.array([line, point, nearly], float), (16, 16))
    assert len(fragments.piece) == 0


def test_both_windings_cover_the_same() -> None:
    triangle = np.array([[[1.5, 1.5], [9.5, 2.5], [4.5, 8.5]]])
    there, back = covered_pixels(triangle, (12, 12)), covered_pixels(triangle[:, ::-1], (12, 12))
    assert as_set(there) == as_set(back)


def test_front_is_counter_clockwise_in_ndc() -> None:
    clip = np.array([[[-1.0, -1, 0, 1], [1, -1, 0, 1], [0, 1, 0, 1]]])
    xy, depth = to_window(clip, (20, 10))
    np.testing.assert_allclose(xy[0], [[0, 10], [20, 10], [10, 0]])
    np.testing.assert_array_equal(depth, 0.5)
    assert doubled_area(snap(xy)) < 0


def test_triangles_far_larger_than_the_picture_meet_without_a_seam() -> None:
    p, q = [-1_000_001.25, -731_113.5], [998_001.75, 730_007.25]
    both = np.array([[p, q, [-9e5, 1e6]], [p, q, [1e6, -1e6]]])
    drawn = times_drawn(both, (50, 40))
    np.testing.assert_array_equal(drawn, 1)
    got = as_set(covered_pixels(both, (12, 9)))
    assert got == slow_pixels(both, (12, 9), (0.5, 0.5))


def test_origin_looks_at_a_corner_of_a_large_window() -> None:
    triangle = np.array([[[4003.25, 6001.5], [4010.5, 6004.75], [4001.0, 6009.5]]])
    fragments = covered_pixels(triangle, (16, 16), origin=(4000, 6000))
    near = covered_pixels(triangle - [4000, 6000], (16, 16))
    np.testing.assert_array_equal(fragments.column, near.column + 4000)
    np.testing.assert_array_equal(fragments.row, near.row + 6000)


def test_batches_do_not_show(monkeypatch: pytest.MonkeyPatch) -> None:
    triangles = np.random.default_rng(8).uniform(-5, 45, (60, 3, 2))
    whole = covered_pixels(triangles, (40, 40))
    monkeypatch.setattr(coverage, "BATCH_ROWS", 7)
    monkeypatch.setattr(coverage, "BATCH_PIXELS", 5)
    for once, piecewise in zip(whole, covered_pixels(triangles, (40, 40)), strict=True):
        np.testing.assert_array_equal(once, piecewise)


@settings(deadline=None, max_examples=60)
@given(
    seed=st.integers(0, 2**32 - 1),
    cells=st.tuples(st.integers(1, 9), st.integers(1, 9)),
    grid=st.sampled_from([1, 2, 4, 256, 10_000]),
    corner=st.tuples(st.integers(0, 6), st.integers(0, 6)),
    extent=st.tuples(st.integers(1, 24), st.integers(1, 24)),
)
def test_tessellated_rectangle_is_covered_once(
    seed: int, cells: tuple[int, int], grid: int, corner: tuple[int, int], extent: tuple[int, int]
) -> None:
    rng = np.random.default_rng(seed)
    (nx, ny), (x, y), (width, height) = cells, corner, extent
    xs, ys = x + np.linspace(0, width, nx + 1), y + np.linspace(0, height, ny + 1)

    # Moved by less than a third of a cell and rounded, no triangle of the lattice turns over.
    xs, ys = np.round(xs * 256) / 256, np.round(ys * 256) / 256
    reach = np.array([width / nx, height / ny]) / 3
    move = rng.uniform(-1, 1, (ny - 1, nx - 1, 2)) * reach
    move = np.trunc(move * grid) / grid
    drawn = times_drawn(lattice(xs, ys, move, rng.random((ny, nx)) < 0.5), (32, 32))
    expected = np.zeros((32, 32), dtype=int)
    expected[y : y + height, x : x + width] = 1
    np.testing.assert_array_equal(drawn, expected)
