"""An explanation in words, in LaTeX and in plain values."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from playground.scene.settings import TERMS

if TYPE_CHECKING:
    from playground.explain.pixel import Explanation, LightAtPoint, ShadedPoint
    from playground.explain.ray_tree import RayTree
    from playground.explain.stored_pixel import StoredPixel
    from playground.scene.material import Material

CORNERS = "ABC"


def triple(values: Iterable[float], digits: int = 4) -> str:
    """Three numbers as text."""
    return "(" + ", ".join(f"{v:.{digits}f}" for v in values) + ")"


def text(why: Explanation) -> str:
    """The explanation for a terminal, one line per vector, term and light."""
    settings = why.setup.settings
    lines = [
        f"{why.setup.name}, pixel ({why.pixel[0]}, {why.pixel[1]}) "
        f"of {why.size[0]} x {why.size[1]}, {settings.shading}"
    ]
    if why.light is not None:
        kind = why.setup.scene.lights[why.light].kind
        seen = "what it emits, s_d" if why.colour.any() else "its dark back, or nothing emitted"
        lines += [f"sees light {why.light} ({kind}) itself: {seen}", *ending(why)]
        return "\n".join(lines)
    if why.object is None:
        lines += ["no surface here: the background", *ending(why)]
        return "\n".join(lines)
    lines.append(f"sees triangle {why.triangle} of object {why.object}")
    lines.append(f"needs {why.needs}")
    if settings.precision != "native":
        lines.append(f"the picture is shaded in {settings.precision}, these numbers are float64")
    if len(why.corners) == 1:
        lines += ["", *_point(why, why.corners[0]), ""]
    else:
        lines += ["", "the model is evaluated at the three vertices, their colours are mixed:", ""]
        for name, weight, corner in zip(CORNERS, why.weights, why.corners, strict=True):
            lines += [f"vertex {name}, weight {weight:.6f}", *_point(why, corner), ""]
        parts = " + ".join(
            f"{w:.4f} {triple(c.colour)}" for w, c in zip(why.weights, why.corners, strict=True)
        )
        lines.append(f"mix       {parts}")
    return "\n".join([*lines, *ending(why)])


def _point(why: Explanation, point: ShadedPoint) -> list[str]:
    lines = [
        f"  p = {triple(point.position)}",
        f"  n = {triple(point.normal)}   normal",
        f"  v = {triple(point.to_eye)}   to_eye",
    ]
    for i, light in enumerate(point.lights):
        lines += [f"  light {i} ({light.kind})", *_light(why, point, light)]
    weight = why.setup.settings.weights["emissive"]
    symbols, factors = _scaling(weight, 1.0)
    emitted = f"{symbols}m_e = {factors}{triple(_material(why).emissive)}"
    lines.append(f"  emissive  {emitted}" if weight else "  emissive  switched off")
    lines.append(f"  sum       {triple(point.colour)}")
    return lines


def _light(why: Explanation, point: ShadedPoint, light: LightAtPoint) -> list[str]:
    if light.area:
        ways = [_area_diffuse(why, point, light), _area_specular(why, light), _ambient(why, light)]
        return [f"    l = {triple(light.to_light)}   to the middle of the light", *ways]
    arriving = f"   arriving: {light.strength:.6g} of it" if light.strength != 1.0 else ""
    lines = [
        f"    l = {triple(light.to_light)}   to_light{arriving}",
        f"    r = {triple(light.reflection)}   reflection   ρ = {light.rho:.2f}°",
    ]
    if why.setup.settings.highlight == "blinn":
        lines.append(f"    h = {triple(light.halfway)}   halfway")
    return [*lines, _diffuse(why, point, light), _specular(why, light), _ambient(why, light)]


def _diffuse(why: Explanation, point: ShadedPoint, light: LightAtPoint) -> str:
    weight = why.setup.settings.weights["diffuse"]
    if weight == 0.0:
        return "    diffuse   switched off"
    symbols, factors = _scaling(weight, light.strength)
    return (
        f"    diffuse   {symbols}max(n·l, 0) s_d ⊗ m_d = {factors}{light.diffuse_factor:.4f} "
        f"{triple(light.light_diffuse)} ⊗ {triple(point.material_diffuse)} = "
        f"{triple(light.diffuse)}"
    )


def _specular(why: Explanation, light: LightAtPoint) -> str:
    weight = why.setup.settings.weights["specular"]
    if weight == 0.0:
        return "    specular  switched off"
    if light.gated:
        return f"    specular  gated: n·l = {light.n_dot_l:.4f} is not above 0"
    symbols, factors = _scaling(weight, light.strength)
    base = "n·h" if why.setup.settings.highlight == "blinn" else "r·v"
    cosine = max(light.specular_cosine, 0.0)
    return (
        f"    specular  {symbols}max({base}, 0)^{why.shininess:g} s_s ⊗ m_s = "
        f"{factors}{cosine:.4f}^{why.shininess:g} {triple(light.light_specular)} ⊗ "
        f"{triple(_material(why).specular)} = {triple(light.specular)}"
    )


def _area_diffuse(why: Explanation, point: ShadedPoint, light: LightAtPoint) -> str:
    weight = why.setup.settings.weights["diffuse"]
    if weight == 0.0:
        return "    diffuse   switched off"
    symbols, factors = _scaling(weight, 1.0)
    return (
        f"    diffuse   {symbols}F s_d ⊗ m_d = {factors}{light.diffuse_factor:.4g} "
        f"{triple(light.light_diffuse)} ⊗ {triple(point.material_diffuse)} = "
        f"{triple(light.diffuse)}   F form factor"
    )


def _area_specular(why: Explanation, light: LightAtPoint) -> str:
    weight = why.setup.settings.weights["specular"]
    if weight == 0.0:
        return "    specular  switched off"
    symbols, factors = _scaling(weight, 1.0)
    base = "n·h" if why.setup.settings.highlight == "blinn" else "r·ω"
    return (
        f"    specular  {symbols}1/π ∫ max({base}, 0)^{why.shininess:g} dω s_s ⊗ m_s = "
        f"{factors}{light.specular_factor:.4g} {triple(light.light_specular)} ⊗ "
        f"{triple(_material(why).specular)} = {triple(light.specular)}"
    )


def _ambient(why: Explanation, light: LightAtPoint) -> str:
    weight = why.setup.settings.weights["ambient"]
    if weight == 0.0:
        return "    ambient   switched off"
    symbols, factors = _scaling(weight, 1.0)
    return (
        f"    ambient   {symbols}s_a ⊗ m_a = {factors}{triple(light.light_ambient)} ⊗ "
        f"{triple(_material(why).ambient)} = {triple(light.ambient)}"
    )


def _scaling(weight: float, strength: float) -> tuple[str, str]:
    """The weight w of a term and the share a of the light that arrives: symbols, numbers."""
    scales = [("w", f"{weight:g}")] if weight != 1.0 else []
    scales += [("a", f"{strength:.4g}")] if strength != 1.0 else []
    return "".join(f"{s} · " for s, _ in scales), "".join(f"{n} · " for _, n in scales)


def _material(why: Explanation) -> Material:
    return why.setup.scene.objects[why.object or 0].material


def ending(why: Explanation | RayTree | StoredPixel) -> list[str]:
    """What the display makes of the colour, in three lines."""
    s = why.setup.settings
    steps = [f"exposed × {s.exposure:g}"] if s.exposure != 1.0 else []
    steps.append("clamped" if s.clamp else "wrapped")
    steps += ["sRGB curve"] if s.curve == "srgb" else []
    lost = " (cut at 1)" if s.clamp and max(why.colour * s.exposure) > 1.0 else ""
    return [
        f"colour    {triple(why.colour)}   linear",
        f"shown     {triple(why.shown)}   {', '.join(steps)}{lost}",
        f"code      {' '.join(str(int(code)) for code in why.codes)}",
    ]


def latex(why: Explanation) -> str:
    """The equation of the lecture as it is set, then the same with this pixel's numbers."""
    weights, lines = why.setup.settings.weights, [_formula(why)]
    for name, weight, corner in zip(CORNERS, why.weights, why.corners, strict=False):
        sums = []
        for light in corner.lights:
            if weights["diffuse"]:
                product = (
                    f"{_vector(light.light_diffuse)}\\otimes{_vector(corner.material_diffuse)}"
                )
                factors = _scaling(weights["diffuse"], light.strength)[1].replace("·", "\\cdot")
                sums.append(f"{factors}{light.diffuse_factor:.4f}\\,{product}")
            if weights["specular"] and not light.gated:
                product = (
                    f"{_vector(light.light_specular)}\\otimes{_vector(_material(why).specular)}"
                )
                factors = _scaling(weights["specular"], light.strength)[1].replace("·", "\\cdot")
                power = f"{max(light.specular_cosine, 0.0):.4f}^{{{why.shininess:g}}}"
                power = f"{light.specular_factor:.4f}" if light.area else power
                sums.append(f"{factors}{power}\\,{product}")
            if weights["ambient"]:
                sums.append(_vector(light.ambient))
        sums += [_vector(corner.emissive)] if weights["emissive"] else []
        label = f"{weight:.4f}\\,c_{name}:\\ " if len(why.corners) > 1 else ""
        lines.append(f"{label}{'+'.join(sums) or '0'}={_vector(corner.colour)}")
    lines.append(f"{_vector(why.colour)}\\to{_vector(why.shown)}")
    return " \\\\\n".join(lines)


