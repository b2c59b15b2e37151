"""Where light comes from: directional, point and spot lights.

Each light has the three colours of the lecture: s_d (``diffuse``), s_s
(``specular``) and s_a (``ambient``). Attenuation and the spot cone weaken the
diffuse and the specular term; the ambient term is light that has already been
everywhere, and keeps its strength.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from playground.errors import PlaygroundError
from playground.scene.knob import Declared, colour, number, switch, vector


@dataclass(frozen=True)
class Light(Declared):
    """What all lights share: their three colours, linear RGB."""

    label = "light"
    kind: ClassVar[str] = ""

    diffuse: tuple[float, float, float] = colour(
        1.0, 1.0, 1.0, symbol="s_d", help="light for the diffuse term"
    )
    specular: tuple[float, float, float] = colour(
        1.0, 1.0, 1.0, symbol="s_s", help="light for the specular term"
    )
    ambient: tuple[float, float, float] = colour(
        0.1, 0.1, 0.1, symbol="s_a", help="light that arrives from everywhere"
    )


@dataclass(frozen=True)
class DirectionalLight(Light):
    """A light so far away that its direction is the same everywhere (the sun)."""

    kind: ClassVar[str] = "directional"

    to_light: tuple[float, float, float] = vector(
        1.0, 2.0, 2.0, symbol="l", help="from the scene towards the light; any length but 0"
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        _refuse_zero(self.to_light, "light.to_light")


@dataclass(frozen=True)
class PointLight(Light):
    """A light that shines from one point in every direction (a bulb)."""

    kind: ClassVar[str] = "point"

    position: tuple[float, float, float] = vector(2.0, 3.0, 3.0, help="where the light stands")
    attenuate: bool = switch(False, help="weaken the light with distance")
    constant: float = number(
        1.0, 0.0, 1e6, symbol="k_c", help="attenuation 1/(k_c + k_l d + k_q d²)"
    )
    linear: float = number(0.0, 0.0, 1e6, unit="1/length", symbol="k_l", help="attenuation with d")
    quadratic: float = number(
        0.1, 0.0, 1e6, unit="1/length²", symbol="k_q", help="attenuation with d²"
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.attenuate and self.constant == self.linear == self.quadratic == 0.0:
            raise PlaygroundError(
                "light attenuation 1/(k_c + k_l d + k_q d²) divides by zero",
                got="constant = linear = quadratic = 0",
                allowed="at least one above 0",
                fix="Set constant = 1, or attenuate = false.",
            )


@dataclass(frozen=True)
class SpotLight(PointLight):
    """A point light that shines into a cone only (a stage light)."""

    kind: ClassVar[str] = "spot"

    axis: tuple[float, float, float] = vector(
        -2.0, -3.0, -3.0, help="from the light into the scene; any length but 0"
    )
    inner_angle: float = number(
        15.0, 0.0, 180.0, unit="degrees", help="half-angle of the cone with full light"
    )
    outer_angle: float = number(
        25.0, 0.0, 180.0, unit="degrees", help="half-angle beyond which there is no light"
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        _refuse_zero(self.axis, "light.axis")
        if self.inner_angle > self.outer_angle:
            raise PlaygroundError(
                "light.inner_angle must not exceed outer_angle",
                got=f"{self.inner_angle:g} > {self.outer_angle:g} degrees",
                fix="Swap them or lower inner_angle.",
            )


LIGHTS: dict[str, type[Light]] = {
    light.kind: light for light in (DirectionalLight, PointLight, SpotLight)
}


def _refuse_zero(direction: tuple[float, float, float], where: str) -> None:
    if not any(direction):
        raise PlaygroundError(
            f"{where} has no direction", got=direction, allowed="any vector but (0, 0, 0)"
        )
