"""Lesson 13: the direction of a refracted ray, and how people get it wrong."""

from __future__ import annotations

from collections.abc import Collection
from functools import partial
from itertools import combinations

import numpy as np

from playground.lesson.assignment import Arrays, Assignment, Student, Task
from playground.render.image import Image
from playground.shading import optics
from playground.shading.vector import Array, dot, reflection, unit

REFRACTION = {
    "indices": "the indices are swapped: the ratio is n_i / n_t, from the side where the eye is",
    "reversed": "to_eye is reversed: it points away from the surface, against the ray that comes",
    "square": "the square of n_i / n_t is forgotten in sin² θ_t = (n_i / n_t)² sin² θ_i",
    "sine": "the square of the cosine is forgotten: sin² θ_i = 1 − cos² θ_i",
    "root": "the root is forgotten: cos θ_t is the root of 1 − sin² θ_t",
    "total": "total internal reflection is missing: where sin² θ_t > 1, the answer is zero",
    "clamped": "total internal reflection is hidden: clamping 1 − sin² θ_t to 0 makes a ray "
    "along the surface, where none goes on",
    "along": "n_i / n_t does not weaken the part along the surface",
    "side": "the ray stays on its side: the part along the normal has the wrong sign",
}
MIRRORED = "this is the reflected ray"
STRAIGHT = "this is the ray going straight on"
COUNT, SIZE, SEED = 240, 120, 13
NEAREST = 1e-3  # how near to the critical angle a case may be: |1 − sin² θ_t|, see _cases
INDICES = (1.0, 1.333, 1.5, 2.42)
SKY, DARK, LIGHT = (0.55, 0.65, 0.75), (0.2, 0.12, 0.1), (0.95, 0.85, 0.7)


def refraction(
    normal: Array, to_eye: Array, index_i: Array, index_t: Array, wrong: Collection[str] = ()
) -> Array:
    """The refracted direction of rows of arguments, with the mistakes named in ``wrong``."""
    to_eye = -to_eye if "reversed" in wrong else to_eye
    ratio = index_t / index_i if "indices" in wrong else index_i / index_t
    cosine = dot(normal, to_eye)
    sine_squared = 1.0 - (cosine if "sine" in wrong else cosine * cosine)
    squared = 1.0 - (ratio if "square" in wrong else ratio * ratio) * sine_squared
    total = squared < 0.0
    if "clamped" in wrong:
        squared = np.maximum(squared, 0.0)
    with np.errstate(invalid="ignore"):  # NaN where nothing goes through
        cosine_t = squared if "root" in wrong else np.sqrt(squared)
    along = (to_eye - cosine[:, None] * normal) * (1.0 if "along" in wrong else ratio[:, None])
    across = cosine_t[:, None] * normal
    direction = -along + across if "side" in wrong else -along - across
    if "total" not in wrong and "clamped" not in wrong:
        direction = np.where(total[:, None], 0.0, direction)
    return np.asarray(direction)


def _mirrored(normal: Array, to_eye: Array, index_i: Array, index_t: Array) -> Array:
    return reflection(normal, to_eye)


def _straight(normal: Array, to_eye: Array, index_i: Array, index_t: Array) -> Array:
    return -to_eye


def _cases() -> Arrays:
    """Rays from either side of boundaries between all pairs of media.

    None is near the critical angle: there a root makes a rounding of float32, 1e-7, larger by
    half of its inverse, so that 1e-3 under the root leaves an error of 2e-6.
    """
    rng = np.random.default_rng(SEED)
    many = 4 * COUNT
    normal, to_eye = unit(rng.normal(size=(many, 3))), unit(rng.normal(size=(many, 3)))
    to_eye = np.where((dot(normal, to_eye) < 0.0)[:, None], -to_eye, to_eye)
    index_i, index_t = rng.choice(INDICES, many), rng.choice(INDICES, many)
    sine = index_i / index_t * optics.sine_between(normal, to_eye)
    use = np.flatnonzero((index_i != index_t) & (np.abs(1.0 - sine * sine) > NEAREST))[:COUNT]
    return normal[use], to_eye[use], index_i[use], index_t[use]


def _picture(student: Student) -> Image:
    """A ball of glass in air and a bubble of air in glass before tiles, by the student's function.

    The rays are parallel. Where the function says that nothing goes through, there is sky.
    """
    balls = [_ball(student, *indices) for indices in ((1.0, 1.5), (1.5, 1.0))]
    return Image(np.concatenate(balls, axis=1).astype(np.float32))


def _ball(student: Student, outside: float, inside: float) -> Array:
    x, y = np.meshgrid(*[np.linspace(-1.1, 1.1, SIZE)] * 2)
    hit = x**2 + y**2 < 0.999
    place = np.stack([x, -y, np.sqrt(np.clip(1.0 - x**2 - y**2, 0.0, None))], axis=-1)[hit]
    to_eye = np.broadcast_to([0.0, 0.0, 1.0], place.shape)
    index_i, index_t = np.full(len(place), outside), np.full(len(place), inside)

    # In at the front; from the chord to the back, which is met from within; and out again.
    ray = _called(student, place, to_eye, index_i, index_t)
    back = place - 2.0 * dot(place, ray)[:, None] * ray
    leaving = _called(student, -unit(back), -ray, index_t, index_i)
    gone = ~(dot(ray, ray) > 0.5) | ~(leaving[:, 2] < -1e-3)
    leaving[gone] = (0.0, 0.0, -1.0)
    way = (back[:, 2] + 3.0) / -leaving[:, 2]  # the tiles are 3 behind the middle of the ball
    pixels = np.empty((SIZE, SIZE, 3))
    pixels[:] = _tiles(x, -y)[..., None] * np.subtract(LIGHT, DARK) + DARK
    spot = back[:, :2] + way[:, None] * leaving[:, :2]
    seen = _tiles(spot[:, 0], spot[:, 1])[:, None] * np.subtract(LIGHT, DARK) + DARK
    pixels[hit] = np.where(gone[:, None], SKY, seen)
    return pixels


def _called(
    student: Student, normal: Array, to_eye: Array, index_i: Array, index_t: Array
) -> Array:
    made = student.call("refraction", (normal, to_eye, index_i, index_t))
    return np.asarray(np.clip(np.nan_to_num(made), -1e3, 1e3))


def _tiles(x: Array, y: Array) -> Array:
    """1 on the light tiles and 0 on the dark ones."""
    return np.asarray((np.floor(2.0 * x + 0.5) + np.floor(2.0 * y + 0.5)) % 2.0)


_PAIRS = [(a,) for a in REFRACTION] + list(combinations(REFRACTION, 2))
ASSIGNMENT = Assignment(
    "the refracted ray",
    (
        Task(
            "refraction",
            ("normal", "to_eye", "index_i", "index_t"),
            optics.refraction,
            {
                **{
                    "; and ".join(REFRACTION[a] for a in pair): partial(refraction, wrong=pair)
                    for pair in _PAIRS
                },
                MIRRORED: _mirrored,
                STRAIGHT: _straight,
            },
            _cases(),
        ),
    ),
    _picture,
)
