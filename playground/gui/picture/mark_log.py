"""How many pixels carry each mark, as a value: what shall be counted, and what was."""

from __future__ import annotations

from dataclasses import dataclass

from playground.scene.settings import MARKS
from playground.scene.setup import Setup

Size = tuple[int, int]
Texts = tuple[tuple[str, str], ...]  # in place of shader files
Pixels = tuple[Setup, Size, Texts]  # what a picture is drawn from


@dataclass(frozen=True)
class MarkLog:
    """What shall be counted (setup, size, shaders), what was, and the numbers in it."""

    wanted: Pixels | None = None
    counted: Pixels | None = None
    counts: tuple[int, ...] = ()  # in the order of `MARKS`

    def count(self, kind: str) -> int | None:
        """How many pixels are of this kind; None before they have been counted."""
        if self.wanted != self.counted or not self.counts:
            return None
        return self.counts[MARKS.index(kind)]
