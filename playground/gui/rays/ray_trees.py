"""The tree of rays behind the picked pixel: traced when something has changed, then remembered."""

from __future__ import annotations

from playground.explain.ray_pixel import trace_pixel
from playground.explain.ray_tree import RayTree
from playground.gui.picture.comparison import Picture
from playground.gui.pixel.explained import Explainer, pixel_at
from playground.gui.rays.ray_view import RayView

_trees: Explainer[RayTree] = Explainer(trace_pixel)


def tree_of(picture: Picture, pixel: tuple[float, float]) -> RayTree | None:
    """The rays behind the pixel at a fraction of width and height of a traced ``picture``."""
    size = picture.box[2:]
    return _trees(picture.setup, pixel_at(pixel, size), size)


def key_of(tree: RayTree) -> object:
    """What a tree follows from: numbers of nodes mean nothing in another one."""
    return tree.setup, tree.pixel, tree.size


def gone(tree: RayTree, view: RayView) -> frozenset[int]:
    """The nodes that are cut off: those pruned, and all that grow on them."""
    found: set[int] = set()
    for node in tree.nodes:
        if node.number in view.pruned:
            found |= {below.number for below in node.walk()}
    return frozenset(found)


def deepest(tree: RayTree) -> int:
    """The depth of the deepest node."""
    return max(node.depth for node in tree.nodes)
