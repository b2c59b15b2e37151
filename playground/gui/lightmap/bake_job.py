"""What bakes a lightmap in a process of its own; imports nothing of the window."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from playground.gui.work.long_work import Piece, Pieces
from playground.render.lightmap.bake import baking
from playground.render.radiosity.result import radiosity
from playground.scene.setup import Setup
from playground.steps import retold


@dataclass(frozen=True)
class BakeJob:
    """What the other process is asked for; its one item says how the lightmap is."""

    setup: Setup
    file: Path
    size: int
    rays: int

    def pieces(self) -> Pieces[str]:
        """Solve, bake, write; the file is there when the item comes."""
        result = radiosity(self.setup)
        try:
            baked = yield from retold(baking(result, self.size, self.rays), Piece[str])
        finally:
            result.close()
        baked.lightmap.save(self.file)
        yield Piece(1.0, str(baked))
