"""The ray traced picture of one place in the view: coarse at once, sharper while nothing moves.

GL has one thread, the window's own, so a picture is made in pieces: bands of rows, as high as
fits into the budget of a frame. Any change drops what is under way.
"""

from __future__ import annotations

from collections.abc import Iterator
from time import perf_counter

import moderngl

from playground.gui.picture.texture_target import TextureTarget
from playground.render.gl.trace.tracer import GLTracer
from playground.render.image import LeftOut
from playground.scene.setup import Setup

Size = tuple[int, int]
BUDGET = 0.04  # seconds: while something moves, a picture that takes longer is drawn coarser
PIECE = 0.02  # seconds that a band of rows shall take
CALM = 0.12  # seconds without a change before the full picture is begun
COARSEST = 8  # times fewer pixels along either side
GUESS = 1e-6  # seconds per pixel, before anything was measured
HICCUP = 4.0  # times longer than usual is not what a picture costs
LONG = 90  # pictures from a camera that walks, before a program of their own is worth a pause
BLACK = (0.0, 0.0, 0.0)


class TracedPicture:
    """One picture under way, or done.

    ``samples_done`` of the picture at full resolution are in what is shown; 0 while it is coarse.
    """

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self._tracer = GLTracer((1, 1), context)
        self._coarse: TextureTarget | None = None
        self._fine: TextureTarget | None = None
        self._wanted: tuple[Setup, Size] | None = None
        self._since = self._share = 0.0
        self._spent = 0.0  # seconds for the bands of this sample so far
        self._turns = 0  # pictures in a row of the same scene
        self._bands = 1
        self._steps: Iterator[float] | None = None
        self._seconds_a_pixel = GUESS
        self._left_out: LeftOut | None = None
        self._lost_known = False
        self.milliseconds = 0.0  # of the last frame that has drawn here
        self.samples_done = 0
        self.draws = 0  # how often what is shown has changed

    def texture(self, setup: Setup, size: Size, share: float = 1.0) -> moderngl.Texture:
        """What there is of the picture of ``setup``, after its ``share`` of a frame's work on it.

        Raises
        ------
        PlaygroundError
            What the tracer refuses.
        """
        if self._wanted is None or self._wanted[1] != size or self._differs(setup):
            self._turns = self._turns + 1 if self._moves(setup) else 0
            self._tracer.bakes = self._turns > LONG
            self._wanted, self._since = None, perf_counter()  # not wanted if it is refused
            self._begin(setup, size, share)
            self._wanted = setup, size
        elif self.samples_done < setup.settings.samples and self._calm():
            self._go_on(setup, size, share)
        shown = self._fine if self.samples_done else self._coarse
        assert shown is not None
        return shown.texture

    @property
    def done(self) -> bool:
        """Whether there is nothing left to refine."""
        return self._wanted is None or self.samples_done >= self._wanted[0].settings.samples

    @property
    def share(self) -> float:
        """How much of the full picture is there, from 0 to 1."""
        if self.done:
            return 1.0
        return self._share if self._steps is not None else 0.0

    @property
    def left_out(self) -> LeftOut | None:
        """What depth and threshold have cut off; None until the picture is done and stays."""
        if not self.done or self._wanted is None or perf_counter() - self._since < CALM:
            return None
        if not self._lost_known:  # read once: it waits for the GPU
            self._left_out, self._lost_known = self._tracer.left_out, True
        return self._left_out

    @property
    def warnings(self) -> tuple[str, ...]:
        """What the picture shows that its author may not expect."""
        return self._tracer.warnings if self._wanted is not None else ()

    def release(self) -> None:
        """Free the GPU memory."""
        self._tracer.close()
        for target in (self._coarse, self._fine):
            if target is not None:
                target.release()

    def _differs(self, setup: Setup) -> bool:
        assert self._wanted is not None
        return self._wanted[0] is not setup and self._wanted[0] != setup

    def _moves(self, setup: Setup) -> bool:
        """Whether only the camera is another one than before."""
        if self._wanted is None:
            return False
        before = self._wanted[0]
        return before.scene is setup.scene and before.settings is setup.settings

    def _calm(self) -> bool:
        return self._steps is not None or perf_counter() - self._since >= CALM

    def _begin(self, setup: Setup, size: Size, share: float) -> None:
        """The first picture, as coarse as it must be to be there at once."""
        self._steps, self._lost_known, self.samples_done = None, False, 0
        times = coarseness(self._seconds_a_pixel * size[0] * size[1] / share)
        small = max(size[0] // times, 1), max(size[1] // times, 1)
        self._tracer.size = small
        known, pixels = self._seconds_a_pixel, small[0] * small[1]
        steps = self._tracer.steps(setup)
        took = self._timed(steps)
        self._seconds_a_pixel = took / pixels
        if self._seconds_a_pixel > HICCUP * known:  # a program was compiled: measure again
            steps = self._tracer.steps(setup)
            self._seconds_a_pixel = self._timed(steps) / pixels
        target = self._sized(size if times == 1 else small, times == 1)
        self._show(setup, target, 1.0 / setup.settings.samples)
        if times == 1:  # a whole sample of the full picture
            self._steps, self._bands, self.samples_done, self._spent = steps, 1, 1, 0.0
        self.milliseconds = 1e3 * took

    def _go_on(self, setup: Setup, size: Size, share: float) -> None:
        """A few bands more; what is shown changes with each whole sample."""
        count, until = setup.settings.samples, perf_counter() + share * PIECE
        if self._steps is None:
            self._tracer.size = size
            self._bands = bands(self._seconds_a_pixel * size[0] * size[1] / share, size[1])
            self._steps, self._share = self._tracer.steps(setup, self._bands), 0.0
            self._spent = 0.0
        began = perf_counter()
        while not self.done:
            self._spent += self._timed(self._steps)
            whole = int(self._share * count + 1e-6)
            if whole > self.samples_done:
                self._show(setup, self._sized(size, True), whole / count)
                # Of a whole sample: the rows of some bands cost far less than others.
                self._seconds_a_pixel = self._spent / (size[0] * size[1])
                self.samples_done, self._spent = whole, 0.0
            if perf_counter() >= until:
                break
        self.milliseconds = 1e3 * (perf_counter() - began)

    def _timed(self, steps: Iterator[float]) -> float:
        """Do one step and wait for it; returns seconds."""
        began = perf_counter()
        self._share = next(steps)
        self._context.finish()
        return perf_counter() - began

    def _show(self, setup: Setup, target: TextureTarget, share: float) -> None:
        target.begin(BLACK)
        self._tracer.show(setup, share)
        self.draws += 1

    def _sized(self, size: Size, fine: bool) -> TextureTarget:
        """The target for the full picture or the coarse one, of the right size."""
        old = self._fine if fine else self._coarse
        if old is not None and old.size == size:
            return old
        if old is not None:
            old.release()
        made = TextureTarget(self._context, size, 1)
        if fine:
            self._fine = made
        else:
            self._coarse = made
        return made


def coarseness(seconds: float) -> int:
    """Along either side so many times fewer pixels, for a picture that takes this long."""
    for times in range(1, COARSEST):
        if seconds <= BUDGET * times * times:
            return times
    return COARSEST


def bands(seconds: float, rows: int) -> int:
    """In how many bands a picture of that many rows is traced."""
    return min(max(round(seconds / PIECE), 1), rows)
