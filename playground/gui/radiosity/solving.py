"""How radiosity is solved in the window, and what is marked of it: nothing of this is a setup."""

from __future__ import annotations

from dataclasses import dataclass, replace

from playground.scene.knob import Declared, integer, switch

MOST_BOUNCES = 50


@dataclass(frozen=True)
class Solving(Declared):
    """Whether the solver goes on by itself, and what the picture shows of its work.

    ``singles`` counts the single steps that were asked for, ``restarts`` the new beginnings.
    """

    label = "radiosity in the window"

    singles: int = 0
    restarts: int = 0

    playing: bool = switch(True, help="solve on, some milliseconds of every frame")
    outlines: bool = switch(False, help="the outlines of the patches, over the picture")
    shooter: bool = switch(False, help="mark the patches that shot in the last step, in yellow")
    by_bounce: bool = switch(
        False, help="show the light after so many reflections, in place of the solution"
    )
    bounces: int = integer(
        1, 0, MOST_BOUNCES, help="0 is what shines by itself; each sweep of Jacobi adds one"
    )

    def stepped(self) -> Solving:
        """The same, paused, with one step more to make."""
        return replace(self, playing=False, singles=self.singles + 1)

    def restarted(self) -> Solving:
        """The same, from the beginning."""
        return replace(self, restarts=self.restarts + 1)
