"""Where a ray leaves a surface: how often it hits that surface again, and what it jumps over."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import ExitStack
from dataclasses import dataclass
from functools import lru_cache, partial

import numpy as np
from numpy.typing import NDArray

from playground.measure.experiments.sentences import of, sentence
from playground.measure.record import Batch, Candidate, Errors, Experiment, Timer
from playground.measure.rows import Row
from playground.measure.timing import rounds_of
from playground.percent import percent
from playground.shading.ray import offset_ray
from playground.shading.triangle import ray_triangle
from playground.shading.vector import unit

Singles = NDArray[np.float32]

# Scenes: their size, and how far from the origin they are.
SCENES = ((1.0, 0.0), (1e-3, 0.0), (1e3, 0.0), (1.0, 1.0), (1.0, 100.0), (1.0, 1e4), (1.0, 1e6))
QUICK_SCENES = SCENES[:2] + SCENES[5:6]
COUNT, QUICK_COUNT = 20000, 4000
EPSILON = np.float32(1e-4)
ROUNDINGS = np.float32(16.0) * np.finfo(np.float32).eps  # as in shaders/trace
GAP = 1e-3  # to the next surface, in sizes of the scene: no ray may start beyond it
SEED = 3
SELF, JUMPED, MOVED = "hit itself", "jumped over the gap", "moved by, in sizes"
OURS = "error bound, relative to the eye"
REFERENCE = "a ray that neither meets its own triangle nor starts beyond a gap of 0.001 sizes"


@dataclass(frozen=True, eq=False)
class Leaving:
    """N points on N triangles and rays that leave them: all in float32.

    ``corners`` (N, 3, 3) and ``largest`` (N,), the largest of their numbers; ``point``, ``normal``
    and ``direction`` (N, 3) on the normal's side.
    """

    corners: Singles
    point: Singles
    normal: Singles
    direction: Singles
    largest: Singles


def unmoved(rays: Leaving) -> Singles:
    """No offset at all."""
    return rays.point


def fixed(rays: Leaving) -> Singles:
    """A fixed step along the normal: right for one scale, wrong for others."""
    return rays.point + EPSILON * rays.normal


def bounded(rays: Leaving) -> Singles:
    """`offset_ray` beyond the bound on the rounding of the point, as the ray tracer does.

    The point is a sum of its triangle's corners: the largest of their numbers tells the rounding.
    """
    return np.asarray(offset_ray(rays.point, rays.normal, ROUNDINGS * rays.largest))


def integer(rays: Leaving) -> Singles:
    """A step in units of the last place, a fixed one near the origin.

    Source: Wächter, Binder, A Fast and Robust Method for Avoiding Self-Intersection, Ray
    Tracing Gems, 2019, chapter 6; the constants are theirs.
    """
    point, normal = rays.point, rays.normal
    steps = (np.float32(256.0) * normal).astype(np.int32)
    bits = np.ascontiguousarray(point).view(np.int32)
    moved = (bits + np.where(point < 0.0, -steps, steps)).view(np.float32)
    near = np.abs(point) < np.float32(1.0 / 32.0)
    return np.where(near, point + np.float32(1.0 / 65536.0) * normal, moved)


Offset = Callable[[Leaving], Singles]

METHODS: dict[str, Offset] = {
    "none": unmoved,
    "fixed epsilon": fixed,
    "error bound": bounded,
    "Wächter-Binder": integer,
    OURS: bounded,
}


@lru_cache(maxsize=16)
def leaving(size: float, place: float, count: int) -> Leaving:
    """Random triangles of about ``size`` around points at distance ``place`` from the origin."""
    rng = np.random.default_rng(SEED)
    middle = place * unit(rng.normal(size=(count, 1, 3)))
    corners = (middle + size * rng.normal(size=(count, 3, 3))).astype(np.float32)
    exact = corners.astype(np.float64)
    across = np.cross(exact[:, 1] - exact[:, 0], exact[:, 2] - exact[:, 0])
    normal = unit(across)
    ahead = unit(rng.normal(size=(count, 3)))
    ahead *= np.where(np.einsum("ni,ni->n", ahead, normal) < 0.0, -1.0, 1.0)[:, None]
    weights = rng.dirichlet(np.ones(3), count).astype(np.float32)
    point = np.einsum("nc,ncx->nx", weights, corners)
    largest = np.abs(corners).max(axis=(1, 2))
    return Leaving(corners, point, normal.astype(np.float32), ahead.astype(np.float32), largest)


def groups(quick: bool) -> Iterator[list[Candidate]]:
    """Every method in one scene, in turn."""
    for size, place in QUICK_SCENES if quick else SCENES:
        count = QUICK_COUNT if quick else COUNT
        yield [_candidate(method, size, place, count) for method in METHODS]


def _candidate(method: str, size: float, place: float, count: int) -> Candidate:
    # Seen from an eye in the scene: what is far from the origin has moved there before rounding.
    seen = 0.0 if method == OURS else place

    def opened(_: ExitStack) -> Timer:
        rays, move = leaving(size, seen, count), METHODS[method]
        timer = rounds_of(lambda: move(rays), 1)

        def batch() -> Batch:
            return Batch([1e6 * t / count for t in timer().times])

        return batch

    case = f"size {size:g}" + (f", {place:g} from the origin" if place else "")
    rays = partial(leaving, size, seen, count)
    return Candidate(method, {}, opened, lambda: judged(METHODS[method], rays(), size), case)


def judged(move: Offset, rays: Leaving, size: float) -> Errors:
    """The share of rays that start wrongly, of either kind; errors are shares of all rays."""
    start = move(rays)
    a, b, c = np.moveaxis(rays.corners, 1, 0)
    again = ray_triangle(start, rays.direction, a, b, c)[0] > 0.0

    # How far beyond its triangle a ray starts: in float64, from the exact plane.
    exact, wide = rays.corners.astype(np.float64), start.astype(np.float64)
    across = np.cross(exact[:, 1] - exact[:, 0], exact[:, 2] - exact[:, 0])
    height = np.einsum("ni,ni->n", unit(across), wide - exact[:, 0])
    jumped = height > GAP * size
    wrong = float((again | jumped).mean())
    moved = np.linalg.norm(wide - rays.point.astype(np.float64), axis=1) / size
    more = {
        SELF: float(again.mean()),
        JUMPED: float(jumped.mean()),
        MOVED: float(np.median(moved)),
    }
    return Errors(float(np.sqrt(wrong)), wrong, wrong, REFERENCE, more=more)


def finding(rows: list[Row]) -> str:
    """For each method in which scenes it fails, and how often at worst."""
    parts = []
    for method in METHODS:
        judged_ones = [row for row in of(rows, method) if row.error is not None]
        fails = [row for row in judged_ones if row.error]
        if fails:
            worst = max(fails, key=lambda row: row.error or 0.0)
            parts.append(
                f"{method} starts rays wrongly in {len(fails)} of {len(judged_ones)} scenes, "
                f"at worst {percent(worst.error or 0.0)} ({worst.case})"
            )
        elif judged_ones:
            parts.append(f"{method} in none of {len(judged_ones)}")
    return sentence(*parts)


EXPERIMENT = Experiment(
    "offset",
    "Self-intersection",
    "A ray that leaves a surface must not meet it again: which offset achieves that, in small "
    "scenes and far from the origin, and how far does it move the ray? (float32.)",
    groups,
    finding,
    REFERENCE,
    error="mean",
    error_label="share of rays that start wrongly",
    time_label="ns per ray",
    needs_gl=False,
    show=("mean", SELF, JUMPED, MOVED),
)
