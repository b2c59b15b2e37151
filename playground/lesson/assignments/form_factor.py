"""Lesson 14: the form factor of points and of patches, and how people get them wrong."""

from __future__ import annotations

from collections.abc import Callable, Collection
from functools import partial
from itertools import combinations

import numpy as np

from playground.lesson.assignment import Arrays, Assignment, Student, Task
from playground.render.image import Image
from playground.shading import form_factor
from playground.shading.vector import Array, cross, dot, unit

POINTS = {
    "pi": "π is missing below the fraction bar",
    "here": "cos θ_x is missing: the sender shows less of itself at a slant",
    "there": "cos θ_y is missing: the receiver catches less at a slant",
    "distance": "the distance stands where its square should",
    "clamp": "a cosine below 0 is not cut off: what faces away gets no light",
    "abs": "the absolute value stands where the max should: what faces away gets light too",
    "reversed": "one v serves for both cosines: seen from y, the way to x is −v",
    "swapped": "the normals are swapped",
    "length": "v is not made unit length in the cosines",
    "normals": "the normals are not made unit length",
}
PATCHES = {
    "area": "the area of a piece of j is missing: the formula of two points is per area of y",
    "sum": "the sum over the pieces of i stands where their mean should: each has a part of i",
    "other": "this is F_ji, from patch j to patch i",
    "centres": "this is the formula of the two centres alone; the patches must be cut",
    "corners": "the points are corners of the pieces; their centres stand for them",
    "half": "the edges are taken for half edges, so that each patch is too large",
}
PIECES = 4  # along each edge of a patch
COUNT, FEW, SIZE, SEED = 240, 60, 60, 14
TILES = 10  # of the picture of patches, along an edge
BRIGHT = 3.0  # of the picture: a form factor of 1/3 is white


def point_to_point(
    x: Array, normal_x: Array, y: Array, normal_y: Array, wrong: Collection[str] = ()
) -> Array:
    """The form factor per area of points (N, 3), as (N, 1), with the mistakes in ``wrong``."""
    n, m = (normal_y, normal_x) if "swapped" in wrong else (normal_x, normal_y)
    if "normals" not in wrong:
        n, m = unit(n), unit(m)
    way = y - x
    squared = dot(way, way)
    v = way if "length" in wrong else unit(way)
    here, there = dot(n, v), dot(m, v if "reversed" in wrong else -v)
    if "abs" in wrong:
        here, there = np.abs(here), np.abs(there)
    elif "clamp" not in wrong:
        here, there = np.maximum(here, 0.0), np.maximum(there, 0.0)
    product = (1.0 if "here" in wrong else here) * (1.0 if "there" in wrong else there)
    below = (1.0 if "pi" in wrong else np.pi) * (
        np.sqrt(squared) if "distance" in wrong else squared
    )
    return np.asarray(product / below)[..., None]


def patch_to_patch(
    corner_i: Array,
    first_i: Array,
    second_i: Array,
    corner_j: Array,
    first_j: Array,
    second_j: Array,
    wrong: Collection[str] = (),
) -> Array:
    """The form factor of parallelograms (N, 3) each, as (N, 1), with the mistakes in ``wrong``.

    Mistakes of `point_to_point` may be among them.
    """
    i, j = (corner_i, first_i, second_i), (corner_j, first_j, second_j)
    if "other" in wrong:
        i, j = j, i
    pieces = 1 if "centres" in wrong else PIECES
    (x, n, _), (y, m, area) = (_cut(*patch, pieces, wrong) for patch in (i, j))
    pairs = point_to_point(x[:, :, None], n[:, None, None], y[:, None], m[:, None, None], wrong)
    total = pairs[..., 0].sum(axis=(1, 2)) * (1.0 if "area" in wrong else area)
    return np.asarray(total if "sum" in wrong else total / pieces**2)[:, None]


def _cut(
    corner: Array, first: Array, second: Array, pieces: int, wrong: Collection[str]
) -> tuple[Array, Array, Array]:
    """Points of the pieces (N, P, 3), the normals (N, 3), the areas of a piece (N,)."""
    stretch = 2.0 if "half" in wrong else 1.0
    first, second = stretch * first, stretch * second
    along = (np.arange(pieces) + (0.0 if "corners" in wrong else 0.5)) / pieces
    s, t = (a.reshape(1, -1, 1) for a in np.meshgrid(along, along))
    normal = cross(first, second)
    area = np.sqrt(dot(normal, normal)) / pieces**2
    return corner[:, None] + s * first[:, None] + t * second[:, None], normal, area


