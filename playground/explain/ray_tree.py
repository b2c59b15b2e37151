"""The rays behind one pixel, as a tree: where each went, what it met, what it brought.

Whitted's recursion is a sum over the nodes of a tree: every ray brings the colour where it ends,
times the product of what each boundary and each medium on its way let through.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import fsum
from typing import Any

import numpy as np
from numpy.typing import NDArray

from playground.errors import PlaygroundError
from playground.scene.setup import Setup
from playground.shading.vector import Array

PRIMARY, REFLECTION, REFRACTION = "primary", "reflection", "refraction"
TOTAL = "total internal reflection"
ARRIVING, BLOCKED = "shadow arriving", "shadow blocked"
KINDS = (PRIMARY, REFLECTION, REFRACTION, TOTAL, ARRIVING, BLOCKED)


@dataclass(frozen=True, eq=False)
class ShadowRay:
    """A ray to a light, or to one of the points of an area light; points (3,) are in the world.

    ``end`` is the light (for a directional one, a point towards it, outside the scene), or
    where the ray is stopped by object ``blocker``. ``share`` (3,) of the light comes through;
    ``through`` are the objects of glass that it passes.
    """

    kind: str  # ARRIVING or BLOCKED
    start: Array
    end: Array
    share: Array
    blocker: int | None = None
    through: tuple[int, ...] = ()


@dataclass(frozen=True, eq=False)
class LightThere:
    """What one light adds to the local colour at one hit: colours (3,).

    ``diffuse`` and ``specular`` are the terms of the rasteriser, without shadow; the shares
    (3,) say how much of either arrives; ``added`` is what they come to. There are no
    ``rays`` where there is nothing to ask: the surface faces away.
    """

    light: int
    kind: str
    diffuse: Array
    specular: Array
    share_diffuse: Array
    share_specular: Array
    rays: tuple[ShadowRay, ...]

    @property
    def added(self) -> Array:
        """The two terms with shadow."""
        return np.asarray(self.share_diffuse * self.diffuse + self.share_specular * self.specular)


@dataclass(frozen=True, eq=False)
class RayNode:
    """One ray and where it ends: points and directions (3,) in the world, colours (3,), degrees.

    Its ``weight`` in the pixel is its parent's times ``factor``, what the boundary there sent
    this way, times ``faded``, what the medium on the way left. It brings ``added``: weight ⊗
    ``local`` colour. A ray that leaves the scene has no ``end``, and the background as its colour;
    of an object, ``glow`` (emissive and ambient terms) and ``lights`` make up the local colour.

    ``fresnel`` is the share that the boundary at its end reflects, between ``index_i`` and
    ``index_t``; None where nothing goes in. ``refraction`` is None under total internal
    reflection, ``critical`` where the far side is not the thinner one. ``unfollowed`` (3,) is the
    weight of the rays that depth and threshold cut off there.
    """

    number: int
    depth: int
    kind: str
    start: Array
    end: Array | None
    direction: Array
    factor: Array
    faded: Array
    weight: Array
    local: Array
    added: Array
    unfollowed: Array
    object: int | None = None
    light: int | None = None
    name: str = "background"
    normal: Array | None = None
    incidence: float | None = None
    refraction: float | None = None
    critical: float | None = None
    fresnel: float | None = None
    index_i: float = 1.0
    index_t: float = 1.0
    glow: Array | None = None
    lights: tuple[LightThere, ...] = ()
    children: tuple[RayNode, ...] = ()

    @property
    def length(self) -> float:
        """The way from ``start`` to ``end`` in world units; infinite for a ray that leaves."""
        return float("inf") if self.end is None else float(np.linalg.norm(self.end - self.start))

    def walk(self) -> Iterator[RayNode]:
        """The node itself and all below it, each before its children."""
        yield self
        for child in self.children:
            yield from child.walk()


@dataclass(frozen=True, eq=False)
class RayTree:
    """What `explain` with ``method="ray-tracing"`` returns: all rays behind one pixel.

    ``rendered`` (3,) is the pixel as the tracer renders it, ``colour`` (3,) the sum of what the
    nodes bring, their weights multiplied out anew along the branches. ``objects`` are the names
    of the scene's objects, as the words call them.
    """

    setup: Setup
    pixel: tuple[int, int]
    size: tuple[int, int]
    root: RayNode
    colour: Array
    rendered: Array
    shown: Array
    codes: NDArray[np.uint8]
    objects: tuple[str, ...]

    @property
    def nodes(self) -> tuple[RayNode, ...]:
        """All nodes, each before its children; ``nodes[node.number]`` is the node itself."""
        return tuple(self.root.walk())

    @property
    def error(self) -> float:
        """How far the sum is from the rendered pixel, in the worst channel."""
        return float(np.abs(self.colour - self.rendered).max())

    @property
    def rounding(self) -> float:
        """How far it may be: float64's roundings of products and sum.

        A node's product takes two roundings for each depth and one for its colour, the
        rendered sum one for each node; each is at most half a unit of what is added.
        """
        unit = float(np.finfo(np.float64).eps) / 2.0
        nodes = self.nodes
        steps = 2 * max(node.depth for node in nodes) + 1 + len(nodes)
        return 2.0 * steps * unit * float(np.sum([np.abs(n.added) for n in nodes], axis=0).max())

    @property
    def adds_up(self) -> bool:
        """Whether the sum is the rendered pixel, up to rounding."""
        return self.error <= self.rounding

    @property
    def unfollowed(self) -> Array:
        """The weights of all rays that depth and threshold cut off, (3,)."""
        return np.asarray(np.sum([node.unfollowed for node in self.nodes], axis=0))

    def branch(self, *nodes: RayNode | int) -> Array:
        """What some nodes and all below them bring to the pixel, (3,)."""
        there = self._below(nodes)
        return added_up(node for node in self.nodes if node.number in there)

    def prune(self, *nodes: RayNode | int) -> Array:
        """The pixel without some nodes and all below them, (3,)."""
        gone = self._below(nodes)
        return added_up(node for node in self.nodes if node.number not in gone)

    def _below(self, nodes: tuple[RayNode | int, ...]) -> set[int]:
        """The numbers of nodes and of all below them."""
        known = self.nodes
        chosen = [node if isinstance(node, int) else node.number for node in nodes]
        for number in chosen:
            if not 0 <= number < len(known):
                raise PlaygroundError(
                    "the tree has no such node", got=number, allowed=f"0 to {len(known) - 1}"
                )
        return {below.number for number in chosen for below in known[number].walk()}

    def text(self) -> str:
        """The tree for a terminal, one ray per line, indented by depth."""
        from playground.explain.ray_words import text

        return text(self)

    def latex(self) -> str:
        """The sum over the nodes with this pixel's numbers, as LaTeX."""
        from playground.explain.ray_words import latex

        return latex(self)

    def to_dict(self) -> dict[str, Any]:
        """The tree as plain values, nodes within nodes."""
        from playground.explain.ray_words import to_dict

        return to_dict(self)

    def __str__(self) -> str:
        return self.text()


def added_up(nodes: Iterator[RayNode]) -> Array:
    """The sum of what nodes bring, (3,), rounded once: a branch taken out leaves no dust."""
    columns = zip(*(node.added for node in nodes), strict=True)
    found = [fsum(column) for column in columns]
    return np.array(found or [0.0, 0.0, 0.0])
