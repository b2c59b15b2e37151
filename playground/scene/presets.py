"""Well known materials: the table of ``teapots.c`` (Silicon Graphics, 1994), mirrors and glass.

That program draws 24 teapots and is printed in the OpenGL Programming Guide; its numbers
have been copied from book to book since. There the exponent is 128 times the last column.
"""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

from playground.errors import unknown_name
from playground.scene.material import Material

Rgb = tuple[float, float, float]
PLAIN = Material()
BLACK: Rgb = (0.0, 0.0, 0.0)
WHITE: Rgb = (1.0, 1.0, 1.0)
HIGHLIGHT: Rgb = (0.6, 0.6, 0.6)
LARGEST = 128.0  # the exponent that OpenGL allows

_TABLE: dict[str, tuple[Rgb, Rgb, Rgb, float]] = {  # ambient, diffuse, specular, shininess
    "gold": (
        (0.24725, 0.1995, 0.0745),
        (0.75164, 0.60648, 0.22648),
        (0.628281, 0.555802, 0.366065),
        0.4,
    ),
    "silver": (
        (0.19225, 0.19225, 0.19225),
        (0.50754, 0.50754, 0.50754),
        (0.508273, 0.508273, 0.508273),
        0.4,
    ),
    "copper": (
        (0.19125, 0.0735, 0.0225),
        (0.7038, 0.27048, 0.0828),
        (0.256777, 0.137622, 0.086014),
        0.1,
    ),
    "brass": (
        (0.329412, 0.223529, 0.027451),
        (0.780392, 0.568627, 0.113725),
        (0.992157, 0.941176, 0.807843),
        0.21794872,
    ),
    "chrome": ((0.25, 0.25, 0.25), (0.4, 0.4, 0.4), (0.774597, 0.774597, 0.774597), 0.6),
    "emerald": (
        (0.0215, 0.1745, 0.0215),
        (0.07568, 0.61424, 0.07568),
        (0.633, 0.727811, 0.633),
        0.6,
    ),
    "jade": ((0.135, 0.2225, 0.1575), (0.54, 0.89, 0.63), (0.316228, 0.316228, 0.316228), 0.1),
    "ruby": (
        (0.1745, 0.01175, 0.01175),
        (0.61424, 0.04136, 0.04136),
        (0.727811, 0.626959, 0.626959),
        0.6,
    ),
    "pearl": ((0.25, 0.20725, 0.20725), (1.0, 0.829, 0.829), (0.296648, 0.296648, 0.296648), 0.088),
    "obsidian": (
        (0.05375, 0.05, 0.06625),
        (0.18275, 0.17, 0.22525),
        (0.332741, 0.328634, 0.346435),
        0.3,
    ),
    "red plastic": ((0.0, 0.0, 0.0), (0.5, 0.0, 0.0), (0.7, 0.6, 0.6), 0.25),
    "green plastic": ((0.0, 0.0, 0.0), (0.1, 0.35, 0.1), (0.45, 0.55, 0.45), 0.25),
    "white plastic": ((0.0, 0.0, 0.0), (0.55, 0.55, 0.55), (0.7, 0.7, 0.7), 0.25),
    "black plastic": ((0.0, 0.0, 0.0), (0.01, 0.01, 0.01), (0.5, 0.5, 0.5), 0.25),
    "red rubber": ((0.05, 0.0, 0.0), (0.5, 0.4, 0.4), (0.7, 0.04, 0.04), 0.078125),
    "black rubber": ((0.02, 0.02, 0.02), (0.01, 0.01, 0.01), (0.4, 0.4, 0.4), 0.078125),
}

# For ray tracing. Highlights stand for the mirror image of a lamp, which a ray cannot hit.
_TRACED: dict[str, Material] = {
    "mirror": Material(BLACK, HIGHLIGHT, BLACK, shininess=300.0, reflectance=(0.9, 0.9, 0.9)),
    # Gold at normal incidence, linear RGB: Hoffman, Physics and Math of Shading, SIGGRAPH 2015.
    "gold mirror": Material(
        BLACK, HIGHLIGHT, BLACK, shininess=300.0, reflectance=(1.0, 0.78, 0.34)
    ),
    "glass": Material(BLACK, HIGHLIGHT, BLACK, shininess=300.0, transmittance=WHITE, index=1.5),
    # Absorption per metre at 650, 550 and 450 nm: Pope, Fry, Applied Optics 36(33), 1997.
    "water": Material(
        BLACK,
        HIGHLIGHT,
        BLACK,
        shininess=300.0,
        transmittance=WHITE,
        index=1.333,
        absorption=(0.34, 0.0565, 0.0092),
    ),
    "diamond": Material(BLACK, HIGHLIGHT, BLACK, shininess=300.0, transmittance=WHITE, index=2.417),
    # Under a clear coat of index 1.5, which reflects ((1.5 − 1)/(1.5 + 1))² = 0.04 straight on.
    "glossy plastic": Material(
        (0.6, 0.05, 0.05), HIGHLIGHT, (0.6, 0.05, 0.05), shininess=100.0, reflectance=(0.04,) * 3
    ),
}
PRESETS = (*_TABLE, *_TRACED)


def preset(name: str, material: Material = PLAIN) -> Material:
    """The material of this name; a texture of ``material`` stays, and its priority.

    Raises
    ------
    PlaygroundError
        There is none of this name.
    """
    if name in _TRACED:
        known = _TRACED[name]
    elif name in _TABLE:
        ambient, diffuse, specular, shininess = _TABLE[name]
        known = Material(diffuse, specular, ambient, shininess=LARGEST * shininess)
    else:
        raise unknown_name("preset", name, PRESETS)
    return replace(
        known,
        texture=material.texture,
        texture_encoding=material.texture_encoding,
        priority=material.priority,
    )


def look(material: Material) -> Rgb:
    """One colour (r, g, b) for a material in a list: what it scatters, mirrors or lets through."""
    columns = zip(material.diffuse, material.reflectance, material.transmittance, strict=True)
    red, green, blue = (max(column) for column in columns)
    return red, green, blue


@lru_cache(maxsize=64)
def preset_of(material: Material) -> str:
    """The name of the preset that ``material`` is, or an empty one."""
    return next((name for name in PRESETS if preset(name, material) == material), "")
