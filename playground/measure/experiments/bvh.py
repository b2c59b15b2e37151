"""A tree of boxes against testing every triangle, on finer and finer balls."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import ExitStack
from dataclasses import replace
from functools import lru_cache
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from playground.measure.experiments.sentences import listed, of, sentence, times
from playground.measure.ray_kinds import Rays, ray_kinds
from playground.measure.record import Batch, Candidate, Errors, Experiment, Timer
from playground.measure.rows import Row, ratio
from playground.measure.timing import rounds_of
from playground.render.trace import walk
from playground.render.trace.bvh import Bvh, build
from playground.scene.mesh import Mesh
from playground.scene.shapes_curved import icosphere

PARTS, QUICK_PARTS = (1, 2, 4, 8, 16, 32, 59), (2, 8)  # of each edge: 20 · parts² triangles
PATIENCE = 5120  # triangles: beyond, nobody waits for all of them
SIZE, QUICK_SIZE = (32, 24), (20, 15)
TREE, EVERY = "tree", "every triangle"
TESTS, BUILD = "tests per ray", "ms to build"
REFERENCE = "t of every triangle tested, in float64"
Hits = tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.float64]]


def groups(quick: bool) -> Iterator[list[Candidate]]:
    """Both methods at every number of triangles, in turn."""
    size = QUICK_SIZE if quick else SIZE
    found = []
    for parts in QUICK_PARTS if quick else PARTS:
        count = 20 * parts**2
        found.append(_candidate(TREE, parts, size))
        if count <= PATIENCE:
            found.append(_candidate(EVERY, parts, size))
    yield found


@lru_cache(maxsize=16)
def _ball(parts: int) -> tuple[Mesh, Bvh, float]:
    """A ball, its tree, and the milliseconds that it took to build."""
    mesh = icosphere(parts)
    start = perf_counter()
    tree = build(mesh.positions, mesh.faces)
    return mesh, tree, 1e3 * (perf_counter() - start)


def flat(tree: Bvh) -> Bvh:
    """A tree of one leaf with all triangles: the walk then tests every one of them."""
    count = len(tree.order)
    nothing, root = np.array([-1], dtype=np.int32), np.zeros(1, dtype=np.int32)
    return replace(
        tree,
        low=tree.low[:1],
        high=tree.high[:1],
        child=nothing,
        first=root,
        count=np.array([count], dtype=np.int32),
        levels=np.array([0, 1]),
    )


def _rays(parts: int, size: tuple[int, int]) -> Rays:
    return ray_kinds(_ball(parts)[1], size)[0]


def _candidate(method: str, parts: int, size: tuple[int, int]) -> Candidate:
    def asked() -> tuple[Bvh, Callable[[], Hits]]:
        tree, rays = _ball(parts)[1], _rays(parts, size)
        tree = tree if method == TREE else flat(tree)
        return tree, lambda: walk.closest(tree, rays.origin, rays.direction, rays.limit)

    def opened(_: ExitStack) -> Timer:
        tree, ask = asked()
        rays, timer = _rays(parts, size), rounds_of(ask, 1)
        tests = np.sum(walk.count_tests(tree, rays.origin, rays.direction, rays.limit), axis=0)
        built = _ball(parts)[2] if method == TREE else 0.0

        def batch() -> Batch:
            took = [1e3 * t / len(rays.origin) for t in timer().times]
            return Batch(took, {TESTS: [float(tests.mean())], BUILD: [built]})

        return batch

    def errors() -> Errors:
        _, ask = asked()
        rays = _rays(parts, size)
        want = walk.closest(flat(_ball(parts)[1]), rays.origin, rays.direction, rays.limit)[0]
        got = ask()[0]
        both = (got >= 0.0) & (want >= 0.0)
        off = np.abs(got - want)[both]
        rmse = float(np.sqrt(np.mean(off**2)))
        lone = int(((got >= 0.0) != (want >= 0.0)).sum())
        return Errors(rmse, float(off.max()), float(off.mean()), REFERENCE, left_out=lone)

    judged = errors if 20 * parts**2 <= PATIENCE else None
    return Candidate(method, {"triangles": 20 * parts**2}, opened, judged)


def finding(rows: list[Row]) -> str:
    """From how many triangles on the tree pays, and how much at the most that both were tried."""
    pairs = [
        (int(tree.knobs["triangles"]), ratio(every[0], tree))
        for tree in of(rows, TREE)
        if (every := of(rows, EVERY, triangles=tree.knobs["triangles"]))
    ]
    if not pairs:
        return sentence()
    gains = [f"{times(gain)} at {count}" for count, gain in pairs]
    parts = [f"every triangle takes so much longer than the tree: {listed(gains)} triangles"]
    trees = sorted(of(rows, TREE), key=lambda row: int(row.knobs["triangles"]))
    few, many = trees[0], trees[-1]
    if few is not many:
        more = int(many.knobs["triangles"]) / int(few.knobs["triangles"])
        parts.append(
            f"{times(more)} the triangles make the tree's rays take {times(ratio(many, few))} as "
            "long"
        )
    return sentence(*parts)


EXPERIMENT = Experiment(
    "bvh",
    "Tree of boxes",
    "From how many triangles on does a tree of boxes pay, and how much? (NumPy, primary rays.)",
    groups,
    finding,
    REFERENCE,
    error="max",
    error_label="largest difference of t",
    time_label="µs per ray",
    needs_gl=False,
    show=("max", "left_out", TESTS, BUILD),
)
