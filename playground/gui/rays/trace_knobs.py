"""What ray tracing shows besides its picture: how boxes spare rays most of the triangles."""

from __future__ import annotations

from dataclasses import dataclass

from playground.scene.knob import Declared, integer, switch


@dataclass(frozen=True)
class TraceChalk(Declared):
    """Nothing of this is part of the setup."""

    label = "overlays of ray tracing"

    boxes: bool = switch(
        False, help="the boxes around the triangles of the chosen object, one level of their tree"
    )
    level: int = integer(0, 0, 60, help="0 for the one box around all; each level halves them")
    tests: bool = switch(
        False,
        help="in place of the picture: how many boxes and triangles the ray of each pixel tests",
    )
