"""The shapes a setup can name: one row per generator, and the door that checks.

A new shape is a function ``tessellation -> Mesh`` and a row in `SHAPES`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

from playground.errors import PlaygroundError, unknown_name
from playground.scene.mesh import Mesh
from playground.scene.shapes_curved import cone, cylinder, disc, icosphere, torus, uv_sphere
from playground.scene.shapes_flat import box, grid, quad
from playground.scene.teapot import teapot


@dataclass(frozen=True)
class Shape:
    """A generated shape and the range of its one knob.

    Parameters
    ----------
    name : str
    make : function of the tessellation that returns a `Mesh`
    default_tessellation, min, max : int
    help : str
        What the tessellation counts.
    """

    name: str
    make: Callable[[int], Mesh]
    default_tessellation: int
    min: int
    max: int
    help: str


SHAPES: dict[str, Shape] = {
    shape.name: shape
    for shape in (
        Shape("sphere", uv_sphere, 32, 3, 512, "segments around; half as many rings"),
        Shape("icosphere", icosphere, 8, 1, 256, "parts of each icosahedron edge"),
        Shape("torus", torus, 32, 3, 512, "segments around; half as many around the tube"),
        Shape("quad", quad, 1, 1, 512, "cells along each edge"),
        Shape("grid", grid, 16, 1, 512, "cells along each edge"),
        Shape("disc", disc, 32, 3, 512, "segments around; an eighth as many rings"),
        Shape("box", box, 1, 1, 256, "cells along each edge"),
        Shape("cylinder", cylinder, 32, 3, 512, "segments around; a quarter as many rows"),
        Shape("cone", cone, 32, 3, 512, "segments around; a quarter as many rows"),
        Shape("teapot", teapot, 10, 1, 64, "segments along each edge of the 32 patches"),
    )
}


def make(name: str, tessellation: int | None = None) -> Mesh:
    """The shape of this name; the same arguments give the same object again.

    Parameters
    ----------
    name : str
        A key of `SHAPES`.
    tessellation : int, optional
        Within the shape's range; None takes its default.

    Raises
    ------
    PlaygroundError
        The name is unknown, or the tessellation is not a whole number in the range.
    """
    if not isinstance(name, str) or name not in SHAPES:
        raise unknown_name("shape", name, SHAPES)
    shape = SHAPES[name]
    count = shape.default_tessellation if tessellation is None else tessellation
    try:
        whole = count == int(count) and not isinstance(count, bool)
    except (TypeError, ValueError, OverflowError):
        whole = False
    if not whole or not shape.min <= int(count) <= shape.max:
        raise PlaygroundError(
            f"tessellation of '{name}' must be a whole number in its range",
            got=count,
            allowed=f"{shape.min} to {shape.max} ({shape.help})",
            fix=f"Leave it out to get {shape.default_tessellation}.",
        )
    return _made(name, int(count))


@lru_cache(maxsize=32)
def _made(name: str, tessellation: int) -> Mesh:
    return SHAPES[name].make(tessellation)
