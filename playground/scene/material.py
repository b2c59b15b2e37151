"""What a surface does with light: m_d, m_s, m_a, m_e and the shininess of the lecture.

For ray tracing also what it mirrors and lets through; other methods leave that alone.
"""

from __future__ import annotations

from dataclasses import dataclass

from playground.errors import PlaygroundError
from playground.scene.knob import Declared, choice, colour, integer, number, text

ROUNDING = 1e-9  # a sum of two shares that was written with nine digits may exceed 1 by this


@dataclass(frozen=True)
class Material(Declared):
    """The four colours of the Phong model and its exponent; mirrors and glass for ray tracing.

    Where ``transmittance`` is not 0 the surface is a boundary of a medium with this refractive
    ``index``: Fresnel's equations divide the transmittance between reflection and refraction.
    Colours are linear RGB. ``texture`` names an image whose texels take the place
    of ``diffuse`` (multiplied by it: white leaves the image as it is).
    """

    label = "material"

    diffuse: tuple[float, float, float] = colour(
        0.7, 0.7, 0.7, symbol="m_d", help="share of red, green and blue that is scattered evenly"
    )
    specular: tuple[float, float, float] = colour(
        0.5, 0.5, 0.5, symbol="m_s", help="colour of the highlight; usually grey"
    )
    ambient: tuple[float, float, float] = colour(
        0.7, 0.7, 0.7, symbol="m_a", help="share of the ambient light that is scattered"
    )
    emissive: tuple[float, float, float] = colour(
        0.0, 0.0, 0.0, symbol="m_e", help="light that the surface sends out by itself"
    )
    shininess: float = number(
        20.0,
        0.0,
        1e6,
        scale="log",
        symbol="sh",
        help="exponent of the highlight: larger is sharper",
    )
    texture: str = text(help="image file that gives m_d at every point; empty for none")
    texture_encoding: str = choice(
        "linear",
        ("linear", "srgb"),
        help="how the image stores its numbers: as they are, or with the sRGB curve",
    )
    reflectance: tuple[float, float, float] = colour(
        0.0, 0.0, 0.0, symbol="k_r", help="ray tracing: share that a mirror reflects"
    )
    transmittance: tuple[float, float, float] = colour(
        0.0, 0.0, 0.0, symbol="k_t", help="ray tracing: share that glass lets in, less Fresnel's"
    )
    index: float = number(
        1.5, 0.01, 100.0, scale="log", help="ray tracing: refractive index; air 1, glass 1.5"
    )
    absorption: tuple[float, float, float] = colour(
        0.0,
        0.0,
        0.0,
        unit="1/length",
        help="ray tracing: inside, light fades as e^(-absorption · way)",
    )
    priority: int = integer(
        0, -100, 100, help="ray tracing: where solids of glass overlap, the higher one is there"
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        shares = zip(("red", "green", "blue"), self.reflectance, self.transmittance, strict=True)
        for channel, mirrored, through in shares:
            if mirrored + through > 1.0 + ROUNDING:
                raise PlaygroundError(
                    f"material.reflectance + transmittance would create light in {channel}",
                    got=f"{mirrored:g} + {through:g} = {mirrored + through:g}",
                    allowed="a sum of at most 1 in each channel",
                    fix=f"Lower one of them: {channel} of the transmittance to "
                    f"{max(1.0 - mirrored, 0.0):g} or less."
                    if mirrored <= 1.0
                    else f"Lower {channel} of the reflectance to 1 or less.",
                )
