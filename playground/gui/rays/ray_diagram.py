"""The ray tree as a diagram: a row for each depth, a disc for each ray, a line to its parent."""

from __future__ import annotations

from functools import lru_cache
from itertools import pairwise

from imgui_bundle import imgui

from playground.explain.ray_tree import RayNode, RayTree
from playground.gui.pixel.vector_pen import FADED
from playground.gui.rays.ray_colours import ink
from playground.shading.display import display_colour
from playground.shading.floats import Array

ROW = 2.6  # height of a depth, in heights of the text
HIGH = 15.0  # of all depths together, at most, in the same
DISC = 0.62  # radius of a disc, in the same, where there is room
LEAST = 0.16  # the same, in a crowd
LINE = 2.0
Place = tuple[float, float]


@lru_cache(maxsize=8)
def places(tree: RayTree) -> tuple[Place, ...]:
    """Where each node stands: share of the width, and its depth. Leaves stand side by side."""
    found: dict[int, float] = {}
    leaves = 0

    def settle(node: RayNode) -> float:
        nonlocal leaves
        below = [settle(child) for child in node.children]
        if not below:
            leaves += 1
            below = [leaves - 0.5]
        found[node.number] = sum(below) / len(below)
        return found[node.number]

    settle(tree.root)
    return tuple((found[node.number] / leaves, float(node.depth)) for node in tree.nodes)


def draw(
    tree: RayTree, lit: int, chosen: int, gone: frozenset[int], grown: float
) -> tuple[int, bool]:
    """The diagram at the cursor; returns the node under the mouse, −1 for none, and if clicked."""
    at, width, line = imgui.get_cursor_screen_pos(), _width(), imgui.get_font_size()
    nodes, spots = tree.nodes, places(tree)
    rows = 1 + max(node.depth for node in nodes)
    row = min(ROW, HIGH / rows) * line
    left = at.x + 1.2 * line
    wide = width - 1.2 * line
    crowd = min(_gaps(spots) or [1.0]) * wide
    radius = max(min(DISC * line, 0.42 * crowd, 0.42 * row), LEAST * line)
    imgui.invisible_button("##tree", imgui.ImVec2(width, row * rows))
    on = [imgui.ImVec2(left + x * wide, at.y + (depth + 0.5) * row) for x, depth in spots]
    hit = _under(on, radius) if imgui.is_item_hovered() else -1
    clicked = hit >= 0 and bool(imgui.is_item_clicked())
    pointed = lit if lit >= 0 else chosen
    paint, faint = imgui.get_window_draw_list(), imgui.get_color_u32(imgui.Col_.text_disabled)
    for depth in range(rows):
        if row < 0.8 * line and depth % 5:
            continue
        top = at.y + (depth + 0.5) * row - 0.5 * line
        paint.add_text(imgui.ImVec2(at.x, top), faint, f"{depth}")
    for node in nodes:
        if node.depth < grown:
            strength = _strength(node, pointed, gone)
            for child in (c for c in node.children if c.depth < grown):
                alpha = min(strength, _strength(child, pointed, gone))
                _edge(on[node.number], on[child.number], child, alpha, pointed)
    for node in nodes:
        if node.depth < grown:
            big = 1.35 if node.number == pointed else 1.0
            _disc(tree, node, on[node.number], big * radius, node.number in gone)
    return hit, clicked


def shown(tree: RayTree, colour: Array) -> tuple[float, float, float, float]:
    """A linear colour (3,) as the display of the picture shows it."""
    settings = tree.setup.settings
    codes = display_colour(colour, settings.exposure, True, settings.curve)
    red, green, blue = (float(c) for c in codes)
    return red, green, blue, 1.0


def _width() -> float:
    return max(float(imgui.get_content_region_avail().x), 1.0)


def _gaps(spots: tuple[Place, ...]) -> list[float]:
    """The distances of neighbours in a row."""
    rows: dict[float, list[float]] = {}
    for x, depth in spots:
        rows.setdefault(depth, []).append(x)
    found = []
    for row in rows.values():
        row.sort()
        found += [b - a for a, b in pairwise(row)]
    return found


def _under(on: list[imgui.ImVec2], radius: float) -> int:
    """The disc nearest to the mouse, if it is on it or very near."""
    mouse = imgui.get_io().mouse_pos
    far = [(at.x - mouse.x) ** 2 + (at.y - mouse.y) ** 2 for at in on]
    best = min(range(len(far)), key=far.__getitem__)
    return best if far[best] <= (radius + 0.4 * imgui.get_font_size()) ** 2 else -1


def _strength(node: RayNode, pointed: int, gone: frozenset[int]) -> float:
    return FADED if node.number in gone else 1.0


def _edge(a: imgui.ImVec2, b: imgui.ImVec2, child: RayNode, alpha: float, pointed: int) -> None:
    """A line in the colour of the child's kind, the thicker the more it weighs."""
    paint = imgui.get_window_draw_list()
    thick = LINE + 3.0 * min(float(child.weight.max()), 1.0)
    thick += 2.0 if child.number == pointed else 0.0
    paint.add_line(a, b, imgui.IM_COL32(0, 0, 0, round(150 * alpha)), thick + 2.0)
    paint.add_line(a, b, ink(child.kind, alpha), thick)


def _disc(tree: RayTree, node: RayNode, at: imgui.ImVec2, radius: float, gone: bool) -> None:
    """Filled with the colour at the end of the ray, with a rim in the colour of its kind."""
    paint, thick = imgui.get_window_draw_list(), max(0.28 * radius, 1.5)
    fill = imgui.get_color_u32(imgui.ImVec4(*shown(tree, node.local)))
    paint.add_circle_filled(at, radius + 1.0, imgui.IM_COL32(0, 0, 0, 255))
    paint.add_circle_filled(at, radius, fill)
    paint.add_circle(at, radius - 0.5 * thick, ink(node.kind), 0, thick)
    if gone:
        far, strong = 0.8 * radius, imgui.get_color_u32(imgui.Col_.text)
        for sign in (1.0, -1.0):
            a = imgui.ImVec2(at.x - far, at.y - sign * far)
            b = imgui.ImVec2(at.x + far, at.y + sign * far)
            paint.add_line(a, b, imgui.IM_COL32(0, 0, 0, 255), 4.0)
            paint.add_line(a, b, strong, 2.0)
