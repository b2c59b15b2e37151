"""Cases of local shading: the power, the lobe, the reflection, the whole Phong sum."""

from __future__ import annotations

from typing import Any

import numpy as np

from playground.measure.cases.place import eye_space
from playground.shading import phong

Outputs = dict[str, Any]


def phong_pow(inputs: Outputs, formulas: Any) -> Outputs:
    """max(x, 0)^sh."""
    return {"value": formulas.power.power(inputs["x"], inputs["sh"])}


def phong_lobe(inputs: Outputs, formulas: Any) -> Outputs:
    """max(r·v, 0)^sh of directions of any length."""
    unit = formulas.vector.unit
    return {"value": formulas.power.lobe(unit(inputs["r"]), unit(inputs["v"]), inputs["sh"])}


def reflect(inputs: Outputs, formulas: Any) -> Outputs:
    """The reflection vector of directions of any length."""
    unit = formulas.vector.unit
    return {"r": formulas.vector.reflection(unit(inputs["n"]), unit(inputs["l"]))}


def phong_shade(inputs: Outputs, formulas: Any) -> Outputs:
    """The four terms and their sum at one point, with the specular term gated and not."""
    unit, light, material = formulas.vector.unit, inputs["light"], inputs["material"]
    point = light["type"] == "point"
    places = [inputs["P"], light["position"]] if point else [inputs["P"]]
    position, *lamps = eye_space(inputs["eye"], places, formulas.real)
    normal, to_eye = unit(inputs["N"]), unit(-position)
    to_light = formulas.light.toward(position, lamps[0])[0] if point else unit(light["to_light"])

    product = formulas.phong.component_filter
    factor = formulas.phong.specular_factor(normal, to_light, to_eye, material["shininess"])
    gated = factor * formulas.phong.gate(normal, to_light)
    specular = product(light["specular"], material["specular"])
    terms = {
        "diffuse": formulas.phong.diffuse_term(
            formulas.phong.diffuse_factor(normal, to_light),
            product(light["diffuse"], material["diffuse"]),
        ),
        "specular": formulas.phong.specular_term(gated, specular),
        "specular_ungated": formulas.phong.specular_term(factor, specular),
        # The same at every point of a surface: computed once, on the CPU, and rounded.
        "ambient": formulas.real(phong.ambient_term(light["ambient"], material["ambient"])),
        "emissive": formulas.real(phong.emissive_term(material["emissive"])),
    }
    constant = (terms["ambient"], terms["emissive"])
    return {
        **terms,
        "total": formulas.real(phong.weighted_sum(terms["diffuse"], terms["specular"], *constant)),
        "total_ungated": formulas.real(
            phong.weighted_sum(terms["diffuse"], terms["specular_ungated"], *constant)
        ),
    }


def pervertex_vs_fragment(inputs: Outputs, formulas: Any) -> Outputs:
    """Gouraud: interpolate what the vertices got. Phong: interpolate, then shade."""
    *corners, lamp = eye_space(
        inputs["eye"], [*inputs["positions"], inputs["light"]], formulas.real
    )
    positions = np.array(corners)
    normals = np.asarray(inputs["normals"], formulas.real)
    weights = np.asarray(inputs["weights"], formulas.real)

    def shade(position: Any, normal: Any) -> tuple[Any, Any]:
        unit = formulas.vector.unit
        normal, to_eye = unit(normal), unit(-position)
        to_light = formulas.light.toward(position, lamp)[0]
        factor = formulas.phong.specular_factor(normal, to_light, to_eye, inputs["sh"])
        gated = factor * formulas.phong.gate(normal, to_light)
        return formulas.phong.diffuse_factor(normal, to_light), gated

    diffuse, specular = shade(positions, normals)
    fragment = shade(weights @ positions, weights @ normals)
    return {
        "pervertex_diffuse": weights @ diffuse,
        "pervertex_specular": weights @ specular,
        "perfragment_diffuse": fragment[0],
        "perfragment_specular": fragment[1],
    }
