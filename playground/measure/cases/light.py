"""Cases of single lights: attenuation with distance, the cone of a spot light, polygons."""

from __future__ import annotations

from math import pi
from typing import Any

from playground.shading.light import cone

Outputs = dict[str, Any]


def attenuation(inputs: Outputs, formulas: Any) -> Outputs:
    """1 / (k_c + k_l d + k_q d²), the distance and the direction to the light."""
    direction, distance = formulas.light.toward(inputs["P"], inputs["light"])
    factor = formulas.light.attenuation(distance, inputs["kc"], inputs["kl"], inputs["kq"])
    return {"distance": distance, "attenuation": factor, "direction": direction}


def spot_cone(inputs: Outputs, formulas: Any) -> Outputs:
    """The smooth edge of a cone; its two constants come from the CPU, once per light."""
    unit = formulas.vector.unit
    edge, width = cone(inputs["inner"], inputs["outer"])
    falloff = formulas.light.spot_cone(unit(inputs["axis"]), unit(inputs["to_point"]), edge, width)
    return {"falloff": falloff}


def polygon_form_factor(inputs: Outputs, formulas: Any) -> Outputs:
    """Lambert's formula for a polygon that shines, cut at the horizon of the surface."""
    normal = formulas.vector.unit(inputs["N"])
    factor = formulas.area_light.form_factor(
        inputs["P"], normal, inputs["polygon"], inputs.get("two_sided", False)
    )
    return {"form_factor": factor}


def phong_lobe_polygon(inputs: Outputs, formulas: Any) -> Outputs:
    """The Phong lobe over a polygon above the surface, also as a share of the whole lobe."""
    unit, exponent = formulas.vector.unit, inputs["exponent"]
    moment = formulas.area_light.lobe_integral_above(
        inputs["P"], unit(inputs["N"]), unit(inputs["axis"]), inputs["polygon"], exponent, True
    )
    return {"moment": moment, "normalised": (exponent + 1.0) / (2.0 * pi) * moment}
