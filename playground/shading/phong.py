"""The Phong model: four terms and their sum.

    max(n·l, 0) s_d ⊗ m_d + max(r·v, 0)^sh s_s ⊗ m_s + s_a ⊗ m_a + m_e

Twin: shaders/lib/phong.glsl. n, l, v, r are unit vectors of shape (..., 3) that point
away from the surface; s are colours of the light, m of the material, linear RGB (..., 3).
Source: Phong, Illumination for Computer Generated Pictures, CACM 18(6), 1975, with the
ambient and emissive terms as in the lecture.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from playground.shading.floats import Array, floats
from playground.shading.power import lobe
from playground.shading.vector import dot, halfway, reflection


def component_filter(light: ArrayLike, material: ArrayLike) -> Array:
    """The product s ⊗ m: each colour channel of the light, weakened by the material's; (..., 3)."""
    light, material = floats(light, material)
    return np.asarray(light * material)


def diffuse_factor(normal: ArrayLike, to_light: ArrayLike) -> Array:
    """max(n·l, 0): Lambert's law (Photometria, 1760), shape (...)."""
    return np.maximum(dot(normal, to_light), 0.0)


def specular_factor(
    normal: ArrayLike, to_light: ArrayLike, to_eye: ArrayLike, shininess: ArrayLike
) -> Array:
    """max(r·v, 0)^sh: the highlight around the reflection vector, shape (...)."""
    return lobe(reflection(normal, to_light), to_eye, shininess)


def blinn_factor(
    normal: ArrayLike, to_light: ArrayLike, to_eye: ArrayLike, shininess: ArrayLike
) -> Array:
    """max(n·h, 0)^sh: Blinn's alternative with the halfway vector, shape (...).

    Source: Blinn, Models of Light Reflection for Computer Synthesized Pictures, 1977.
    """
    return lobe(normal, halfway(to_light, to_eye), shininess)


def gate(normal: ArrayLike, to_light: ArrayLike) -> Array:
    """1 where the light is above the surface, n·l > 0, and 0 elsewhere, shape (...).

    Times the specular factor it removes highlights on surfaces that face away from the light,
    which the lecture's formula, taken literally, allows. Source: Akenine-Möller et al.,
    Real-Time Rendering 4, chapter 9.
    """
    cosine = dot(normal, to_light)
    return np.asarray((cosine > 0.0).astype(cosine.dtype))


def diffuse_term(factor: ArrayLike, product: ArrayLike) -> Array:
    """Lambert's factor (...) times the product s_d ⊗ m_d (..., 3) of `component_filter`."""
    factor, product = floats(factor, product)
    return np.asarray(factor[..., None] * product)


def specular_term(factor: ArrayLike, product: ArrayLike) -> Array:
    """The factor of the highlight (...) times the product s_s ⊗ m_s (..., 3)."""
    factor, product = floats(factor, product)
    return np.asarray(factor[..., None] * product)


def ambient_term(light: ArrayLike, material: ArrayLike) -> Array:
    """s_a ⊗ m_a: light from everywhere, scattered everywhere; shape (..., 3)."""
    return component_filter(light, material)


def emissive_term(material: ArrayLike) -> Array:
    """m_e: what the surface sends out by itself; shape (..., 3)."""
    return floats(material)[0]


def weighted_sum(
    diffuse: ArrayLike,
    specular: ArrayLike,
    ambient: ArrayLike,
    emissive: ArrayLike,
    weights: ArrayLike = (1.0, 1.0, 1.0, 1.0),
) -> Array:
    """The sum of the four terms, each times its weight (a switch, or a fader); (..., 3)."""
    w, *terms = floats(weights, diffuse, specular, ambient, emissive)
    weighted = [w[..., i, None] * term for i, term in enumerate(terms)]
    return np.asarray(weighted[0] + weighted[1] + weighted[2] + weighted[3])
