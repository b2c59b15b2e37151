"""The numbers of the Snell bench: one surface, two media, one ray; all by `shading.optics`."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import asin, atan, atan2, cos, degrees, radians, sin

import numpy as np
from numpy.typing import NDArray

from playground.scene.knob import Declared, number
from playground.shading.optics import (
    cosine_transmitted,
    fresnel,
    fresnel_polarised,
    schlick_either,
)

Array = NDArray[np.float64]
MEDIA = {"air": 1.0, "water": 1.333, "glass": 1.5, "diamond": 2.42}
STEEPEST = 89.9  # degrees: at 90 the ray would never meet the surface
SNAP = 1.2  # degrees around a special angle within which a dragged ray jumps to it


@dataclass(frozen=True)
class Bench(Declared):
    """A ray comes from above and meets a plane."""

    label = "bench"

    above: float = number(1.0, 1.0, 4.0, help="refractive index on the side of the incoming ray")
    below: float = number(1.5, 1.0, 4.0, help="refractive index beyond the surface")
    angle: float = number(
        40.0, 0.0, STEEPEST, unit="degrees", help="between the ray and the normal; drag the ray"
    )

    @property
    def critical(self) -> float | None:
        """The angle in degrees beyond which nothing gets through; None where all angles do."""
        if self.below >= self.above:
            return None
        return degrees(asin(self.below / self.above))

    @property
    def brewster(self) -> float:
        """The angle in degrees at which no p-polarised light is reflected."""
        return degrees(atan(self.below / self.above))

    @property
    def refracted(self) -> float | None:
        """The angle of the ray beyond the surface in degrees; None for total reflection."""
        sine = sin(radians(self.angle))
        cosine = float(cosine_transmitted(sine, self.above, self.below))
        if cosine < 0.0:
            return None
        return degrees(atan2(sine * self.above / self.below, cosine))

    @property
    def shares(self) -> Shares:
        """What the surface reflects at this angle."""
        return shares(self, np.array([self.angle]))

    def swapped(self) -> Bench:
        """The ray from the other side, at the angle at which it leaves there."""
        angle = self.angle if self.refracted is None else min(self.refracted, STEEPEST)
        return replace(self, above=self.below, below=self.above, angle=angle)

    def snapped(self, angle: float) -> Bench:
        """The ray at ``angle`` degrees, or exactly at the critical angle if it is near."""
        angle = min(max(angle, 0.0), STEEPEST)
        if self.critical is not None and abs(angle - self.critical) < SNAP:
            angle = self.critical
        return replace(self, angle=angle)


@dataclass(frozen=True, eq=False)
class Shares:
    """What a surface reflects at N angles, each (N,): by polarisation, the mean, the guess."""

    s: Array
    p: Array
    mean: Array
    schlick: Array


def shares(bench: Bench, angles: Array) -> Shares:
    """Fresnel's equations and Schlick's approximation at angles in degrees, (N,)."""
    turned = np.radians(angles)
    given = np.cos(turned), np.sin(turned), bench.above, bench.below
    return Shares(*fresnel_polarised(*given), fresnel(*given), schlick_either(*given))


def medium(index: float) -> str:
    """What a medium with this index is called, or nothing."""
    return next((name for name, known in MEDIA.items() if abs(known - index) < 5e-4), "")


def angle_at(right: float, up: float) -> float:
    """The angle in degrees of a ray that comes from a place above the surface, by symmetry."""
    return degrees(atan2(abs(right), max(up, 0.0)))


def ends(angle: float, length: float) -> tuple[float, float]:
    """How far to the side and up a ray at an angle in degrees reaches."""
    turned = radians(angle)
    return length * sin(turned), length * cos(turned)
