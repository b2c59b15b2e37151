"""What a surface does with light: m_d, m_s, m_a, m_e and the shininess of the lecture."""

from __future__ import annotations

from dataclasses import dataclass

from playground.scene.knob import Declared, choice, colour, number, text


@dataclass(frozen=True)
class Material(Declared):
    """The four colours of the Phong model and its exponent.

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
