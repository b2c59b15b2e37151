"""Whether corners in space are the outline of a flat polygon.

Plain Python, because a light is declared before anything is computed.
"""

from __future__ import annotations

from itertools import combinations, pairwise
from math import sqrt

from playground.errors import PlaygroundError

Point = tuple[float, float, float]
FLAT = 1e-5  # of the polygon's extent: how far a corner may lie off the plane of all
Flat = tuple[float, float]


def check_outline(corners: tuple[Point, ...], where: str) -> None:
    """Raise a `PlaygroundError` unless the corners bound a flat polygon that meets itself nowhere.

    Corners may coincide with their neighbours, and edges may be collinear. A corner may lie
    `FLAT` times the extent off the plane: what single precision and rounded decimals do.
    """
    normal, extent = area_vector(corners), _extent(corners)
    size = sqrt(sum(n * n for n in normal))
    if size <= FLAT * extent * extent:
        raise PlaygroundError(
            f"{where} bound no area",
            got=f"{len(corners)} corners on a line or in one place",
            fix="Give the corners of a flat polygon in order, counter-clockwise as it shines.",
        )
    for number, corner in enumerate(corners):
        offset = (c - o for c, o in zip(corner, corners[0], strict=True))
        off = sum(n * d for n, d in zip(normal, offset, strict=True)) / size
        if abs(off) > FLAT * extent:
            raise PlaygroundError(
                f"{where} do not lie in one plane",
                got=f"corner {number} at {corner}, {abs(off):.3g} off",
                allowed=f"at most {FLAT:g} of the extent, {FLAT * extent:.3g}",
                fix="Move that corner, or split the polygon into triangles.",
            )
    _refuse_crossing(corners, normal, where)


def area_vector(corners: tuple[Point, ...]) -> Point:
    """The normal of a polygon, as long as twice its area (Newell 1974)."""
    total = [0.0, 0.0, 0.0]
    a = [[c - o for c, o in zip(corner, corners[0], strict=True)] for corner in corners]
    for p, q in pairwise(a):
        for i in range(3):
            j, k = (i + 1) % 3, (i + 2) % 3
            total[i] += p[j] * q[k] - p[k] * q[j]
    return total[0], total[1], total[2]


def _extent(corners: tuple[Point, ...]) -> float:
    """The longest side of the box around the corners."""
    columns: list[tuple[float, ...]] = list(zip(*corners, strict=True))
    return max(max(column) - min(column) for column in columns)


def _refuse_crossing(corners: tuple[Point, ...], normal: Point, where: str) -> None:
    axis = max(range(3), key=lambda i: abs(normal[i]))
    flat = [(c[(axis + 1) % 3], c[(axis + 2) % 3]) for c in corners]
    edges = list(zip(flat, flat[1:] + flat[:1], strict=True))
    for (i, first), (j, second) in combinations(enumerate(edges), 2):
        if _cross(first, second):
            raise PlaygroundError(
                f"{where} cross themselves",
                got=f"the edge from corner {i} and that from corner {j}",
                fix="Give the corners in the order in which they follow each other.",
            )


def _cross(first: tuple[Flat, Flat], second: tuple[Flat, Flat]) -> bool:
    """Whether two edges cut through each other; touching does not count."""
    (a, b), (c, d) = first, second
    return _side(a, b, c) * _side(a, b, d) < 0.0 and _side(c, d, a) * _side(c, d, b) < 0.0


def _side(a: Flat, b: Flat, p: Flat) -> float:
    """On which side of the line from a to b the point p lies."""
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
