"""Lesson 7: the diffuse and the specular term, and how people get them wrong."""

from __future__ import annotations

from collections.abc import Callable, Collection
from functools import partial
from itertools import combinations

import numpy as np

from playground.lesson.assignment import Arrays, Assignment, Student, Task
from playground.render.image import Image
from playground.shading import phong
from playground.shading.vector import Array, dot, halfway, unit

DIFFUSE = {
    "max": "the max is missing: a light behind the surface takes light away",
    "abs": "the absolute value stands where the max should: the dark side is lit too",
    "light": "the light vector is reversed: it must point from the surface to the light",
    "normal": "the normal is not made unit length again after interpolation",
    "sum": "light and material are added; ⊗ multiplies them, component by component",
}
SPECULAR = {
    "max": "the max is missing: an even power makes a second highlight of a negative r·v",
    "light": "r points the other way: the light vector is reversed, or it is l − 2n(n·l)",
    "normal": "the normal is not made unit length again after interpolation",
    "swapped": "n and l are swapped in the reflection vector: r = 2n(n·l) − l",
    "factor": "the shininess multiplies r·v; it is its exponent",
    "halfway": "this is n·h, Blinn's highlight; the lecture's is r·v",
    "gate": "the term is cut where n·l is not above 0; the lecture has no such gate",
    "sum": "light and material are added; ⊗ multiplies them, component by component",
}
COUNT, SIZE, SEED = 240, 120, 7
SHININESS = (5.0, 10.0, 20.0, 80.0)


def diffuse(
    normal: Array, to_light: Array, light: Array, material: Array, wrong: Collection[str] = ()
) -> Array:
    """The diffuse term of rows of arguments, with the mistakes named in ``wrong``."""
    n = normal if "normal" in wrong else unit(normal)
    cosine = dot(n, -to_light if "light" in wrong else to_light)
    if "abs" in wrong:
        cosine = np.abs(cosine)
    elif "max" not in wrong:
        cosine = np.maximum(cosine, 0.0)
    return np.asarray(cosine[:, None] * _product(light, material, wrong))


def specular(
    normal: Array,
    to_light: Array,
    to_eye: Array,
    shininess: Array,
    light: Array,
    material: Array,
    wrong: Collection[str] = (),
) -> Array:
    """The specular term of rows of arguments, with the mistakes named in ``wrong``."""
    n = normal if "normal" in wrong else unit(normal)
    to_light = -to_light if "light" in wrong else to_light
    a, b = (to_light, n) if "swapped" in wrong else (n, to_light)
    cosine = dot(2.0 * dot(a, b)[:, None] * a - b, to_eye)
    if "halfway" in wrong:
        cosine = dot(n, halfway(to_light, to_eye))
    if "max" not in wrong:
        cosine = np.maximum(cosine, 0.0)
    factor = cosine * shininess if "factor" in wrong else cosine**shininess
    if "gate" in wrong:
        factor = factor * (dot(n, to_light) > 0.0)
    return np.asarray(factor[:, None] * _product(light, material, wrong))


def _product(light: Array, material: Array, wrong: Collection[str]) -> Array:
    return light + material if "sum" in wrong else light * material


def _right_diffuse(normal: Array, to_light: Array, light: Array, material: Array) -> Array:
    """By the formulas of the program itself."""
    factor = phong.diffuse_factor(unit(normal), to_light)
    return phong.diffuse_term(factor, phong.component_filter(light, material))


def _right_specular(
    normal: Array, to_light: Array, to_eye: Array, shininess: Array, light: Array, material: Array
) -> Array:
    factor = phong.specular_factor(unit(normal), to_light, to_eye, shininess)
    return phong.specular_term(factor, phong.component_filter(light, material))


def _mistakes(made: Callable[..., Array], named: dict[str, str]) -> dict[str, Callable[..., Array]]:
    """Each mistake alone, then any two together."""
    pairs = [(a,) for a in named] + list(combinations(named, 2))
    return {"; and ".join(named[a] for a in pair): partial(made, wrong=pair) for pair in pairs}


def _cases() -> dict[str, Arrays]:
    """Vectors in all directions, the normals shortened as interpolation does it; colours."""
    rng = np.random.default_rng(SEED)
    normal, to_light, to_eye = (unit(rng.normal(size=(COUNT, 3))) for _ in range(3))
    normal = normal * rng.uniform(0.6, 1.0, (COUNT, 1))
    light, material = rng.uniform(0.1, 1.0, (2, COUNT, 3))
    shininess = rng.choice(SHININESS, COUNT)
    return {
        "diffuse": (normal, to_light, light, material),
        "specular": (normal, to_light, to_eye, shininess, light, material),
    }


def _picture(student: Student) -> Image:
    """A ball whose normals are shorter within its facets, by the student's two functions."""
    x, y = np.meshgrid(*[np.linspace(-1.1, 1.1, SIZE)] * 2)
    inside = x**2 + y**2 < 1.0
    normal = np.stack([x, -y, np.sqrt(np.clip(1.0 - x**2 - y**2, 0.0, None))], axis=-1)[inside]
    normal *= 1.0 - 0.3 * np.sin(6.0 * normal[:, :1]) ** 2 * np.sin(6.0 * normal[:, 1:2]) ** 2

    def rows(*values: float) -> Array:
        return np.broadcast_to(np.array(values, dtype=np.float64), (len(normal), len(values)))

    to_light, to_eye = unit(rows(-1.0, 1.0, 0.6)), rows(0.0, 0.0, 1.0)
    white, grey = rows(1.0, 1.0, 1.0), rows(0.5, 0.5, 0.5)
    colour = student.call("diffuse", (normal, to_light, white, rows(0.7, 0.25, 0.2)))
    shininess = rows(20.0)[:, 0]
    colour = colour + student.call("specular", (normal, to_light, to_eye, shininess, white, grey))
    pixels = np.full((SIZE, SIZE, 3), 0.1, dtype=np.float32)
    pixels[inside] = np.nan_to_num(np.clip(colour, -1e3, 1e3))
    return Image(pixels)


_CASES = _cases()
ASSIGNMENT = Assignment(
    "the diffuse and the specular term",
    (
        Task(
            "diffuse",
            ("normal", "to_light", "light", "material"),
            _right_diffuse,
            _mistakes(diffuse, DIFFUSE),
            _CASES["diffuse"],
        ),
        Task(
            "specular",
            ("normal", "to_light", "to_eye", "shininess", "light", "material"),
            _right_specular,
            _mistakes(specular, SPECULAR),
            _CASES["specular"],
        ),
    ),
    _picture,
)
