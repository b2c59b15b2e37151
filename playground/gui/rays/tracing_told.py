"""What a panel tells of the ray traced picture: how far it is, what it leaves out, warnings."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from playground.gui.rays.traced_slots import TracedSlots


@dataclass(frozen=True)
class TracingTold:
    """``share`` of the picture that is there; ``left_out`` in words, empty while it is not known.

    ``on`` says whether rays are traced at all, ``refused`` why not by the GPU.
    """

    on: bool = False
    share: float = 0.0
    left_out: str = ""
    warnings: tuple[str, ...] = ()
    refused: str = ""


def told(traced: TracedSlots) -> TracingTold:
    """Of the first traced picture in the view."""
    if traced.trees.working:
        return TracingTold(True, left_out="a tree of boxes is built around the triangles...")
    picture = traced.first
    if picture is None:
        return TracingTold(refused=traced.refused)
    left_out = picture.left_out
    words = "" if left_out is None else str(left_out)
    return TracingTold(True, picture.share, words, picture.warnings)