def _formula(why: Explanation) -> str:
    """The four terms, those that are switched on."""
    base = r"n\cdot h" if why.setup.settings.highlight == "blinn" else r"r\cdot v"
    point = rf"(\max({base},0))^{{sh}}"
    area = rf"\frac{{1}}{{\pi}}\int(\max({base.replace('v', chr(92) + 'omega')},0))^{{sh}}d\omega"
    kinds = {light.area for corner in why.corners for light in corner.lights}
    lambert, lobe = ("F", area) if kinds == {True} else (r"\max(n\cdot l,0)", point)
    if len(kinds) == 2:  # both kinds of light in one scene
        lambert, lobe = rf"[{lambert}|F]", f"[{lobe}|{area}]"
    terms = {
        "diffuse": rf"{lambert}\,s_d\otimes m_d",
        "specular": rf"{lobe}\,s_s\otimes m_s",
        "ambient": r"s_a\otimes m_a",
        "emissive": "m_e",
    }
    weights = why.setup.settings.weights
    return "+".join(terms[term] for term in TERMS if weights[term]) or "0"


def _vector(values: Iterable[float]) -> str:
    return "(" + ",".join(f"{v:.3f}" for v in values) + ")"


def to_dict(why: Explanation) -> dict[str, Any]:
    """Plain values under the names of the vocabulary: ready for JSON."""
    return {
        "setup": why.setup.name,
        "pixel": list(why.pixel),
        "size": list(why.size),
        "shading": why.setup.settings.shading,
        "object": why.object,
        "light": why.light,
        "triangle": why.triangle,
        "shininess": why.shininess,
        "needs": why.needs,
        "term_weights": why.setup.settings.weights,
        "material": None if why.object is None else _material_dict(why),
        "weights": [float(w) for w in why.weights] if why.corners else [],
        "points": [_point_dict(corner) for corner in why.corners],
        "terms": _terms(why),
        "colour": plain(why.colour),
        "shown": plain(why.shown),
        "code": [int(code) for code in why.codes],
    }


def _material_dict(why: Explanation) -> dict[str, Any]:
    material = _material(why)
    return {name: list(getattr(material, name)) for name in TERMS}


def _terms(why: Explanation) -> dict[str, list[float]]:
    """The four terms of the pixel, over all lights and mixed over the vertices."""
    sums = {term: [0.0, 0.0, 0.0] for term in TERMS}
    for weight, corner in zip(why.weights, why.corners, strict=False):
        for i in range(3):
            sums["emissive"][i] += float(weight * corner.emissive[i])
            for light in corner.lights:
                for term in TERMS[:3]:
                    sums[term][i] += float(weight * getattr(light, term)[i])
    return sums


def _point_dict(point: ShadedPoint) -> dict[str, Any]:
    return {
        "position": plain(point.position),
        "normal": plain(point.normal),
        "to_eye": plain(point.to_eye),
        "material_diffuse": plain(point.material_diffuse),
        "lights": [
            {name: plain(getattr(light, name)) for name in light.__dataclass_fields__}
            for light in point.lights
        ],
        "emissive": plain(point.emissive),
        "colour": plain(point.colour),
    }


def plain(value: Any) -> Any:
    """An array as a list; everything else as it is."""
    return value.tolist() if hasattr(value, "tolist") else value
