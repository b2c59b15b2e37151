"""The ray traced pictures of the view: by the GPU, or beside the window where it cannot."""

from __future__ import annotations

from collections.abc import Iterable

import moderngl

from playground.gui.picture.reference import ReferencePicture
from playground.gui.rays.large_trees import LargeTrees
from playground.gui.rays.traced_aside import effort_codes, traced_codes
from playground.gui.rays.tracing import TracedPicture
from playground.render.gl.program import ShaderError
from playground.render.image import LeftOut
from playground.scene.setup import Setup

Size = tuple[int, int]


class TracedSlots:
    """A traced picture for each place of the layout that wants one, and that of the tests.

    ``refused`` says why the GPU does not trace; from then on NumPy does, in the background.
    """

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self._pictures: dict[int, TracedPicture] = {}
        self._aside: dict[int, ReferencePicture] = {}
        self._used: tuple[int, ...] = ()
        self.tests = ReferencePicture(context, effort_codes)
        self.refused = ""
        self.trees = LargeTrees(context)

    def texture(self, number: int, setup: Setup, size: Size) -> tuple[moderngl.Texture, object]:
        """What there is of the picture at a place, and what changes whenever that does.

        Raises
        ------
        PlaygroundError
            What the tracer refuses.
        """
        if self.trees.growing(setup.scene):
            return self.trees.texture, None
        if not self.refused:
            picture = self._pictures.setdefault(number, TracedPicture(self._context))
            try:
                share = 1.0 / max(len(self._used), 1)
                return picture.texture(setup, size, share), picture.draws
            except ShaderError as error:
                self.refused = str(error)
        if number not in self._aside:
            self._aside[number] = ReferencePicture(self._context, traced_codes)
        made = self._aside[number]
        return made.texture(setup, size), made.stamp

    def tested(self, setup: Setup, size: Size) -> tuple[moderngl.Texture, object]:
        """The heat map of the tests, and what changes whenever it does."""
        return self.tests.texture(setup, size), self.tests.stamp

    def use(self, numbers: Iterable[int]) -> None:
        """Say which places have a traced picture; what is under way elsewhere is dropped."""
        self._used = tuple(numbers)
        if not self._used:
            self.trees.rest()
        for number in set(self._pictures) - set(self._used):
            self._pictures.pop(number).release()
        for number in set(self._aside) - set(self._used):
            made = self._aside.pop(number)
            made.rest()
            made.release()

    def __getitem__(self, number: int) -> TracedPicture | None:
        return None if self.refused else self._pictures.get(number)

    @property
    def first(self) -> TracedPicture | None:
        """The first traced picture in use by the GPU, of which the panel tells."""
        return self[self._used[0]] if self._used else None

    def settled(self, number: int) -> bool:
        """Whether nothing more will come of a picture."""
        if self.trees.working:
            return False
        if self.refused:
            return number in self._aside and not self._aside[number].computing
        return number in self._pictures and self._pictures[number].done

    def stamp(self, number: int) -> object:
        """What changes whenever a picture does."""
        if self.trees.working:
            return None
        return self._aside[number].stamp if self.refused else self._pictures[number].draws

    @property
    def done(self) -> bool:
        """Whether every picture in use is there as it shall be."""
        return all(self.settled(number) for number in self._used)

    @property
    def refining(self) -> bool:
        """Whether the next frame will bring more of a picture."""
        return not self.refused and not self.trees.working and not self.done

    @property
    def coming(self) -> bool:
        """Whether a thread computes a picture."""
        used = [self._aside[number] for number in self._used if number in self._aside]
        return self.trees.working or self.tests.coming or any(made.coming for made in used)

    @property
    def milliseconds(self) -> float:
        """What the last frame spent on tracing."""
        return sum(picture.milliseconds for picture in self._pictures.values())

    @property
    def left_out(self) -> LeftOut | None:
        """What the first picture leaves out, once it is done."""
        return self.first.left_out if self.first else None

    def close(self) -> None:
        """Free the GPU memory."""
        self.use(())
        self.tests.rest()
        self.tests.release()
        self.trees.close()
