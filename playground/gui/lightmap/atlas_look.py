"""How the texels of the lightmap are looked at, as a value."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

from playground.scene.knob import Declared, number, switch

CLOSEST = 64.0  # times


class Spot(NamedTuple):
    """A texel that the mouse is over: in the atlas, or in the picture."""

    column: int
    row: int
    in_atlas: bool


@dataclass(frozen=True)
class AtlasLook(Declared):
    """The part of the atlas that is shown: its middle in shares of the whole, and its size."""

    label = "atlas"

    middle: tuple[float, float] = (0.5, 0.5)  # u to the right, v up
    spot: Spot | None = None
    borders: bool = switch(True, help="lines where a chart ends: there the surface was cut apart")
    dilated: bool = switch(
        True, help="tint texels beyond the charts that took over the light of their neighbours"
    )
    zoom: float = number(1.0, 1.0, CLOSEST, scale="log", help="the wheel zooms, too")

    def corner(self) -> tuple[float, float]:
        """The lower left corner of what is shown."""
        half = 0.5 / self.zoom
        return self.middle[0] - half, self.middle[1] - half

    def at(self, x: float, y: float) -> tuple[float, float]:
        """Where in the atlas (u, v) a place of the view lies: shares from its upper left corner."""
        u, v = self.corner()
        return u + x / self.zoom, v + (1.0 - y) / self.zoom

    def seen_at(self, u: float, v: float) -> tuple[float, float]:
        """Where in the view a place of the atlas appears; the inverse of `at`."""
        left, low = self.corner()
        return (u - left) * self.zoom, 1.0 - (v - low) * self.zoom

    def moved(self, right: float, down: float) -> AtlasLook:
        """After a drag, in shares of the view: what was under the mouse stays there."""
        u, v = self.middle
        return replace(self, middle=(u - right / self.zoom, v + down / self.zoom)).within()

    def closer(self, factor: float, x: float, y: float) -> AtlasLook:
        """Zoomed about a place of the view, which stays where it is."""
        u, v = self.at(x, y)
        zoom = min(max(self.zoom * factor, 1.0), CLOSEST)
        middle = (u + (0.5 - x) / zoom, v - (0.5 - y) / zoom)
        return replace(self, zoom=zoom, middle=middle).within()

    def within(self) -> AtlasLook:
        """The same without any room beyond the atlas."""
        half = 0.5 / self.zoom
        u, v = (min(max(x, half), 1.0 - half) for x in self.middle)
        return self if (u, v) == self.middle else replace(self, middle=(u, v))
