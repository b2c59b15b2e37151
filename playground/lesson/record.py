"""Keeps what a lesson says while it runs, and holds it to its word."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from playground.errors import PlaygroundError
from playground.lesson.mistake import LessonError
from playground.lesson.parts import Figure, Goal, Item, Page, Question, Step, Text, View, light
from playground.lesson.prose import Block, filled
from playground.lesson.words import SIZE, Check
from playground.scene.setup import Setup


class Recorder:
    """What the steps have said so far.

    With ``live``, for the window: it draws what is shown itself, and has no time for checks of
    goals, which the tests make.
    """

    def __init__(self, path: Path, live: bool = False) -> None:
        self.path, self.live = path, live
        self.numbers: dict[str, float] = {}
        self.items: list[Item] = []
        self.goals: list[Callable[[Setup], object]] = []
        self._shown: Setup | None = None

    def begin(self) -> None:
        """A new step."""
        self.items, self.goals = [], []

    def say(self, item: Item) -> None:
        """Keep an item."""
        self.items.append(item)

    def view(self, view: View, shows: Check | None) -> None:
        """Keep what the window shows; for the handout, draw and check it."""
        self._shown = view.setup
        self.say(replace(view, setup=light(view.setup)))
        if shows is None or self.live:
            return
        from playground.lesson.figures import assert_shows
        from playground.render.renderer import render

        image = render(view.setup, SIZE, method=view.method)
        assert_shows([image], "".join(block.text for block in view.caption), shows)
        self.say(Figure(view.caption, image.codes(), live=True))

    def number(self, name: str, value: float) -> None:
        """Keep a number."""
        if name in self.numbers:
            raise PlaygroundError("there is a number of that name already", got=name)
        self.numbers[name] = value

    def goal(self, goal: Goal, reached: Callable[[Setup], object]) -> None:
        """Keep a goal; unless a window waits, see that it can be reached and is not so already."""
        if self._shown is None:
            raise PlaygroundError("a goal needs something to start from", fix="Call show before.")
        if not self.live:
            if reached(self._shown):
                raise PlaygroundError("this goal is reached from the start")
            if not reached(goal.solution):
                raise PlaygroundError("the solution does not reach this goal")
        self.goals.append(reached)
        self.say(replace(goal, solution=light(goal.solution)))

    def page(self, step: Step) -> Page:
        """The step as it was said, with the numbers that are known at its end."""
        notes = self._filled(step.notes)
        return Page(replace(step, notes=notes), tuple(self._item(item) for item in self.items))

    def _item(self, item: Item) -> Item:
        fill = self._filled
        if isinstance(item, Text):
            return Text(fill(item.blocks))
        if isinstance(item, View | Figure):
            return replace(item, caption=fill(item.caption))
        if isinstance(item, Question):
            choices = tuple(fill(choice) for choice in item.choices)
            return Question(fill(item.question), choices, item.answer, fill(item.why))
        return replace(item, text=fill(item.text), hint=fill(item.hint))

    def _filled(self, blocks: tuple[Block, ...]) -> tuple[Block, ...]:
        made = []
        for block in blocks:
            try:
                made.append(filled(block, self.numbers))
            except PlaygroundError as error:
                if block.line:  # of the file; what a cell of code says has none
                    raise LessonError(self.path, block.line, str(error)) from None
                raise
        return tuple(made)
