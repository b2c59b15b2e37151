"""Which pixel centres lie inside a triangle: exact, in integers.

A graphics card rounds window positions to 1/256 pixel and from there computes without rounding.
So do we: with integers the test "on which side of this edge?" is exact, and the *top-left rule*
gives a centre that lies exactly on an edge to one of the two triangles there. A mesh then has
neither gaps nor pixels drawn twice. Instead of testing pixels, each edge inequality is solved
for the column, row by row: the result are *spans*, and no uncovered pixel is ever visited.

Window coordinates are in pixels, x to the right and y down, row 0 on top; pixel (c, r) has its
centre at (c + 0.5, r + 0.5).

References
----------
Pineda, A parallel algorithm for polygon rasterization, SIGGRAPH 1988.
Giesen, Optimizing the basic rasterizer, 2013 (fixed point, fill rule).
Direct3D 11 functional specification, section 3.4 (24.8 positions, top-left rule).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from playground.render.raster.clip import Bools, Floats, Ints

SUBPIXELS = 256  # steps of the position grid per pixel: 8 fractional bits, as GPUs have

# Sizes of a batch: a few dozen temporary arrays of this length stay below 20 MB.
BATCH_ROWS = 2**16
BATCH_PIXELS = 2**16


class Spans(NamedTuple):
    """Runs of covered pixels: triangle `piece`, row `row`, columns left <= column < right.

    All fields are (S,) int64; no run is empty.
    """

    piece: Ints
    row: Ints
    left: Ints
    right: Ints


class Fragments(NamedTuple):
    """Covered pixels, one entry for each pixel of each triangle; (F,) int64 each."""

    piece: Ints
    column: Ints
    row: Ints


def to_window(clip: Floats, size: tuple[int, int]) -> tuple[Floats, Floats]:
    """Divide by w and map to the picture: the viewport transform.

    Parameters
    ----------
    clip : (..., 4) float64
        Clip-space positions with w > 0.
    size : (width, height) in pixels

    Returns
    -------
    xy : (..., 2) float64
        Pixels, y down.
    depth : (...) float64
        ``(z/w + 1) / 2``: 0 on the near plane, 1 on the far plane, GL's default range.
    """
    ndc = clip[..., :3] / clip[..., 3:]
    half = 0.5 * np.array(size, dtype=np.float64)
    xy = half + ndc[..., :2] * half * [1.0, -1.0]
    return xy, 0.5 * ndc[..., 2] + 0.5


def snap(xy: Floats) -> Ints:
    """Round pixels (..., 2) to the nearest 1/256, half to even; the unit of the result."""
    return np.rint(xy * SUBPIXELS).astype(np.int64)


def sample_position(offset: tuple[float, float]) -> Ints:
    """The sample within its pixel, (2,) in 1/256 pixel; rounded like a vertex."""
    return snap(np.array(offset, dtype=np.float64))


def doubled_area(fixed: Ints) -> Ints:
    """Twice the signed area of triangles (K, 3, 2), in (1/256 pixel)^2; exact.

    Negative for a front face (counter-clockwise in NDC, where y points up), positive for a back
    face, 0 for a triangle that collapsed and draws nothing.
    """
    ab, ac = fixed[:, 1] - fixed[:, 0], fixed[:, 2] - fixed[:, 0]
    area: Ints = ab[:, 0] * ac[:, 1] - ac[:, 0] * ab[:, 1]
    return area


def pixel_bounds(fixed: Ints, size: tuple[int, int], sample: Ints) -> tuple[Ints, Ints, Bools]:
    """Bounding boxes in whole pixels: first and last (K, 2) as (column, row), and which hold any.

    A tiny triangle between the samples, or one beside the picture, holds none.
    """
    first = -((sample - fixed.min(axis=1)) // SUBPIXELS)  # ceiling
    last = (fixed.max(axis=1) - sample) // SUBPIXELS
    np.maximum(first, 0, out=first)
    np.minimum(last, np.array(size) - 1, out=last)
    return first, last, (first <= last).all(axis=1)


def cover(
    fixed: Ints, size: tuple[int, int], offset: tuple[float, float] = (0.5, 0.5)
) -> Iterator[Spans]:
    """Spans of the samples inside triangles, in batches bounded in memory, in draw order.

    Parameters
    ----------
    fixed : (K, 3, 2) int64
        Corners in 1/256 pixel (see `snap`), of either winding, within ±2^29.
    size : (width, height) in pixels, at most 2^15 each
    offset : (dx, dy)
        Sample within the pixel, in pixels, 0 <= d < 1; rounded to 1/256.
    """
    sample = sample_position(offset)
    first, last, some = pixel_bounds(fixed, size, sample)
    chosen = np.flatnonzero(some & (doubled_area(fixed) != 0))
    first, last = first[chosen], last[chosen]
    heights = last[:, 1] - first[:, 1] + 1
    for batch in batches(heights, BATCH_ROWS):
        slot, step = owners(heights[batch])
        row = first[batch, 1][slot] + step
        left, right = first[batch, 0][slot], last[batch, 0][slot]
        left, right = _solve_rows(fixed[chosen[batch]], sample, slot, row, left, right)
        kept = left <= right
        if kept.any():
            yield Spans(chosen[batch][slot[kept]], row[kept], left[kept], right[kept] + 1)


def _solve_rows(
    corner: Ints, sample: Ints, slot: Ints, row: Ints, left: Ints, right: Ints
) -> tuple[Ints, Ints]:
    """Narrow columns left..right (inclusive) of each row to the inside of its triangle `slot`.

    With (dx, dy) along an edge from A, clockwise on the screen, a sample (x, y) is inside when
    ``dx (y - A_y) - dy (x - A_x) + bias >= 0``. In a row y is fixed and x = 256 column + sample:
    each edge says ``256 dy column <= n``, a bound solved by one floor division.
    """
    winding = np.sign(doubled_area(corner))
    for k in range(3):
        a = corner[:, k]
        dx, dy = ((corner[:, (k + 1) % 3] - a) * winding[:, None]).T

        # Top-left rule: a sample on an edge is inside if the edge goes up, or right and level.
        bias = np.where((dy < 0) | ((dy == 0) & (dx > 0)), 0, -1)
        at_zero = dx * (sample[1] - a[:, 1]) + dy * (a[:, 0] - sample[0]) + bias
        n = at_zero[slot] + (SUBPIXELS * dx)[slot] * row

        quotient = n // np.maximum(SUBPIXELS * np.abs(dy), 1)[slot]
        side = np.sign(dy)[slot]
        left = np.where(side < 0, np.maximum(left, -quotient), left)
        right = np.where(side > 0, np.minimum(right, quotient), right)
        right = np.where((side == 0) & (n < 0), left - 1, right)
    return left, right


def expand(spans: Spans) -> Iterator[Fragments]:
    """The pixels of spans, in batches bounded in memory, in the order of the spans."""
    lengths = spans.right - spans.left
    for batch in batches(lengths, BATCH_PIXELS):
        slot, step = owners(lengths[batch])
        yield Fragments(
            spans.piece[batch][slot], spans.left[batch][slot] + step, spans.row[batch][slot]
        )


def covered_pixels(
    triangles: Floats,
    size: tuple[int, int],
    origin: tuple[int, int] = (0, 0),
    offset: tuple[float, float] = (0.5, 0.5),
) -> Fragments:
    """All pixels of window-space triangles at once; for lessons and tests, memory unbounded.

    Parameters
    ----------
    triangles : (K, 3, 2) float64
        Corners in pixels, y down, within ±2^20.
    size : (width, height)
        The part of the window looked at, in pixels; its top left pixel is `origin`.

    Returns
    -------
    Fragments
        Columns and rows counted from the window's own corner, `origin` included.
    """
    fixed = snap(np.asarray(triangles, dtype=np.float64)) - SUBPIXELS * np.array(origin)
    parts = [f for spans in cover(fixed, size, offset) for f in expand(spans)]
    if not parts:
        none = np.empty(0, dtype=np.int64)
        return Fragments(none, none, none)
    piece, column, row = (np.concatenate(field) for field in zip(*parts, strict=True))
    return Fragments(piece, column + origin[0], row + origin[1])


def batches(counts: Ints, limit: int) -> Iterator[slice]:
    """Consecutive slices whose counts add up to at most `limit` (or hold a single entry)."""
    ends = np.cumsum(counts)
    start = 0
    while start < len(counts):
        done = ends[start - 1] if start else 0
        stop = max(int(np.searchsorted(ends, done + limit, side="right")), start + 1)
        yield slice(start, stop)
        start = stop


def owners(counts: Ints) -> tuple[Ints, Ints]:
    """For counts [2, 3]: the owners [0, 0, 1, 1, 1] and the steps [0, 1, 0, 1, 2]."""
    slot = np.repeat(np.arange(len(counts)), counts)
    starts = np.cumsum(counts) - counts
    return slot, np.arange(len(slot)) - starts[slot]
