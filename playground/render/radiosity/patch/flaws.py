"""What `inspect` says of the surfaces of a scene: lists of what is wrong, and a readable text."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from playground.render.radiosity.patch.patches import Patches
from playground.shading.floats import Array

Integers = NDArray[np.int64]
EXAMPLES = 3  # of each kind, in the text

# Each kind with the names of one and of several, and what it means
KINDS = {
    "leaks": ("open edge", "open edges", "light can pass there"),
    "t_vertices": ("T-vertex", "T-vertices", "shading is torn there"),
    "overlaps": ("overlap in one plane", "overlaps in one plane", "either hides the other"),
    "inside_out": ("face inside out", "faces inside out", "their light goes to the wrong side"),
    "facing_nothing": ("patch facing nothing", "patches facing nothing", "light leaves the scene"),
    "facing_backs": (
        "patch facing a back",
        "patches facing backs",
        "hidden inside a solid, or one of the two is inside out",
    ),
}


@dataclass(frozen=True, eq=False)
class Flaws:
    """What `inspect` found, kind by kind; ``str`` of it is a readable text."""

    patches: Patches
    leaks: Integers  # (K,): patches with an edge where no other surface is, once for each edge
    t_vertices: Integers  # (K, 2): a patch, and the point in the middle of one of its edges
    overlaps: Integers  # (K, 2): parents of different owners that cover each other in one plane
    inside_out: Integers  # (K,): patches turned against most of those they hang together with
    facing_nothing: Integers  # (K,): patches in front of whose middle nothing is
    facing_backs: Integers  # (K,): patches in front of whose middle a surface shows its back

    @property
    def sound(self) -> bool:
        """Whether nothing is surely wrong: rims, and floor under a block, may be meant."""
        return not any(map(len, (self.t_vertices, self.overlaps, self.inside_out)))

    @property
    def closed(self) -> bool:
        """Whether no light can leave: no open edge, and something in front of every patch."""
        return len(self.leaks) == len(self.facing_nothing) == 0

    def __str__(self) -> str:
        found = [self._told(kind) for kind in KINDS if len(getattr(self, kind))]
        return "\n".join(found) if found else "No leak, T-vertex, overlap or face inside out."

    def _told(self, kind: str) -> str:
        one, many, meaning = KINDS[kind]
        patch, where = self._examples(kind)
        count = len(getattr(self, kind))
        lines = [f"{count} {one if count == 1 else many}: {meaning}"]
        for number, place in zip(patch.tolist(), where, strict=True):
            at = ", ".join(f"{x:.4g}" for x in place + self.patches.origin)
            owner = int(self.patches.owner[number]) + 1
            lines.append(f"  patch {number} of object {owner}, at ({at})")
        return "\n".join([*lines, "  ..."] if count > EXAMPLES else lines)

    def _examples(self, kind: str) -> tuple[NDArray[np.integer], Array]:
        """The first few patches of a kind, and where they are."""
        some = getattr(self, kind)[:EXAMPLES]
        if kind == "t_vertices":
            return some[:, 0], self.patches.points[some[:, 1]]
        patch = self.patches.parents.first[some[:, 0]] if kind == "overlaps" else some
        return patch, self.patches.centre[patch]
