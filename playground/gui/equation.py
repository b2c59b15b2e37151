"""The Phong equation with the numbers of a point: what is said, and how it is set.

What is said is a pure function: parts of text and symbols. A part that is the symbol of
a vector becomes a plate in the colour of its arrow, which answers to the mouse.
"""

from __future__ import annotations

from collections.abc import Iterable

from imgui_bundle import imgui

from playground.explain.pixel import Explanation, LightAtPoint, ShadedPoint
from playground.gui import vector_pen as pen
from playground.gui.typeset import typeset

Parts = tuple[str, ...]


def triple(values: Iterable[float]) -> str:
    """Three numbers as briefly as they can be told."""
    return "(" + ", ".join(f"{round(float(v), 3):g}" for v in values) + ")"


def formula(term: str, why: Explanation) -> Parts:
    """A term of the equation in symbols."""
    a, b = "nh" if why.setup.settings.highlight == "blinn" else "rv"
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
        factors.append(f"{cosine:.3f}^{why.shininess:g} ·")
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


def write(parts: Iterable[str], lit: str, faint: bool = False, indent: float = 0.0) -> str:
    """Set the parts in a line, or more where it is too long; returns the symbol under the mouse."""
    size, style = imgui.get_font_size(), imgui.get_style()
    start, hit = imgui.get_cursor_screen_pos(), ""
    left, right = start.x + indent, start.x + imgui.get_content_region_avail().x
    x, y, step = left, start.y, 1.45 * size
    mouse = imgui.get_io().mouse_pos
    colour = imgui.get_color_u32(imgui.Col_.text_disabled if faint else imgui.Col_.text)
    for part in parts:
        symbol = part in pen.COLOURS
        at = imgui.ImVec2(x, y)
        width = pen.plate_width(part) if symbol else typeset(part, at, size, 0, paint=False)
        if x + width > right and x > left:
            x, y = left, y + step
            at = imgui.ImVec2(x, y)
        if symbol:
            pen.plate((x, y - 0.1 * size), part, lit)
            inside = x <= mouse.x <= x + width and y <= mouse.y <= y + 1.2 * size
            hit = part if inside else hit
        else:
            typeset(part, at, size, colour)
        x += width + 0.2 * size
    imgui.dummy(imgui.ImVec2(right - start.x, y + step - start.y - style.item_spacing.y))
    hit = hit if imgui.is_item_hovered() else ""
    if hit:
        imgui.set_tooltip(pen.NAMES[hit])
    return hit
