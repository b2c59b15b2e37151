"""The Phong equation with the numbers of a point: what is said, and how it is set.

What is said is a pure function: parts of text and symbols. A part that is the symbol of
a vector becomes a plate in the colour of its arrow, which answers to the mouse.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache
from typing import NamedTuple

from imgui_bundle import imgui

from playground.explain.pixel import Explanation, LightAtPoint, ShadedPoint
from playground.gui.pixel import vector_pen as pen
from playground.gui.widget.typeset import runs, typeset

Parts = tuple[str, ...]


def triple(values: Iterable[float]) -> str:
    """Three numbers as briefly as they can be told."""
    return "(" + ", ".join(f"{round(float(v), 3):g}" for v in values) + ")"


def formula(term: str, why: Explanation, area: bool = False) -> Parts:
    """A term of the equation in symbols; for an area light with its form factor and integral.

    The integral of Blinn's lobe has no closed form: it is that of another lobe, fitted to it.
    """
    blinn = why.setup.settings.highlight == "blinn"
    if area and term == "diffuse":
        return ("F", "s_d ⊗ m_d", "   F: form factor")
    if area and term == "specular" and blinn:
        return ("≈ 1/π ∫ max(", "n", "·", "h", ", 0)^sh dω", "s_s ⊗ m_s", "   by a fitted lobe")
    if area and term == "specular":
        return ("1/π ∫ max(", "r", "·ω, 0)^sh dω", "s_s ⊗ m_s")
    a, b = "nh" if blinn else "rv"
    return {
        "diffuse": ("max(", "n", "·", "l", ", 0)", "s_d ⊗ m_d"),
        "specular": ("max(", a, "·", b, ", 0)^sh", "s_s ⊗ m_s"),
        "ambient": ("s_a ⊗ m_a",),
        "emissive": ("m_e",),
    }[term]


def numbers(term: str, why: Explanation, point: ShadedPoint, light: LightAtPoint) -> Parts:
    """The same with the numbers of this point; why there is nothing where there is nothing."""
    weight = why.setup.settings.weights[term]
    if weight == 0.0:
        return ("switched off",)
    if term == "specular" and light.gated:
        return (f"gated: n·l = {light.n_dot_l:.3f} is not above 0",)
    factors = [f"{weight:g} ·"] if weight != 1.0 else []
    if term != "ambient" and light.strength != 1.0:
        factors.append(f"{light.strength:.3g} ·")
    s, m = filtered(term, why, point, light)
    if term == "diffuse":
        factors.append(f"{light.diffuse_factor:.3f} ·")
    elif term == "specular":
        cosine = max(light.specular_cosine, 0.0)
        power = f"{cosine:.3f}^{why.shininess:g}"
        factors.append(f"{light.specular_factor:.3g} ·" if light.area else f"{power} ·")
    return (*factors, f"{triple(s)} ⊗", triple(m))


def filtered(
    term: str, why: Explanation, point: ShadedPoint, light: LightAtPoint
) -> tuple[list[float], list[float]]:
    """The colours of light and material whose product a term filters: s and m."""
    material = why.setup.scene.objects[why.object or 0].material
    pairs: dict[str, tuple[Iterable[float], Iterable[float]]] = {
        "diffuse": (light.light_diffuse, point.material_diffuse),
        "specular": (light.light_specular, material.specular),
        "ambient": (light.light_ambient, material.ambient),
    }
    s, m = pairs[term]
    return [float(x) for x in s], [float(x) for x in m]


class Place(NamedTuple):
    """A part of a line: where it stands from the start of the line, and how wide it is."""

    part: str
    right: float
    down: float
    width: float


def write(parts: Parts, lit: str, faint: bool = False, indent: float = 0.0) -> str:
    """Set the parts in a line, or more where it is too long; returns the symbol under the mouse."""
    start, wide = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail().x
    size = imgui.get_font_size()
    places, height = laid_out(parts, wide - indent, size)
    room = imgui.ImVec2(wide, height - imgui.get_style().item_spacing.y)
    left, top = start.x + indent, start.y - 0.1 * size  # of the plates
    if imgui.is_rect_visible(
        imgui.ImVec2(start.x, top), imgui.ImVec2(start.x + wide, top + height)
    ):
        colour = imgui.get_color_u32(imgui.Col_.text_disabled if faint else imgui.Col_.text)
        for part, right, down, _ in places:
            if part in pen.COLOURS:
                pen.plate((left + right, top + down), part, lit)
            else:
                typeset(part, imgui.ImVec2(left + right, start.y + down), size, colour)
    imgui.dummy(room)
    if not imgui.is_item_hovered():
        return ""
    mouse = imgui.get_io().mouse_pos
    hit = _symbol_at(places, mouse.x - left, mouse.y - start.y, 1.2 * size)
    if hit:
        imgui.set_tooltip(pen.NAMES[hit])
    return hit


@lru_cache(maxsize=256)
def laid_out(parts: Parts, room: float, size: float) -> tuple[tuple[Place, ...], float]:
    """Where the parts stand, and the height of it all; once per parts, width and size of text."""
    x, y, step = 0.0, 0.0, 1.45 * size
    made = []
    for part in parts:
        width = pen.plate_width(part) if part in pen.COLOURS else runs(part, size)[1]
        if x + width > room and x > 0.0:
            x, y = 0.0, y + step
        made.append(Place(part, x, y, width))
        x += width + 0.2 * size
    return tuple(made), y + step


def _symbol_at(places: tuple[Place, ...], x: float, y: float, high: float) -> str:
    """The symbol at a point of the line, or nothing."""
    for part, right, down, width in places:
        inside = right <= x <= right + width and down <= y <= down + high
        if inside and part in pen.COLOURS:
            return part
    return ""
