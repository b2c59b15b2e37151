"""A scene a million units from the origin, or larger than the sun: float32 sees the eye's space."""

from fractions import Fraction

import numpy as np
from exact import assert_within, for_any, numbers, rows
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from playground.measure.cases.place import eye_space

N = 8
places = arrays(np.float64, (N, 3), elements=st.floats(-1e7, 1e7), fill=st.nothing())
origin = st.lists(st.floats(-1e12, 1e12), min_size=3, max_size=3)


@for_any(eye=origin, offset=rows(numbers(-100.0, 100.0), N, 3))
def test_one_rounding_of_float32_is_all_that_is_lost(eye, offset):
    """Each component is off by 2^-24 + 2^-53 of itself: the subtraction, then the rounding."""
    points = np.asarray(eye) + offset
    got = eye_space(eye, list(points), np.float32)
    exact = [[Fraction(x) - Fraction(e) for x, e in zip(p, eye, strict=True)] for p in points]
    largest = max(abs(x) for row in exact for x in row)
    if not largest:
        assert not np.any(got)
        return
    # Scaled by a power of two: between 1/2 and 1 for the farthest, and exact otherwise.
    top = np.max(np.abs(got))
    assert 0.5 <= top <= 1.0
    scale = Fraction(2) ** round(np.log2(float(top) / float(largest)))
    bound = [[2.0**-23.99 * float(abs(x * scale)) + 2.0**-126 for x in row] for row in exact]
    assert_within(np.array(got), [[x * scale for x in row] for row in exact], bound)


@for_any(
    points=rows(st.integers(-(2**20), 2**20).map(lambda k: k / 2**10), N, 3),
    eye=rows(st.integers(-(2**20), 2**20).map(lambda k: k / 2**10), 3),
    shift=rows(st.integers(-(2**24), 2**24).map(float), 3),
)
def test_moving_the_world_changes_no_bit(points, eye, shift):
    """Eye and scene moved together by up to 16 million: the same float32 numbers, every bit."""
    here = eye_space(eye, list(points), np.float32)
    there = eye_space(eye + shift, list(points + shift), np.float32)
    assert np.array_equal(here, there)


@for_any(shift=numbers(2.0**20, 2.0**24), offset=rows(numbers(-4.0, 4.0), N, 3))
def test_float32_coordinates_of_the_world_would_lose_it(shift, offset):
    """Why not simply float32: at a million units they are 1/16 apart, here nothing is lost."""
    eye = np.full(3, np.round(shift))
    points = np.round(offset * 2**10) / 2**10 + eye
    ours = np.array(eye_space(np.zeros(3), list(points - eye), np.float32))
    assert np.array_equal(ours, np.array(eye_space(eye, list(points), np.float32)))
    rounded = points.astype(np.float32) - eye.astype(np.float32)
    error = np.max(np.abs(rounded - (points - eye)))
    step = float(np.spacing(np.float32(np.max(np.abs(points)))))
    assert error <= step and step >= 2.0**-4
