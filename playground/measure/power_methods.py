"""Ways to raise the cosine of a highlight to its power: what the experiment puts to the test.

Each exists in NumPy and as a GLSL function ``method(n, l, v)`` of the three unit vectors, and none
but the first two is what the renderers use. All are given everything the vectors say, so that
a method which needs another cosine (Blinn's) pays for it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from playground.shading.phong import specular_factor
from playground.shading.vector import Array, dot, unit

COSINE = "max(2.0 * dot(n, l) * dot(n, v) - dot(l, v), 0.0)"  # r·v without r
TO_LIGHT = unit(np.array([0.3, 0.5, 1.0]))
TO_EYE = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True)
class Method:
    """One way: in NumPy, as the body of ``float method(vec3 n, vec3 l, vec3 v)``, and its table."""

    name: str
    numpy: Callable[[Array], Array]  # of normals (..., 3)
    glsl: str
    table: NDArray[np.float32] | None = None
    texels: int = 0


def normals(side: int) -> Array:
    """Unit normals (side, side, 3) as the pass on the GPU makes them, pixel by pixel."""
    place = 2.0 * (np.arange(side) + 0.5) / side - 1.0
    x, y = np.meshgrid(place, place)
    return unit(np.stack([x, y, np.ones_like(x)], axis=-1))


def cosine(normal: Array) -> Array:
    """max(r·v, 0) for normals (..., 3)."""
    mirrored = 2.0 * dot(normal, TO_LIGHT) * dot(normal, TO_EYE) - TO_LIGHT @ TO_EYE
    return np.asarray(np.maximum(mirrored, 0.0))


def exact(normal: Array, shininess: float) -> Array:
    """The lecture's max(r·v, 0)^sh in float64."""
    with np.errstate(under="ignore"):
        return np.asarray(np.power(cosine(normal), shininess))


def methods(shininess: int, sizes: tuple[int, ...]) -> list[Method]:
    """All of them for one exponent, the tables in these sizes."""
    return [
        Method(
            "pow",
            lambda normal: exact(normal, shininess),
            f"return pow({COSINE}, {float(shininess)});",
        ),
        Method(
            "ours",
            lambda normal: specular_factor(normal, TO_LIGHT, TO_EYE, float(shininess)),
            f"return specular_factor(n, l, v, {float(shininess)});",
        ),
        schlick(shininess),
        squaring(shininess),
        *(lookup(shininess, size) for size in sizes),
        blinn(shininess),
    ]


def schlick(shininess: int) -> Method:
    """x/(n − n x + x): one division instead of a power.

    Source: Schlick, A Fast Alternative to Phong's Specular Model, Graphics Gems IV, 1994.
    """

    def rational(normal: Array) -> Array:
        x = cosine(normal)
        return np.asarray(x / (shininess - shininess * x + x))

    n = float(shininess)
    return Method("Schlick", rational, f"float x = {COSINE};\n    return x / ({n} - {n} * x + x);")


def squaring(shininess: int) -> Method:
    """The product of the powers x, x², x⁴, ... that the bits of a whole exponent name."""
    bits = f"{shininess:b}"[::-1]

    def squared(normal: Array) -> Array:
        power, value = cosine(normal), np.ones(normal.shape[:-1])
        with np.errstate(under="ignore"):
            for place, bit in enumerate(bits):
                if bit == "1":
                    value = value * power
                if place + 1 < len(bits):
                    power = power * power
        return value

    lines = [f"float p = {COSINE}, value = 1.0;"]
    for place, bit in enumerate(bits):
        lines += ["value *= p;"] * (bit == "1") + ["p *= p;"] * (place + 1 < len(bits))
    return Method("repeated squaring", squared, "\n    ".join([*lines, "return value;"]))


def lookup(shininess: int, size: int) -> Method:
    """A table of x^sh at ``size`` points of [0, 1], with a straight line between two."""
    with np.errstate(under="ignore"):
        table = np.power(np.linspace(0.0, 1.0, size), shininess)

    def looked_up(normal: Array) -> Array:
        return np.asarray(np.interp(cosine(normal), np.linspace(0.0, 1.0, size), table))

    scale, offset = (size - 1) / size, 0.5 / size
    glsl = f"return texture(table, vec2({COSINE} * {scale!r} + {offset!r}, 0.5)).r;"
    return Method("lookup texture", looked_up, glsl, table.astype(np.float32)[None], size)


def blinn(shininess: int) -> Method:
    """(n·h)^sh' with the exponent that fits best. Source: Blinn 1977."""
    fitted = fitted_exponent(shininess)
    halfway = unit(TO_LIGHT + TO_EYE)

    def blinned(normal: Array) -> Array:
        with np.errstate(under="ignore"):
            return np.asarray(np.power(np.maximum(dot(normal, halfway), 0.0), fitted))

    glsl = f"return pow(max(dot(n, normalize(l + v)), 0.0), {fitted!r});"
    return Method("Blinn, fitted exponent", blinned, glsl)


@lru_cache(maxsize=8)
def fitted_exponent(shininess: int) -> float:
    """The exponent of n·h with the least mean squared difference from (r·v)^sh over the pass.

    Golden-section search of the logarithm, between sh and 16 sh.
    """
    normal = normals(64)
    base = np.maximum(dot(normal, unit(TO_LIGHT + TO_EYE)), 0.0)
    want = exact(normal, shininess)

    def wrong(logarithm: float) -> float:
        with np.errstate(under="ignore"):
            return float(np.mean((np.power(base, np.exp(logarithm)) - want) ** 2))

    low, high = np.log(shininess), np.log(16.0 * shininess)
    golden = (np.sqrt(5.0) - 1.0) / 2.0
    for _ in range(60):
        a, b = high - golden * (high - low), low + golden * (high - low)
        low, high = (low, b) if wrong(a) < wrong(b) else (a, high)
    return float(np.exp((low + high) / 2.0))
