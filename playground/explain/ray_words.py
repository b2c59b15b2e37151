"""A tree of rays in words, in LaTeX and in plain values."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from playground.explain.ray_tree import BLOCKED
from playground.explain.words import ending, plain, triple

if TYPE_CHECKING:
    from playground.explain.ray_tree import LightThere, RayNode, RayTree, ShadowRay


def text(tree: RayTree) -> str:
    """The tree for a terminal: each ray with what it met, indented below the one that sent it."""
    settings, nodes = tree.setup.settings, tree.nodes
    shadows = sum(len(light.rays) for node in nodes for light in node.lights)
    lines = [
        f"{tree.setup.name}, pixel ({tree.pixel[0]}, {tree.pixel[1]}) "
        f"of {tree.size[0]} x {tree.size[1]}, ray tracing to depth {settings.depth}",
        f"{_counted(len(nodes), 'ray')}, {_counted(shadows, 'shadow ray')}",
    ]
    if settings.samples > 1:
        lines.append(
            f"the picture mixes {settings.samples} rays per pixel; this one goes through its middle"
        )
    lines += ["", *_branch(tree, tree.root, "", ""), "", *sums(tree), *ending(tree)]
    return "\n".join(lines)


def sums(tree: RayTree) -> list[str]:
    """That the weights multiply out to the pixel, and what was cut off."""
    word = "which is" if tree.adds_up else "which is NOT"
    lines = [
        f"sum       {triple(tree.colour)}   of weight ⊗ local over all rays, {word} the rendered "
        f"pixel: off by {tree.error:.1g}, rounding allows {tree.rounding:.1g}"
    ]
    if np.any(tree.unfollowed):
        lines.append(f"left out  {triple(tree.unfollowed)}   weight of the rays not followed")
    return lines


def _counted(count: int, name: str) -> str:
    return f"{count} {name}{'' if count == 1 else 's'}"


def _branch(tree: RayTree, node: RayNode, first: str, rest: str) -> Iterator[str]:
    """The lines of a node and all below it; the first and the others begin with these."""
    where = "leaves the scene" if node.end is None else f"meets {node.name} at {triple(node.end)}"
    yield f"{first}[{node.number}] {node.kind}, depth {node.depth}: {where}"
    below = rest + ("│   " if node.children else "    ")
    for line in (*weighed(node), *boundary(tree, node), *_local(tree, node)):
        yield below + line
    for child in node.children:
        last = child is node.children[-1]
        yield from _branch(
            tree, child, rest + ("└── " if last else "├── "), rest + ("    " if last else "│   ")
        )


def weighed(node: RayNode) -> list[str]:
    """How the weight of a ray came about."""
    if node.depth == 0 and np.all(node.faded == 1.0):
        return [f"weight    {triple(node.weight)}"]
    faded = "" if np.all(node.faded == 1.0) else f", ⊗ {triple(node.faded)} left by the medium"
    sent = "" if node.depth == 0 else f" = that of its parent ⊗ {triple(node.factor)}"
    return [f"weight    {triple(node.weight)}{sent}{faded}"]


def boundary(tree: RayTree, node: RayNode) -> list[str]:
    """The angles at the end of a ray and Fresnel's share, in a line; none where it leaves."""
    if node.incidence is None:
        return []
    if node.fresnel is None:
        return [f"angle     θ_i = {node.incidence:.2f}°"]
    way = f"θ_i = {node.incidence:.2f}°, index {node.index_i:g} → {node.index_t:g}"
    limit = "" if node.critical is None else f", critical angle {node.critical:.2f}°"
    if node.refraction is None:
        return [f"boundary  {way}{limit}: total internal reflection, F = 1"]
    schlick = " (Schlick)" if tree.setup.settings.fresnel == "schlick" else ""
    return [
        f"boundary  {way}, θ_t = {node.refraction:.2f}°{limit}; "
        f"F = {node.fresnel:.6f}{schlick} is reflected"
    ]


