"""Corners with w near 0 or behind the eye, slivers, cuts at the near plane: against rationals."""

from fractions import Fraction

import numpy as np
from exact import assert_within, exact, for_any, numbers, rows, sizes
from hypothesis import strategies as st

from playground.render.raster.clip import clip_segment
from playground.render.raster.coverage import covered_pixels
from playground.render.raster.depth import perspective_weights, window_weights

U = 2.0**-53
depths = st.one_of(
    st.just(0.0), sizes(-60, 20), sizes(-60, 20).map(lambda x: -x), numbers(-4.0, 4.0)
)


def areas(u, v):
    """Doubled areas that two corners span with the point looked at, for each corner."""
    return [u[k - 2] * v[k - 1] - u[k - 1] * v[k - 2] for k in range(3)]


@for_any(xy=rows(numbers(-4.0, 4.0), 3, 2), w=rows(depths, 3), ndc=rows(numbers(-1.0, 1.0), 2))
def test_weights_need_no_division_by_w(xy, w, ndc):
    """Each area is known to a running bound, and the weights to that over what is left of the sum.

    u = x − X w has 2 roundings, 2 U (|x| + |X w|); an area of two products 3 more.
    """
    clip = np.concatenate([xy, np.zeros((3, 1)), w[:, None]], axis=1)
    point = exact(ndc)
    u, v = ([exact(clip[k])[a] - point[a] * exact(w)[k] for k in range(3)] for a in (0, 1))
    e = [
        [2 * U * (abs(exact(clip[k])[a]) + abs(point[a] * exact(w)[k])) for k in range(3)]
        for a in (0, 1)
    ]
    share = areas(u, v)
    total = sum(share)
    off = []
    for k in range(3):
        n, m = (k + 1) % 3, (k + 2) % 3
        products = abs(u[n] * v[m]) + abs(u[m] * v[n])
        moved = (
            abs(u[n]) * e[1][m] + abs(v[m]) * e[0][n] + abs(u[m]) * e[1][n] + abs(v[n]) * e[0][m]
        )
        off.append(float(moved * Fraction(1.01) + 3 * U * products))
    lost = sum(off) + 2 * U * float(sum(map(abs, share)))
    got, one_over_w = perspective_weights(clip, ndc)
    if total == 0 or lost > abs(total) / 4:  # edge-on: there is no such point
        return
    weights = [x / total for x in share]
    bound = [
        4 / 3 * (o + abs(float(b)) * lost) / abs(float(total)) + 2 * U * abs(float(b))
        for o, b in zip(off, weights, strict=True)
    ]
    assert_within(got, weights, bound)
    depth = sum(b * c for b, c in zip(weights, exact(w), strict=True))
    moved = sum(o * abs(float(c)) for o, c in zip(bound, w, strict=True))
    moved += 3 * U * sum(abs(float(b * c)) for b, c in zip(weights, exact(w), strict=True))
    if moved < abs(depth) / 4:
        want = 1 / depth
        assert_within(one_over_w, want, float(abs(want)) * (4 / 3 * moved * float(abs(want)) + U))


@for_any(
    corner=rows(numbers(-1e4, 1e4), 3, 2),
    height=sizes(-30, -6),
    one_over_w=rows(sizes(-20, 20), 3),
    at=rows(numbers(0.0625, 0.875), 2),
)
def test_slivers_keep_their_weights(corner, height, one_over_w, at):
    """As low as 2^-30 pixel: each area is known to 4 U of its two products, and so is the rest.

    Where this says nothing, below 1e-11 pixel at 1e4 pixels, the result is not used: a
    triangle that low is interpolated on its rounded corners.
    """
    corner[2] = (corner[0] + corner[1]) / 2 + [0.0, height]
    b = np.array([at[0], (1 - at[0]) * at[1], (1 - at[0]) * (1 - at[1])])
    x, y = b @ corner
    u, v = ([exact(corner[k])[i] - Fraction(p) for k in range(3)] for i, p in ((0, x), (1, y)))
    share = areas(u, v)
    off = [4 * U * float(abs(u[k - 2] * v[k - 1]) + abs(u[k - 1] * v[k - 2])) for k in range(3)]
    q = exact(one_over_w)
    total = sum(a * w for a, w in zip(share, q, strict=True))
    lost = sum(o * float(w) for o, w in zip(off, q, strict=True))
    if 4 * lost >= abs(total) or 4 * sum(off) >= abs(sum(share)):
        return
    if total / sum(share) < min(q):  # rounding put the point outside, where a horizon waits
        return
    got = window_weights(corner[None], one_over_w[None], np.array([x]), np.array([y]))[0]
    want = [a * w / total for a, w in zip(share, q, strict=True)]
    bound = [
        4 / 3 * (o * float(w) + abs(float(k)) * lost) / abs(float(total)) + 8 * U * abs(float(k))
        for o, w, k in zip(off, q, want, strict=True)
    ]
    assert_within(got, want, bound)
    assert abs(got.sum() - 1.0) <= 4 * U * np.abs(got).sum()


@for_any(
    edge=st.lists(
        st.one_of(st.integers(0, 256 * 12), st.integers(0, 24).map(lambda k: 128 * k)),
        min_size=2,
        max_size=2,
    ),
    thin=st.integers(1, 3),
    flip=st.booleans(),
)
def test_a_sliver_between_two_triangles_leaves_no_gap(edge, thin, flip):
    """A square cut in three by a strip 1/256 to 3/256 pixel high: each centre belongs to one.

    Half of the ends lie at the height of centres, so that edges run through them.
    """
    a, b = (e / 256 for e in edge)
    corners = [(0.0, 0.0), (12.0, 0.0), (12.0, a), (0.0, b)]
    lower = [(0.0, b + thin / 256), (12.0, a + thin / 256), (12.0, 16.0), (0.0, 16.0)]
    strip = [corners[3], corners[2], lower[1], lower[0]]
    quads = [corners, strip, lower]
    triangles = [[q[0], q[i], q[i + 1]] for q in quads for i in (1, 2)]
    if flip:
        triangles = [[(y, x) for x, y in triangle] for triangle in triangles]
    size = (16, 12) if flip else (12, 16)
    fragments = covered_pixels(np.array(triangles), size)
    index = fragments.row * 16 + fragments.column
    assert len(index) == 12 * 16 and len(np.unique(index)) == len(index)


@for_any(a=rows(numbers(-8.0, 8.0), 4), b=rows(numbers(-8.0, 8.0), 4), w=depths)
def test_the_near_plane_cuts_before_any_division(a, b, w):
    """t and its rest are ratios of numbers of one sign; d = z + w has one rounding, of itself.

    t: d_a 1 U, d_a − d_b 2 U, the quotient 1 U: 4 U of min(t, …) relative. The point: 6 U of
    what is added up.
    """
    a[3] = w
    (az, aw), (bz, bw) = (exact(p)[2:] for p in (a, b))
    da, db = az + aw, bz + bw
    cut = clip_segment(a, b)
    assert bool(cut.clipped) == ((da >= 0) != (db >= 0))
    assert bool(cut.visible) == (da >= 0 or db >= 0)
    if not cut.clipped:
        assert cut.t == 0.0 and np.array_equal(cut.point, a)
        return
    t = da / (da - db)
    assert_within(cut.t, t, 5 * U * float(t) + 1e-300)
    point = [(1 - t) * x + t * y for x, y in zip(exact(a), exact(b), strict=True)]
    summed = [(1 - t) * abs(x) + t * abs(y) for x, y in zip(exact(a), exact(b), strict=True)]
    assert_within(cut.point, point, [7 * U * float(s) + 1e-300 for s in summed])
