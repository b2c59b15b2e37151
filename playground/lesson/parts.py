"""What a lesson is made of: values that the window, the handout and the tests share."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from playground.lesson.percent import Cell
from playground.lesson.prose import Block

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from playground.scene.setup import Setup


@dataclass(frozen=True)
class Step:
    """A part of a lesson under one heading: its cells, not yet run; ``minutes`` it takes."""

    heading: str
    cells: tuple[Cell, ...]
    slides: tuple[int, ...]
    minutes: float
    notes: tuple[Block, ...]
    line: int


@dataclass(frozen=True)
class Lesson:
    """A lesson as it is written; ``number`` is that of its file name, or None."""

    path: Path
    title: str
    steps: tuple[Step, ...]

    @property
    def number(self) -> int | None:
        """The number at the head of its file name."""
        head = self.path.stem.partition("_")[0]
        return int(head) if head.isdigit() else None

    @property
    def name(self) -> str:
        """Its number, or else the name of its file: how lists call it."""
        return self.path.stem if self.number is None else str(self.number)

    @property
    def minutes(self) -> float:
        """How long all steps take."""
        return sum(step.minutes for step in self.steps)

    @property
    def slides(self) -> tuple[int, ...]:
        """The slides that some step treats, in order."""
        return tuple(sorted({slide for step in self.steps for slide in step.slides}))


@dataclass(frozen=True)
class Text:
    """A cell of prose, its numbers filled in."""

    blocks: tuple[Block, ...]


@dataclass(frozen=True)
class View:
    """What the window is to show: a setup, and how. ``pixel`` holds shares of width and height."""

    setup: Setup
    method: str = "raster"
    beside: str = ""
    layout: str = ""
    pixel: tuple[float, float] | None = None
    panel: str = ""
    caption: tuple[Block, ...] = ()


@dataclass(frozen=True, eq=False)
class Figure:
    """A picture with a caption: 8-bit codes (H, W, 3); ``svg`` where it was drawn with lines.

    ``live`` says that it shows what the window shows itself.
    """

    caption: tuple[Block, ...]
    codes: NDArray[np.uint8]
    svg: str = ""
    live: bool = False


@dataclass(frozen=True)
class Question:
    """A prediction that is asked of the student; ``answer`` is the number of the right choice."""

    question: tuple[Block, ...]
    choices: tuple[tuple[Block, ...], ...]
    answer: int
    why: tuple[Block, ...]


@dataclass(frozen=True)
class Goal:
    """Something to reach in the window; whether it is, `playground.lesson.run.Running` knows."""

    text: tuple[Block, ...]
    hint: tuple[Block, ...]
    solution: Setup


Item = Text | View | Figure | Question | Goal


@dataclass(frozen=True, eq=False)
class Page:
    """A step that has run: its items, in the order of the cells."""

    step: Step
    items: tuple[Item, ...]

    @property
    def goals(self) -> tuple[Goal, ...]:
        """What is to be reached."""
        return tuple(item for item in self.items if isinstance(item, Goal))


def light(setup: Setup) -> Setup:
    """The setup without what its objects remember of their meshes: it goes through a pipe."""
    objects = tuple(replace(item) for item in setup.scene.objects)
    return replace(setup, scene=replace(setup.scene, objects=objects))
