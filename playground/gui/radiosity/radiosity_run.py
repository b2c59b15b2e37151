"""Radiosity solved while the window draws: some milliseconds of every frame, to be dropped at will.

The patches and the light straight from lamps need no GL and are made aside, on a thread. Form
factors and steps follow in the window's own thread, since the GPU may compute them. The camera
and the display change nothing here; what the solution depends on begins it anew, and until the
new one has made its first step the old light stays.
"""

from __future__ import annotations

from collections.abc import Iterator
from time import perf_counter
from typing import TYPE_CHECKING, Any

from playground.errors import PlaygroundError
from playground.gui.radiosity.bounce_run import BounceRun
from playground.gui.radiosity.solving import Solving
from playground.gui.work.long_work import LongWork, Piece, Pieces
from playground.render.radiosity.depends import Depends, depends
from playground.render.radiosity.result import Radiosity
from playground.render.radiosity.solver.system import Step
from playground.render.stored import StoredLight
from playground.scene.scene import Scene
from playground.scene.settings import Settings, Shading
from playground.scene.setup import Setup

if TYPE_CHECKING:
    from playground.render.radiosity.patch.patches import Patches

LEAST, MOST = 0.010, 0.040  # seconds of a frame; between them, as long as the rest of it takes
REST = 3.0  # times what showing new light takes, before it is shown again
Light = tuple[StoredLight | None, ...]


class RadiosityRun:
    """The solution of what the view shows, as far as it is.

    ``result`` is it, None before the first; ``error`` says why there is none; ``draws`` changes
    whenever the light that is to be drawn does.
    """

    def __init__(self, context: Any) -> None:
        self._context = context
        self.result: Radiosity | None = None
        self.error = ""
        self.draws = 0
        self.bounced = BounceRun()
        self._of: tuple[Scene, Settings] | None = None
        self._depends: Depends | None = None
        self._counts = (0, 0)
        self._owed = 0  # single steps still to be made
        self._aside: LongWork[None] | None = None
        self._steps: Iterator[float] | None = None
        self._shown: Radiosity | None = None  # whose light is drawn: until the new one has some
        self._seen: tuple[Any, ...] = ()
        self._since = self._took = self._ended = 0.0
        self.playing = True

    def advance(self, setup: Setup, solving: Solving) -> None:
        """Begin anew if ``setup`` asks for it, and go on for a while if ``solving`` does."""
        self.playing = solving.playing
        self._notice(setup, solving)
        if self.result is None or self.error:
            return
        try:
            self._go_on(solving)
        except PlaygroundError as error:
            self._fail(error)
        except MemoryError:
            self._fail("the memory does not suffice for so many patches")
        self._ended = perf_counter()

    def stored(self, setup: Setup, solving: Solving) -> Light:
        """The light of each object as it is drawn now; None where none is known yet."""
        nothing = (None,) * len(setup.scene.objects)
        result, flat = self._shown, setup.settings.shading == Shading.FLAT
        if self.error or result is None or len(result.setup.scene.objects) != len(nothing):
            return nothing
        began = perf_counter()
        try:
            light = self._light(result, flat, setup.settings.light_shown, solving)
        except PlaygroundError as error:
            self._fail(error)
            return nothing
        self._took, self._since = perf_counter() - began, perf_counter()
        return light

    @property
    def step(self) -> Step | None:
        """The last step of the solution."""
        return self.result.step if self.result is not None else None

    @property
    def drawn(self) -> Radiosity | None:
        """The solution that is drawn; None while its form factors may serve its successor."""
        settled = self._shown is self.result and self._aside is None and not self.error
        return self.result if settled and self.step is not None else None

    @property
    def patches(self) -> Patches | None:
        """The patches; None while there are none."""
        known = self.result is not None and self._aside is None and not self.error
        return self.result.patches if self.result is not None and known else None

    @property
    def done(self) -> bool:
        """Whether nothing will change by itself any more, but for a pause."""
        return bool(self.error) or self.result is None or self.result.done

    @property
    def working(self) -> bool:
        """Whether the next frame will bring more."""
        if self.error or self.result is None:
            return False
        going = self._aside is not None or (self._goes and not self.result.done)
        return going or self.bounced.working

    def close(self) -> None:
        """Free what the GPU holds, while the context is there."""
        if self._aside is not None:
            self._aside.close()
        self._aside = self._steps = None
        for result in (self.result, self._shown):
            if result is not None:
                result.close()
        self.result = self._shown = None

    @property
    def _goes(self) -> bool:
        return self.playing or self._owed > 0

    def _notice(self, setup: Setup, solving: Solving) -> None:
        counts = (solving.singles, solving.restarts)
        singles, restarts = (now - was for now, was in zip(counts, self._counts, strict=True))
        self._counts = counts
        if restarts:
            self._of = self._depends = None
        of = (setup.scene, setup.settings)
        if self._of is None or self._of[0] is not of[0] or self._of[1] is not of[1]:
            self._of = of
            self._change(setup)
        self._owed = max(self._owed + singles, 0)
        if self.result is not None and (self.playing or self.result.done):
            self._owed = 0

    def _change(self, setup: Setup) -> None:
        """Begin anew, if what the solution depends on is another one."""
        try:
            wanted = depends(setup)
        except PlaygroundError as error:
            self._depends = None
            self._fail(error)
            return
        if wanted == self._depends:
            return
        self._depends, self.error, self._owed = wanted, "", 0
        if self._aside is not None:
            self._aside.stop()
        self.result = Radiosity(setup, "auto", self._context, self.result)
        self._aside, self._steps = LongWork(_ahead(self.result), aside=True), None
        self.draws += 1

    def _fail(self, error: object) -> None:
        self.error = str(error)
        self._aside = self._steps = None
        self.draws += 1

    def _go_on(self, solving: Solving) -> None:
        result, now = self.result, perf_counter()
        until = now + min(max(now - self._ended, LEAST), MOST)
        assert result is not None
        if self._aside is not None:
            self._aside.take()
            if not self._aside.done:
                return
            self._aside = None
        if solving.by_bounce and result.step is not None:
            self.bounced.advance(result, solving.bounces, until)
        self._steps = self._steps or result.solving()
        while self._goes and not result.done and perf_counter() < until:
            before = result.step
            next(self._steps, None)
            if result.step is not before and result.step is not None:
                self._owed = max(self._owed - 1, 0)
        self._show(result, solving)

    def _show(self, result: Radiosity, solving: Solving) -> None:
        """Have the new light drawn, unless it was only just."""
        bounces = self.bounced.shown(result, solving)
        seen = (result, result.step, bounces)
        if result.step is None or _same(seen, self._seen):
            return
        idle = result.done or not self._goes
        if idle or perf_counter() - self._since >= REST * self._took:
            self._shown, self._seen = result, seen
            self.draws += 1

    def _light(self, result: Radiosity, flat: bool, light_shown: str, solving: Solving) -> Light:
        if result is not self.result and "direct" not in result.__dict__:
            light_shown = "all"  # the form factors it had may serve its successor by now
        bounced = self.bounced.light(result, solving)
        if bounced is not None:
            return result.drawn(flat).stored(*bounced, light_shown)
        return result.stored(flat, light_shown)


def _same(one: tuple[Any, ...], other: tuple[Any, ...]) -> bool:
    """Whether both hold the same objects; light is not compared number by number."""
    return len(one) == len(other) and all(a is b for a, b in zip(one, other, strict=True))


def _ahead(result: Radiosity) -> Pieces[None]:
    """What a solution needs and no GL takes."""
    _ = result.patches
    yield Piece(0.5)
    _ = result.lamps
    yield Piece(1.0)
