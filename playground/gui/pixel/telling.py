"""What the panel says of an explained pixel: every text, colour and number, made once.

An explanation never changes, so what is said of it does not either: it is kept by the
explanation itself, and another setup, pixel or size of the picture is another explanation.
The panel only has to set it.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from math import acos, degrees
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from playground.explain.pixel import Explanation, LightAtPoint, ShadedPoint
from playground.explain.words import CORNERS
from playground.gui.pixel.equation import Parts, filtered, formula, numbers, triple
from playground.gui.pixel.triangle_mark import shown_colour
from playground.scene.settings import TERMS

if TYPE_CHECKING:
    from playground.explain.stored_pixel import StoredPixel

Array = NDArray[np.float64]
LIT_TERMS = TERMS[:3]  # those that each light adds
KEPT = 4  # explanations, with the vertex and the light that are chosen


class Line(NamedTuple):
    """Words behind a square of a colour, as the display shows it: red, green, blue, alpha."""

    text: str
    colour: tuple[float, float, float, float]


@dataclass(frozen=True)
class LightTold:
    """What one light adds: the sum, and a line by the name of each term."""

    total: Line
    terms: dict[str, Line]


@dataclass(frozen=True)
class ChosenLight:
    """What is said of the light whose vectors are shown.

    ``equations`` are a term in symbols and in numbers, ``filters`` the colours s and m
    of a term, both by its name.
    """

    products: Parts
    equations: dict[str, tuple[Parts, Parts]]
    filters: dict[str, tuple[list[float], list[float]]]
    angle: float  # of the viewer in the lobe, degrees
    lobe: Parts


@dataclass(frozen=True)
class PointTold:
    """What is said of one point: of the surface that the pixel sees, or of a vertex of it."""

    vertices: tuple[Line, ...]  # the three of the triangle, where the model is evaluated there
    lights: tuple[LightTold, ...]
    chosen: ChosenLight | None
    emissive: Line
    total: Line | None  # the sum at this vertex


@dataclass(frozen=True)
class DisplayTold:
    """From the sum to the code on the screen."""

    colour: Line
    steps: str
    shown: Line
    codes: str


@lru_cache(maxsize=KEPT)
def point_told(why: Explanation, corner: int, light: int) -> PointTold:
    """What is said of one of the points, and of one of its lights (-1 for none)."""
    point, mixed = why.corners[corner], len(why.corners) > 1
    mix = zip(CORNERS, why.weights, why.corners, strict=False)
    told = (f"{name}   {weight:.3f} · {triple(at.colour)}" for name, weight, at in mix)
    vertices = (line(why, at.colour, text) for text, at in zip(told, why.corners, strict=True))
    return PointTold(
        vertices=tuple(vertices) if len(why.corners) == 3 else (),
        lights=tuple(_light(why, i, of) for i, of in enumerate(point.lights)),
        chosen=_chosen(why, point, point.lights[light]) if light >= 0 else None,
        emissive=line(why, point.emissive, f"emissive  {triple(point.emissive)}"),
        total=line(why, point.colour, f"sum at this vertex  {triple(point.colour)}")
        if mixed
        else None,
    )


def _light(why: Explanation, i: int, light: LightAtPoint) -> LightTold:
    total = light.diffuse + light.specular + light.ambient
    added = {term: getattr(light, term) for term in LIT_TERMS}
    return LightTold(
        line(why, total, f"light {i}  {light.kind}   {triple(total)}"),
        {term: line(why, by, f"{term}  {triple(by)}") for term, by in added.items()},
    )


def _chosen(why: Explanation, point: ShadedPoint, light: LightAtPoint) -> ChosenLight:
    products = ("n", "·", "l", f"= {light.n_dot_l:.3f}   ", "r", "·", "v", f"= {light.r_dot_v:.3f}")
    halfway = ("  ", "n", "·", "h", f"= {light.specular_cosine:.3f}")
    blinn = why.setup.settings.highlight == "blinn"
    cosine = float(np.clip(light.specular_cosine, -1.0, 1.0))
    angle = degrees(acos(cosine))
    factor = max(cosine, 0.0) ** why.shininess
    return ChosenLight(
        products=(*products, *(halfway if blinn else ()), "  ", "ρ", f"= {light.rho:.1f}°"),
        equations={
            term: (formula(term, why, light.area), ("=", *numbers(term, why, point, light)))
            for term in LIT_TERMS
        },
        filters={term: filtered(term, why, point, light) for term in LIT_TERMS},
        angle=angle,
        lobe=(
            f"{'∠ n h' if blinn else '∠ r v'} = {angle:.1f}° ",
            f"cos = {cosine:.3f} ",
            f"cos^{why.shininess:g} = {factor:.3g}",
        ),
    )


@lru_cache(maxsize=KEPT)
def display_told(why: Explanation | StoredPixel) -> DisplayTold:
    """What is said of the sum, and of what the display makes of it."""
    settings = why.setup.settings
    steps = [f"× {settings.exposure:g}"] if settings.exposure != 1.0 else []
    if float(np.max(why.colour * settings.exposure)) > 1.0:
        steps.append("cut at 1" if settings.clamp else "wrapped around")
    elif settings.clamp:
        steps.append("clamp: nothing to cut")
    steps += ["sRGB curve"] if settings.curve == "srgb" else []
    return DisplayTold(
        colour=line(why, why.colour, f"colour  {triple(why.colour)}"),
        steps="    " + ", ".join(steps or ["as it is"]),
        shown=line(why, why.colour, f"shown  {triple(why.shown)}"),
        codes="    8-bit code  " + " ".join(str(int(code)) for code in why.codes),
    )


def line(why: Explanation | StoredPixel, colour: Array, text: str) -> Line:
    """A line about a linear colour."""
    red, green, blue = (code / 255.0 for code in shown_colour(why, colour))
    return Line(text, (red, green, blue, 1.0))