def _right_points(x: Array, normal_x: Array, y: Array, normal_y: Array) -> Array:
    """By the formula of the program itself."""
    return form_factor.point_to_point(x, normal_x, y, normal_y)[:, None]


def _mistakes(made: Callable[..., Array], named: dict[str, str]) -> dict[str, Callable[..., Array]]:
    """Each mistake alone, then any two together."""
    some = [(a,) for a in named] + list(combinations(named, 2))
    return {"; and ".join(named[a] for a in few): partial(made, wrong=few) for few in some}


def _cases() -> dict[str, Arrays]:
    """Points half a unit to two apart, most facing each other; small patches, two to three apart.

    Of the patches the first three quarters face each other, the others lie as it comes.
    """
    rng = np.random.default_rng(SEED)
    x, way = rng.uniform(-1.0, 1.0, (COUNT, 3)), unit(rng.normal(size=(COUNT, 3)))
    normals = [unit(s * way + rng.normal(size=(COUNT, 3))) for s in (1.0, -1.0)]
    normal_x, normal_y = (n * rng.uniform(0.5, 2.0, (COUNT, 1)) for n in normals)
    points = x, normal_x, x + way * rng.uniform(0.5, 2.0, (COUNT, 1)), normal_y

    some = way[:FEW]
    tilt = np.where(np.arange(FEW) < 3 * FEW // 4, 0.3, 2.0)[:, None]
    middle = rng.uniform(-1.0, 1.0, (FEW, 3))
    corners = [middle, middle + some * rng.uniform(2.0, 3.0, (FEW, 1))]
    patches = []
    for corner, facing in zip(corners, (1.0, -1.0), strict=True):
        first = unit(cross(some, rng.normal(size=(FEW, 3))))
        second = facing * unit(cross(some, first) + tilt * rng.normal(size=(FEW, 3)))
        sizes = rng.uniform(0.4, 1.0, (2, FEW, 1))
        patches += [corner, sizes[0] * first, sizes[1] * second]
    return {"point_to_point": points, "patch_to_patch": tuple(patches)}


def _picture(student: Student) -> Image:
    """A floor below a slanted lamp: left by points, right by patches of floor and lamp."""
    corner, first, second = (-0.7, -0.45, 0.35), (0.0, 0.9, 0.0), (0.5, 0.0, 0.7)
    lamp = [np.array(vector) for vector in (corner, first, second)]
    normal = cross(lamp[1], lamp[2])
    centre, area = lamp[0] + 0.5 * (lamp[1] + lamp[2]), float(np.sqrt(dot(normal, normal)))

    spots = _floor(SIZE)
    up = np.broadcast_to([0.0, 0.0, 1.0], spots.shape)
    there, ahead = (np.broadcast_to(v, spots.shape) for v in (centre, normal))
    left = area * student.call("point_to_point", (spots, up, there, ahead)).reshape(SIZE, SIZE)

    edge = 2.4 / TILES
    tiles = _floor(TILES) - (0.5 * edge, 0.5 * edge, 0.0)
    edges = [np.array([edge, 0.0, 0.0]), np.array([0.0, edge, 0.0])]
    sides = [np.broadcast_to(vector, tiles.shape) for vector in (*edges, *lamp)]
    right = student.call("patch_to_patch", (tiles, *sides)).reshape(TILES, TILES)
    right = right.repeat(SIZE // TILES, axis=0).repeat(SIZE // TILES, axis=1)
    both = np.concatenate([left, right], axis=1).repeat(2, axis=0).repeat(2, axis=1)
    both = both[..., None].repeat(3, axis=2)
    return Image(np.clip(np.nan_to_num(BRIGHT * both), -1e3, 1e3).astype(np.float32))


def _floor(count: int) -> Array:
    """Points of the floor, (count², 3), row by row from the back."""
    along = ((np.arange(count) + 0.5) / count * 2.0 - 1.0) * 1.2
    x, y = np.meshgrid(along, -along)
    return np.stack([x.ravel(), y.ravel(), np.zeros(count * count)], axis=-1)


_CASES = _cases()
ASSIGNMENT = Assignment(
    "the form factor",
    (
        Task(
            "point_to_point",
            ("x", "normal_x", "y", "normal_y"),
            _right_points,
            _mistakes(point_to_point, POINTS),
            _CASES["point_to_point"],
            width=1,
        ),
        Task(
            "patch_to_patch",
            ("corner_i", "first_i", "second_i", "corner_j", "first_j", "second_j"),
            patch_to_patch,
            _mistakes(patch_to_patch, PATCHES | POINTS),
            _CASES["patch_to_patch"],
            width=1,
        ),
    ),
    _picture,
)
