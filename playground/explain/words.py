"""An explanation in words, in LaTeX and in plain values."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from playground.scene.settings import TERMS

if TYPE_CHECKING:
    from playground.explain.pixel import Explanation, LightAtPoint, ShadedPoint

CORNERS = "ABC"


def _triple(values: Iterable[float], digits: int = 4) -> str:
    return "(" + ", ".join(f"{v:.{digits}f}" for v in values) + ")"


def text(why: Explanation) -> str:
    """The explanation for a terminal, one line per vector, term and light."""
    settings = why.setup.settings
    lines = [
        f"{why.setup.name}, pixel ({why.pixel[0]}, {why.pixel[1]}) "
        f"of {why.size[0]} x {why.size[1]}, {settings.shading}"
    ]
    if why.object is None:
        lines += ["no surface here: the background", *_ending(why)]
        return "\n".join(lines)
    lines.append(f"sees triangle {why.triangle} of object {why.object}")
    lines.append(f"needs {why.needs}")
    if len(why.corners) == 1:
        lines += ["", *_point(why, why.corners[0]), ""]
    else:
        lines += ["", "the model is evaluated at the three vertices, their colours are mixed:", ""]
        for name, weight, corner in zip(CORNERS, why.weights, why.corners, strict=True):
            lines += [f"vertex {name}, weight {weight:.6f}", *_point(why, corner), ""]
        parts = " + ".join(
            f"{w:.4f} {_triple(c.colour)}" for w, c in zip(why.weights, why.corners, strict=True)
        )
        lines.append(f"mix       {parts}")
    return "\n".join([*lines, *_ending(why)])


def _point(why: Explanation, point: ShadedPoint) -> list[str]:
    lines = [
        f"  p = {_triple(point.position)}",
        f"  n = {_triple(point.normal)}   normal",
        f"  v = {_triple(point.to_eye)}   to_eye",
    ]
    for i, light in enumerate(point.lights):
        lines += [f"  light {i} ({light.kind})", *_light(why, point, light)]
    weight = why.setup.settings.weights["emissive"]
    lines.append(f"  emissive  {_weight(weight)}m_e = {_triple(point.emissive)}")
    lines.append(f"  sum       {_triple(point.colour)}")
    return lines


def _light(why: Explanation, point: ShadedPoint, light: LightAtPoint) -> list[str]:
    material = why.setup.scene.objects[why.object or 0].material
    weights = why.setup.settings.weights
    blinn = why.setup.settings.highlight == "blinn"
    base = "n·h" if blinn else "r·v"
    strength = f"{light.strength:.4f} · " if light.strength != 1.0 else ""
    return [
        f"    l = {_triple(light.to_light)}   to_light"
        + (f"   arriving: {light.strength:.6f} of it" if strength else ""),
        f"    r = {_triple(light.reflection)}   reflection   ρ = {light.rho:.2f}°",
        f"    diffuse   {_weight(weights['diffuse'])}{strength}max(n·l, 0) s_d ⊗ m_d = "
        f"{light.diffuse_factor:.4f} {_triple(light.light_diffuse)} ⊗ "
        f"{_triple(point.material_diffuse)} = {_triple(light.diffuse)}",
        f"    specular  {_weight(weights['specular'])}{strength}max({base}, 0)^{why.shininess:g}"
        f" s_s ⊗ m_s = "
        + ("" if blinn else f"{max(light.r_dot_v, 0.0):.4f}^{why.shininess:g} = ")
        + f"{light.specular_factor:.4g} {_triple(light.light_specular)} ⊗ "
        f"{_triple(material.specular)} = {_triple(light.specular)}",
        f"    ambient   {_weight(weights['ambient'])}s_a ⊗ m_a = "
        f"{_triple(light.light_ambient)} ⊗ {_triple(material.ambient)} = {_triple(light.ambient)}",
    ]


def _weight(weight: float) -> str:
    return "" if weight == 1.0 else f"{weight:g} · "


def _ending(why: Explanation) -> list[str]:
    s = why.setup.settings
    steps = [f"exposed × {s.exposure:g}"] if s.exposure != 1.0 else []
    steps.append("clamped" if s.clamp else "wrapped")
    steps += ["sRGB curve"] if s.curve == "srgb" else []
    lost = " (cut at 1)" if s.clamp and max(why.colour * s.exposure) > 1.0 else ""
    return [
        f"colour    {_triple(why.colour)}   linear",
        f"shown     {_triple(why.shown)}   {', '.join(steps)}{lost}",
        f"code      {' '.join(str(int(code)) for code in why.codes)}",
    ]


def latex(why: Explanation) -> str:
    """The equation of the lecture, then the same with this pixel's numbers."""
    general = (
        r"\max(n\cdot l,0)\,s_d\otimes m_d+(\max(r\cdot v,0))^{sh}\,s_s\otimes m_s"
        r"+s_a\otimes m_a+m_e"
    )
    lines = [general]
    for name, weight, corner in zip(CORNERS, why.weights, why.corners, strict=False):
        terms = [
            f"{x.diffuse_factor:.4f}\\,{_vector(x.light_diffuse)}\\otimes"
            f"{_vector(corner.material_diffuse)}"
            f"+{max(x.r_dot_v, 0):.4f}^{{{why.shininess:g}}}\\,{_vector(x.light_specular)}"
            f"\\otimes{_vector(why.setup.scene.objects[why.object or 0].material.specular)}"
            f"+{_vector(x.ambient)}"
            for x in corner.lights
        ]
        label = f"{weight:.4f}\\,c_{name}:\\ " if len(why.corners) > 1 else ""
        sums = "+".join([*terms, _vector(corner.emissive)])
        lines.append(f"{label}{sums}={_vector(corner.colour)}")
    lines.append(f"{_vector(why.colour)}\\to{_vector(why.shown)}")
    return " \\\\\n".join(lines)


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
        "triangle": why.triangle,
        "shininess": why.shininess,
        "needs": why.needs,
        "weights": [float(w) for w in why.weights] if why.corners else [],
        "points": [_point_dict(corner) for corner in why.corners],
        "terms": _terms(why),
        "colour": _plain(why.colour),
        "shown": _plain(why.shown),
        "code": [int(code) for code in why.codes],
    }


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
        "position": _plain(point.position),
        "normal": _plain(point.normal),
        "to_eye": _plain(point.to_eye),
        "lights": [
            {name: _plain(getattr(light, name)) for name in light.__dataclass_fields__}
            for light in point.lights
        ],
        "emissive": _plain(point.emissive),
        "colour": _plain(point.colour),
    }


def _plain(value: Any) -> Any:
    return value.tolist() if hasattr(value, "tolist") else value