def _local(tree: RayTree, node: RayNode) -> Iterator[str]:
    for light in node.lights:
        yield from _light(tree, light)
    parts = ""
    if node.glow is not None and node.lights:
        parts = f" = {triple(node.glow)} without light + what arrives"
    if np.any(node.local):
        yield f"local     {triple(node.local)}{parts}"
    yield f"brings    {triple(node.added)}"


def _light(tree: RayTree, light: LightThere) -> Iterator[str]:
    name = f"light {light.light} ({light.kind})"
    if not light.rays:
        yield f"shadow    {name}: no ray, it adds nothing here"
    elif len(light.rays) == 1:
        yield f"shadow    {name}: {shadow_words(tree, light.rays[0])}; adds {triple(light.added)}"
    else:
        stopped = [ray for ray in light.rays if ray.kind == BLOCKED]
        by = ", ".join(sorted({_called(tree, ray.blocker) for ray in stopped}))
        come = f"{len(light.rays) - len(stopped)} of {len(light.rays)} shadow rays arrive"
        why = f", the others blocked by {by}" if stopped else ""
        yield f"shadow    {name}: {come}{why}; adds {triple(light.added)}"


def shadow_words(tree: RayTree, ray: ShadowRay) -> str:
    """Whether a shadow ray arrives, through what, or what blocks it."""
    if ray.kind == BLOCKED:
        return f"blocked by {_called(tree, ray.blocker)}"
    if not ray.through:
        return "arrives"
    through = ", ".join(_called(tree, number) for number in ray.through)
    return f"arrives through {through}, {triple(ray.share)} of it"


def _called(tree: RayTree, number: int | None) -> str:
    return "the face of a light" if number is None else tree.objects[number]


def latex(tree: RayTree) -> str:
    """The recursion as it is written, its sum, then what each ray brings to this pixel."""
    lines = [
        r"c=c_{local}+(k_r+k_t F)\otimes c_{reflected}+k_t(1-F)\otimes c_{refracted}",
        r"c=\sum_i w_i\otimes c_i",
    ]
    for node in tree.nodes:
        product = f"{_vector(node.weight)}\\otimes{_vector(node.local)}"
        lines.append(
            f"w_{{{node.number}}}\\otimes c_{{{node.number}}}={product}={_vector(node.added)}"
            f"\\quad\\text{{{node.kind}, {node.name}}}"
        )
    lines.append(f"c={_vector(tree.colour)}\\to{_vector(tree.shown)}")
    return " \\\\\n".join(lines)


def _vector(values: Any) -> str:
    return "(" + ",".join(f"{v:.4f}" for v in values) + ")"


def to_dict(tree: RayTree) -> dict[str, Any]:
    """Plain values: ready for JSON; the tree is in ``root``, nodes within nodes."""
    return {
        "setup": tree.setup.name,
        "method": "ray-tracing",
        "pixel": list(tree.pixel),
        "size": list(tree.size),
        "depth": tree.setup.settings.depth,
        "fresnel": tree.setup.settings.fresnel,
        "objects": list(tree.objects),
        "rays": len(tree.nodes),
        "root": _node(tree.root),
        "colour": plain(tree.colour),
        "rendered": plain(tree.rendered),
        "error": tree.error,
        "rounding": tree.rounding,
        "adds_up": tree.adds_up,
        "unfollowed": plain(tree.unfollowed),
        "shown": plain(tree.shown),
        "code": [int(code) for code in tree.codes],
    }


def _node(node: RayNode) -> dict[str, Any]:
    values = {name: plain(getattr(node, name)) for name in node.__dataclass_fields__}
    values["length"] = None if node.end is None else node.length
    values["lights"] = [_light_dict(light) for light in node.lights]
    values["children"] = [_node(child) for child in node.children]
    return values


def _light_dict(light: LightThere) -> dict[str, Any]:
    values = {name: plain(getattr(light, name)) for name in light.__dataclass_fields__}
    values["added"] = plain(light.added)
    values["rays"] = [
        {name: plain(getattr(ray, name)) for name in ray.__dataclass_fields__} for ray in light.rays
    ]
    return values
