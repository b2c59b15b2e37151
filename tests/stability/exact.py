"""Inputs that float32 holds exactly, their exact values, and what a rounding is.

All inputs are float32, so both languages see the same problem. Where a test says u, it
means the rounding of its language: 2^-24 for float32, 2^-53 for float64. The bounds rest on
what IEEE 754 and GLSL promise: a sum or product is off by u, a division or an inversesqrt by
at most 2.5 u and 2 u (GLSL 4.60, section 4.7.1), relative; below ``tiny`` anything may be 0.
"""

from fractions import Fraction

import mpmath
import numpy as np
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

mpmath.mp.dps = 50
ROUNDING = {"f32": 2.0**-24, "f64": 2.0**-53}
TINY = {"f32": 2.0**-126, "f64": 2.0**-1022}


def for_any(**strategies):
    """`given` with the same examples at every run; the fixtures hold no state to be reset."""
    quiet = [HealthCheck.function_scoped_fixture, HealthCheck.too_slow]
    chosen = settings(derandomize=True, deadline=None, max_examples=60, suppress_health_check=quiet)
    return lambda test: chosen(given(**strategies)(test))


def unit_roundoff(formulas):
    return ROUNDING[formulas.precision]


def tiny(formulas):
    return TINY[formulas.precision]


def numbers(low, high):
    """float32 numbers in a range whose ends are float32 too; none of them denormal."""
    return st.floats(low, high, width=32, allow_subnormal=False)


def sizes(low, high):
    """Powers of two, whole exponents from ``low`` to ``high``: any size is as likely."""
    return st.integers(low, high).map(lambda exponent: 2.0**exponent)


def rows(elements, *shape):
    """Arrays of float32 numbers, drawn one by one, as float64: neither language rounds them."""
    drawn = arrays(np.float32, shape, elements=elements, fill=st.nothing())
    return drawn.map(lambda array: array.astype(np.float64))


def vectors(n, low=-100, high=100):
    """(n, 3) vectors with components up to 1 times sizes 2^low to 2^high, one for each vector."""
    size = arrays(np.float64, (n, 1), elements=sizes(low, high), fill=st.nothing())
    return st.builds(
        lambda v, s: f32(v * s),
        rows(numbers(-1.0, 1.0).filter(lambda x: x == 0.0 or abs(x) > 2.0**-20), n, 3),
        size,
    )


def f32(a):
    """Rounded to float32, held as float64."""
    return np.asarray(a, np.float32).astype(np.float64)


def mp(v):
    """A vector as exact mpmath numbers."""
    return [mpmath.mpf(float(x)) for x in v]


def exact(v):
    """A vector as fractions."""
    return [Fraction(float(x)) for x in v]


def mp_dot(a, b):
    return mpmath.fsum(x * y for x, y in zip(a, b, strict=True))


def mp_unit(v):
    """v/|v|, the zero vector for itself."""
    length = mpmath.sqrt(mp_dot(v, v))
    return [x / length for x in v] if length else v


def mp_angle(a, b):
    """The angle between vectors that are not zero, accurate at both ends."""
    a, b = mp_unit(a), mp_unit(b)
    half = mpmath.sqrt(mp_dot(*2 * [[x - y for x, y in zip(a, b, strict=True)]])) / 2
    return 2 * mpmath.asin(min(half, mpmath.mpf(1)))


def assert_within(got, want, bound, what=""):
    """|got − want| <= bound for every component; one bound serves them all."""
    got = np.asarray(got, np.float64)
    assert np.isfinite(got).all(), f"not finite: {got} {what}"
    bounds = _flat(bound)
    bounds = bounds * got.size if len(bounds) == 1 else bounds
    for g, w, b in zip(got.reshape(-1), _flat(want), bounds, strict=True):
        assert abs(mpmath.mpf(g) - w) <= b, (
            f"{g!r} is {mpmath.nstr(abs(g - w) / b, 4) if b else 'more'} times the bound "
            f"away from {mpmath.nstr(w, 20)} {what}"
        )


def _flat(values):
    if isinstance(values, list | tuple | np.ndarray):
        return [x for part in values for x in _flat(part)]
    return [mpmath.mpf(values) if not isinstance(values, Fraction) else to_mp(values)]


def to_mp(fraction):
    return mpmath.mpf(fraction.numerator) / fraction.denominator
