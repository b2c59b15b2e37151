"""How the rays behind the picked pixel are shown: how many bounces, which one is pointed at."""

from __future__ import annotations

from dataclasses import dataclass, replace

ALL = -1  # every bounce is drawn
PACE = 0.9  # seconds for one bounce of the animation
REST = 1.5  # seconds that the whole tree stands before it grows again


@dataclass(frozen=True)
class RayView:
    """Chalk on the picture; nothing of it is part of the setup.

    ``step`` is the last bounce that is drawn, `ALL` for every one. ``grown`` is how much of the
    tree the animation shows, in bounces. ``lit`` and ``chosen`` are numbers of nodes, −1 for none.
    ``pruned`` are the nodes that are cut off with all that grows on them, in the tree ``of``.
    """

    step: int = ALL
    playing: bool = False
    grown: float = 0.0
    lit: int = -1
    chosen: int = -1
    pruned: frozenset[int] = frozenset()
    of: object = None

    def grows_to(self, depth: int) -> float:
        """How many bounces of a tree of this depth are drawn, the last of them in part."""
        if self.playing:
            return min(self.grown, depth + 1.0)
        return depth + 1.0 if self.step == ALL else min(self.step, depth) + 1.0

    def stepped(self, by: int, depth: int) -> RayView:
        """One bounce more or less of a tree of this depth."""
        now = depth if self.step == ALL else min(self.step, depth)
        then = min(max(now + by, 0), depth)
        return replace(self, step=ALL if then == depth else then, playing=False)

    def played(self) -> RayView:
        """Begin to grow, or stop with everything drawn."""
        return replace(self, playing=not self.playing, grown=0.0, step=ALL)

    def later(self, seconds: float, depth: int) -> RayView:
        """The same a moment later."""
        if not self.playing:
            return self
        grown = self.grown + seconds / PACE
        return replace(self, grown=0.0 if grown > depth + 1.0 + REST / PACE else grown)

    def toggled(self, node: int) -> RayView:
        """A branch cut off, or back on the tree."""
        return replace(self, pruned=self.pruned ^ {node})

    def for_tree(self, key: object) -> RayView:
        """The same for a tree: what was pointed at or cut off in another one means nothing."""
        if self.of == key:
            return self
        return replace(self, lit=-1, chosen=-1, pruned=frozenset(), of=key, grown=0.0)
