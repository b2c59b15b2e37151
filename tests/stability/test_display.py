"""The sRGB curve to its last code, and the bilinear lookup to its last digit."""

from fractions import Fraction

import mpmath
import numpy as np
from exact import assert_within, exact, for_any, mp, numbers, rows, sizes, to_mp, unit_roundoff
from hypothesis import strategies as st

from playground.shading.display import code8

N = 16
# Anything, the neighbourhood of the two breakpoints, and that of the edges between codes.
unit_interval = numbers(0.0, 1.0).map(lambda x: 0.0 if x < 2.0**-100 else x)
breaks = st.builds(
    lambda at, off: float(np.float32(at * (1 + off * 2.0**-22))),
    st.sampled_from([0.0031308, 0.04045]),
    st.integers(-4, 4),
)


def encode(x):
    high = mpmath.mpf("1.055") * mpmath.power(x, 1 / mpmath.mpf("2.4")) - mpmath.mpf("0.055")
    return mpmath.mpf("12.92") * x if x <= mpmath.mpf("0.0031308") else high


def decode(x):
    low = x / mpmath.mpf("12.92")
    high = mpmath.power((x + mpmath.mpf("0.055")) / mpmath.mpf("1.055"), mpmath.mpf("2.4"))
    return low if x <= mpmath.mpf("0.04045") else high


edges = st.builds(
    lambda code, off: float(np.float32(float(decode(mpmath.mpf(code + 0.5) / 255)) * (1 + off))),
    st.integers(0, 254),
    st.sampled_from([-1e-6, -3e-7, -1e-7, 0.0, 1e-7, 3e-7, 1e-6]),
)


@for_any(x=rows(st.one_of(unit_interval, breaks, edges), N))
def test_the_curve_and_its_codes(formulas, x):
    """y^12 = x^5 by Newton: y is off by 2.2 u, 1.055 y − 0.055 by 4 u in all.

    At the breakpoint the two branches of the standard are 3e-8 apart, and which one counts is
    decided by the rounded constant. The 8-bit code is right but within the error of an edge.
    """
    got = formulas.display.srgb_encode(x)
    for g, v in zip(got, mp(x), strict=True):
        want, bound = encode(v), 4 * unit_roundoff(formulas)
        if abs(v / mpmath.mpf("0.0031308") - 1) < 2.0**-22:
            bound += 3e-8
        assert_within(g, want, bound)
        place = 255 * want + mpmath.mpf(0.5)
        if abs(place - mpmath.nint(place)) > 256 * bound:
            assert int(code8(g)) == int(mpmath.floor(place))


@for_any(x=rows(st.one_of(unit_interval, breaks), N))
def test_the_curve_back(formulas, x):
    """(x + 0.055)/1.055 is off by 4.5 u, magnified by 2.4; the power adds 8 + 5 |log2| u: 20 u."""
    got = formulas.display.srgb_decode(x)
    want = [decode(v) for v in mp(x)]
    bound = 20 * unit_roundoff(formulas)
    near = [abs(v / mpmath.mpf("0.04045") - 1) < 2.0**-22 for v in mp(x)]
    assert_within(got, want, [bound + 3e-8 * n for n in near])


@for_any(x=rows(numbers(-(2.0**100), 2.0**100), N, 3))
def test_clamping_is_exact(formulas, x):
    assert np.array_equal(formulas.display.clamp_colour(x), np.clip(x, 0.0, 1.0))
    # Negative light is no light, never NaN.
    assert not formulas.display.srgb_encode(-np.abs(x[:, 0])).any()


@for_any(
    texels=rows(numbers(-1.0, 1.0), 3, 5, 3),
    contrast=sizes(-20, 20),
    texcoord=rows(numbers(-2.0, 3.0), 2),
)
def test_bilinear_to_the_last_digit(formulas, texels, contrast, texcoord):
    """The place is off by 5 texels · 2 u of the coordinate (3 at most): 30 u of the contrast.

    The blending adds 6 roundings of the largest texel. A texture unit's weights are 1/256 apart.
    """
    texels = np.round(texels * 2**10) / 2**10 * contrast
    got = formulas.texture.bilinear(texels, texcoord)
    height, width = texels.shape[:2]
    x, y = (
        c % 1 * n - Fraction(1, 2) for c, n in zip(exact(texcoord), (width, height), strict=True)
    )
    j, i = x // 1, y // 1
    tx, ty = x - j, y - i

    def row(k):
        left, right = (exact(texels[k % height, (j + step) % width]) for step in (0, 1))
        return [a * (1 - tx) + b * tx for a, b in zip(left, right, strict=True)]

    want = [to_mp(a * (1 - ty) + b * ty) for a, b in zip(row(i), row(i + 1), strict=True)]
    assert_within(got, want, (2 * 30 + 6) * unit_roundoff(formulas) * 2 * contrast)
