"""What is said of one ray of a tree: kind, object, angles, Fresnel's share, weight, colour."""

from __future__ import annotations

from collections.abc import Iterable

from playground.explain.ray_tree import ARRIVING, BLOCKED, RayNode, RayTree
from playground.gui.rays.ray_lines import named
from playground.shading.floats import Array

SHORT = {"total internal reflection": "total reflection"}
DUST = 5e-7  # smaller numbers are written as 0: they change no code of the picture


def numbers(values: Array) -> str:
    """Three numbers, with three digits; one where all are the same."""
    texts = [f"{v:.3g}" if abs(v) > DUST else "0" for v in values.tolist()]
    return texts[0] if len(set(texts)) == 1 else f"({', '.join(texts)})"


def lines(node: RayNode) -> tuple[str, ...]:
    """One line for a list: depth, kind, object, angles, Fresnel's share; then ever shorter ones.

    What goes first is what the others name too: the mesh, Fresnel's share, the angle beyond.
    """
    kind, where = SHORT.get(node.kind, node.kind), node.name.removeprefix("object ")
    angle = f"  {node.incidence:.1f}°" if node.incidence is not None else ""
    beyond = f" → {node.refraction:.1f}°" if node.refraction is not None else ""
    share = f"  F {node.fresnel:.2f}" if node.fresnel is not None else ""
    named, number = f"{node.depth} {kind}, {where}", f"{node.depth} {kind}, {where.split(' (')[0]}"
    every = (named + angle + beyond + share, number + angle + beyond + share)
    return tuple(dict.fromkeys((*every, number + angle + beyond, number + angle, number)))


def told(tree: RayTree, node: RayNode) -> Iterable[str]:
    """Everything about a node, line by line."""
    yield f"{node.kind}, depth {node.depth}: meets {node.name}"
    yield _angles(node)
    yield _boundary(node)
    faded = "" if bool((node.faded == 1.0).all()) else f" · {numbers(node.faded)} faded"
    parent = "" if node.depth == 0 else f" = parent's · {numbers(node.factor)}{faded}"
    yield f"weight {numbers(node.weight)}{parent}"
    yield f"brings weight ⊗ {numbers(node.local)} = {numbers(node.added)}"
    yield f"with its branch {numbers(tree.branch(node))}"
    yield _lights(tree, node)
    cut = bool(node.unfollowed.any())
    yield f"rays cut off here weigh {numbers(node.unfollowed)}" if cut else ""


def _angles(node: RayNode) -> str:
    if node.incidence is None:
        return "leaves the scene"
    words = f"{node.incidence:.2f}° to the normal"
    if node.fresnel is None:
        return words
    if node.refraction is None:
        return f"{words}: total internal reflection beyond {node.critical or 0.0:.2f}°"
    edge = f", critical {node.critical:.2f}°" if node.critical is not None else ""
    return f"{words}, {node.refraction:.2f}° beyond{edge}"


def _boundary(node: RayNode) -> str:
    if node.fresnel is None:
        return ""
    return f"Fresnel reflects {node.fresnel:.4f} from n {node.index_i:g} to {node.index_t:g}"


def _lights(tree: RayTree, node: RayNode) -> str:
    """How the shadow rays of each light fare."""
    parts = []
    for light in node.lights:
        if not light.rays:
            parts.append(f"light {light.light} is behind")
            continue
        blockers = [ray.blocker for ray in light.rays if ray.kind == BLOCKED]
        arriving = sum(ray.kind == ARRIVING for ray in light.rays)
        names = ", ".join(dict.fromkeys(named(tree, blocker) for blocker in blockers))
        if not blockers:
            parts.append(f"light {light.light} arrives")
        elif arriving:
            parts.append(
                f"light {light.light}: {arriving} of {len(light.rays)} rays arrive, "
                f"the others are blocked by {names}"
            )
        else:
            parts.append(f"light {light.light} is blocked by {names}")
    return "; ".join(parts)
