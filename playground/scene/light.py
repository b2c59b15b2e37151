"""Where light comes from: directional, point, spot and area lights.

Each light has the three colours of the lecture: s_d (``diffuse``), s_s
(``specular``) and s_a (``ambient``). Attenuation and the spot cone weaken the
diffuse and the specular term; the ambient term is light that has already been
everywhere, and keeps its strength. Of an area light, s_d is what each point of it sends in each
direction, its radiance: seen from afar it is a point light of strength (solid angle)/π.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from math import cos, radians, sin, sqrt
from typing import ClassVar

from playground.errors import PlaygroundError
from playground.scene.knob import Declared, colour, number, switch, vector, vertices
from playground.scene.outline import Point, check_outline


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


@dataclass(frozen=True)
class AreaLight(Light):
    """A flat light that shines evenly from all of its area (a window, a panel)."""

    two_sided: bool = switch(False, help="shine from both sides")
    visible: bool = switch(True, help="draw the light itself, in its colour s_d")

    @property
    def corners(self) -> tuple[Point, ...]:
        """Its corners, counter-clockwise as seen from the side that shines."""
        raise NotImplementedError

    @property
    def centre(self) -> Point:
        """The mean of its corners."""
        x, y, z = (sum(column) / len(self.corners) for column in zip(*self.corners, strict=True))
        return x, y, z

    def moved(self, by: Point) -> AreaLight:
        """The same light, somewhere else."""
        raise NotImplementedError


@dataclass(frozen=True)
class RectangleLight(AreaLight):
    """An area light of width times height around a point (a window)."""

    kind: ClassVar[str] = "rectangle"

    position: Point = vector(0.0, 3.0, 0.0, help="the centre of the rectangle")
    facing: Point = vector(0.0, -1.0, 0.0, help="where its front looks; any length but 0")
    turn: float = number(
        0.0, -360.0, 360.0, unit="degrees", help="turns its sides around the direction it faces"
    )
    width: float = number(2.0, 1e-9, 1e9, unit="length", scale="log", help="its horizontal side")
    height: float = number(1.0, 1e-9, 1e9, unit="length", scale="log", help="its other side")

    def __post_init__(self) -> None:
        super().__post_init__()
        _refuse_zero(self.facing, "light.facing")

    @property
    def corners(self) -> tuple[Point, ...]:
        """Its four corners; before `turn`, ``width`` is horizontal (along x for one lying flat)."""
        ahead = _unit(self.facing)
        flat = abs(ahead[1]) > 1.0 - 1e-9
        right = (1.0, 0.0, 0.0) if flat else _unit((ahead[2], 0.0, -ahead[0]))
        up = _cross(ahead, right)
        c, s = cos(radians(self.turn)), sin(radians(self.turn))
        across = [0.5 * self.width * (c * r + s * u) for r, u in zip(right, up, strict=True)]
        along = [0.5 * self.height * (c * u - s * r) for r, u in zip(right, up, strict=True)]
        signs = ((-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0))
        return tuple(
            _point(p + i * a + j * b for p, a, b in zip(self.position, across, along, strict=True))
            for i, j in signs
        )

    def moved(self, by: Point) -> RectangleLight:
        """The same rectangle, somewhere else."""
        return replace(self, position=_point(a + b for a, b in zip(self.position, by, strict=True)))


@dataclass(frozen=True)
class PolygonLight(AreaLight):
    """An area light of any flat outline that does not cross itself, convex or not."""

    kind: ClassVar[str] = "polygon"

    vertices: tuple[Point, ...] = vertices(
        ((-1.0, 3.0, -1.0), (1.0, 3.0, -1.0), (0.0, 3.0, 1.0)),
        3,
        16,
        help="corners in one plane, counter-clockwise seen from the side that shines",
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        check_outline(self.vertices, "the corners in light.vertices")

    @property
    def corners(self) -> tuple[Point, ...]:
        """The vertices."""
        return self.vertices

    def moved(self, by: Point) -> PolygonLight:
        """The same polygon, somewhere else."""
        place = (_point(a + b for a, b in zip(v, by, strict=True)) for v in self.vertices)
        return replace(self, vertices=tuple(place))


LIGHTS: dict[str, type[Light]] = {
    light.kind: light
    for light in (DirectionalLight, PointLight, SpotLight, RectangleLight, PolygonLight)
}


def _point(values: Iterable[float]) -> Point:
    x, y, z = values
    return x, y, z


def _unit(v: Point) -> Point:
    largest = max(abs(x) for x in v)
    x, y, z = (x / largest for x in v)
    norm = sqrt(x * x + y * y + z * z)
    return x / norm, y / norm, z / norm


def _cross(a: Point, b: Point) -> Point:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def _refuse_zero(direction: tuple[float, float, float], where: str) -> None:
    if not any(direction):
        raise PlaygroundError(
            f"{where} has no direction", got=direction, allowed="any vector but (0, 0, 0)"
        )
