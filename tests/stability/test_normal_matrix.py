"""Normals under transforms: singular, mirrored, huge, tiny, all of it at once."""

from fractions import Fraction

import mpmath
import numpy as np
from exact import assert_within, exact, for_any, mp_unit, numbers, rows, sizes, to_mp, unit_roundoff
from hypothesis import strategies as st

from playground.measure.cases.place import normal_matrix_case
from playground.shading.vector import normal_matrix, orientation

U = 2.0**-53
scales = st.lists(sizes(-45, 45), min_size=3, max_size=3)
entries = rows(numbers(-1.0, 1.0).filter(lambda x: x == 0.0 or abs(x) > 2.0**-20), 3, 3)
# How the third column comes about: free, zero, a copy, a sum, or the mirror image of the first.
kinds = st.sampled_from(["free", "zero", "copy", "sum", "mirror", "rank 1"])


def matrix_of(entry, scale, kind):
    columns = entry.T.copy()
    if kind == "zero":
        columns[2] = 0.0
    elif kind in ("copy", "rank 1"):
        columns[2] = columns[0]
    elif kind == "sum":
        columns[:2] = np.round(columns[:2] * 2**20) / 2**20  # so that the sum is exact too
        columns[2] = columns[0] + columns[1]
    elif kind == "mirror":
        columns = np.diag([-1.0, 1.0, 1.0])
    if kind == "rank 1":
        columns[1] = columns[0]
    return (columns * np.array(scale)[:, None]).T


def cross(a, b):
    return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]


def cofactors(matrix):
    """The exact cofactor matrix, and the exact sign of the determinant."""
    c0, c1, c2 = (exact(column) for column in matrix.T)
    columns = [cross(c1, c2), cross(c2, c0), cross(c0, c1)]
    determinant = sum((a * b for a, b in zip(c0, columns[0], strict=True)), Fraction(0))
    return columns, (determinant > 0) - (determinant < 0)


@for_any(entry=entries, scale=scales, kind=kinds)
def test_the_sign_is_exact(entry, scale, kind):
    matrix = matrix_of(entry, scale, kind)
    sign = cofactors(matrix)[1]
    assert orientation(matrix) == sign
    if kind in ("zero", "copy", "sum", "rank 1"):
        assert sign == 0


@for_any(entry=entries, scale=scales, kind=kinds)
def test_every_entry_is_accurate(entry, scale, kind):
    """Of float32 numbers, each product is exact: an entry has one rounding, and two of the scaling.

    So the matrix is the exact cofactor matrix times one factor, every entry to 4 u, relative to
    itself, for scales from 2^-45 to 2^45 in any mixture; exact zeros stay zeros.
    """
    matrix = matrix_of(entry, scale, kind)
    columns, sign = cofactors(matrix)
    largest = max(abs(x) for column in columns for x in column)
    got = normal_matrix(matrix)
    if largest == 0:
        assert not got.any()
        return
    want = [[(sign or 1) * x / largest for x in row] for row in zip(*columns, strict=True)]
    bound = [[4 * U * abs(to_mp(x)) for x in row] for row in want]
    assert_within(got, want, bound)


@for_any(entry=entries, scale=scales, kind=kinds, normal=rows(numbers(-1.0, 1.0), 3))
def test_normals_keep_their_side(formulas, entry, scale, kind, normal):
    """The outward normal points along M^-T n, to 20 u of Σ |C||n| over what is left of the sum.

    n itself is off by 8 u, the matrix by 2 u where it is rounded once more, the sum by 3 u, the
    unit by 8 u. A flattened object has a normal line but no side.
    """
    matrix, u = matrix_of(entry, scale, kind), unit_roundoff(formulas)
    columns, sign = cofactors(matrix)
    n = exact(normal)
    terms = [[x * n[k] for x in columns[k]] for k in range(3)]
    want = [to_mp(sum(row)) for row in zip(*terms, strict=True)]
    size = mpmath.sqrt(sum(to_mp(sum(map(abs, row))) ** 2 for row in zip(*terms, strict=True)))
    length = mpmath.sqrt(sum(x * x for x in want))
    largest = max(abs(x) for column in columns for x in column)
    got = normal_matrix_case({"M": matrix, "n": normal}, formulas)
    assert got["singular"] == (sign == 0)
    assert np.isfinite(got["outward_normal"]).all()
    # In float32 an entry of less than 2^-126 of the largest is gone.
    if length == 0 or length < to_mp(largest) * 2.0**-100 or 20 * u * size > length / 4:
        return
    outward = [(sign or 1) * x for x in mp_unit(want)]
    assert_within(got["outward_normal"], outward, 8 * u + 20 * u * size / length, f"{matrix}")
    if sign < 0:
        assert np.array_equal(got["winding_normal"], -got["outward_normal"])


def test_the_side_of_a_flattened_object_is_no_chance():
    """c2 = c0 + c1 exactly: a rounded determinant is ±1e-17, and half of the time negative."""
    rng = np.random.default_rng(5)
    for _ in range(200):
        a, b = np.round(rng.uniform(-1, 1, (2, 3)) * 2**30) / 2**30
        assert orientation(np.array([a, b, a + b]).T) == 0.0
