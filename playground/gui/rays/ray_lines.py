"""The rays of a tree as lines in the world: pure values, nothing of the screen."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from playground.explain.ray_tree import BLOCKED, RayNode, RayTree
from playground.gui.picture.gizmo_math import Array

HALF = 0.5  # of a bounce
BEYOND = 1.5  # radii of the scene: so far a ray is drawn that meets nothing
MANY = 24  # shadow rays: of more, only those of the first hit and of the chosen one are drawn


@dataclass(frozen=True, eq=False)
class RayLine:
    """One ray, from ``start`` to ``end`` (3,); a shadow ray belongs to the ``node`` it starts from.

    It begins to grow when the animation has reached ``since`` bounces, and takes half a bounce.
    ``words`` stand at its end.
    """

    node: int
    kind: str
    start: Array
    end: Array
    since: float
    shadow: bool = False
    words: str = ""

    def grown(self, bounces: float) -> float:
        """How much of it is drawn, from 0 to 1."""
        return min(max((bounces - self.since) / HALF, 0.0), 1.0)

    def tip(self, share: float) -> Array:
        """The end of what is drawn."""
        return np.asarray(self.start + share * (self.end - self.start))


def lines(tree: RayTree, radius: float, chosen: int) -> Iterator[RayLine]:
    """Every ray, then the shadow rays, in a scene of this ``radius``.

    Shadow rays start where their node ends, so they grow in the second half of its bounce.
    """
    nodes = tree.nodes
    for node in nodes:
        end = node.start + BEYOND * radius * node.direction if node.end is None else node.end
        yield RayLine(node.number, node.kind, node.start, end, float(node.depth))
    few = sum(len(light.rays) for node in nodes for light in node.lights) <= MANY
    for node in nodes:
        if few or node.number in (0, chosen):
            yield from _shadows(tree, node, node.number in (0, chosen))


def _shadows(tree: RayTree, node: RayNode, told: bool) -> Iterator[RayLine]:
    """The shadow rays of one hit; of several to one light, one says what blocks it."""
    for light in node.lights:
        blockers: set[int | None] = set()
        for ray in light.rays:
            words = ""
            if told and ray.kind == BLOCKED and ray.blocker not in blockers:
                blockers.add(ray.blocker)
                words = f"blocked by {named(tree, ray.blocker)}"
            since = node.depth + HALF
            yield RayLine(node.number, ray.kind, ray.start, ray.end, since, True, words)


def named(tree: RayTree, number: int | None) -> str:
    """What an object is called; what is no object is the face of a light."""
    return "a light" if number is None else tree.objects[number]
