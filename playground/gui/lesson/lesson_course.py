"""The lesson that is open in the window, as one frozen value, and what its keys do.

A step that has run is a page. Of its items those are seen that come before the first question
without an answer, and that question; the last setup among them is what the window shows.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from playground.errors import PlaygroundError
from playground.lesson.library import find, following
from playground.lesson.parts import Goal, Item, Lesson, Page, Question, View
from playground.lesson.script import read_lesson
from playground.lesson.words import SIZE

if TYPE_CHECKING:
    from playground.gui.state import State

SHADERS = "Shaders"  # the panel below the picture
SKIPPED = -1  # the answer of someone who went on without one


@dataclass(frozen=True)
class Course:
    """Which lesson, which step, what has run, and what the student has done.

    ``answers`` holds (step, question, choice), ``reached`` and ``hinted`` (step, goal); questions
    and goals are counted within their step. ``shown`` is the view that the window was set to last,
    ``after`` the lesson that comes next.
    """

    lesson: Lesson
    step: int = 0
    pages: tuple[Page, ...] = ()
    answers: tuple[tuple[int, int, int], ...] = ()
    reached: frozenset[tuple[int, int]] = frozenset()
    hinted: frozenset[tuple[int, int]] = frozenset()
    shown: View | None = None
    error: str = ""
    after: Path | None = None

    @property
    def page(self) -> Page | None:
        """The page of the step, once it has run."""
        return self.pages[self.step] if self.step < len(self.pages) else None

    @property
    def last(self) -> bool:
        """Whether this is the last step."""
        return self.step == len(self.lesson.steps) - 1

    def choice(self, question: int) -> int | None:
        """What was answered to a question of this step; None if nothing was."""
        for step, number, choice in self.answers:
            if (step, number) == (self.step, question):
                return choice
        return None

    @property
    def open_question(self) -> int | None:
        """The first question of this step without an answer."""
        asked = sum(isinstance(item, Question) for item in self.page.items) if self.page else 0
        return next((i for i in range(asked) if self.choice(i) is None), None)

    def seen(self) -> tuple[Item, ...]:
        """The items of the page that are seen."""
        if self.page is None:
            return ()
        found, question = list[Item](), 0
        for item in self.page.items:
            found.append(item)
            if isinstance(item, Question):
                if self.choice(question) is None:
                    break
                question += 1
        return tuple(found)

    def goals(self) -> dict[int, Goal]:
        """The goals of this step that are seen and not yet reached, by number."""
        seen = [item for item in self.seen() if isinstance(item, Goal)]
        return {i: goal for i, goal in enumerate(seen) if (self.step, i) not in self.reached}

    def view(self) -> View | None:
        """What the window is to show: the last view up to here."""
        earlier = [item for page in self.pages[: self.step] for item in page.items]
        views = [item for item in (*earlier, *self.seen()) if isinstance(item, View)]
        return views[-1] if views else None


def open_lesson(state: State, which: str | Path) -> State:
    """Open a lesson at its first step; where that fails, say why and change nothing."""
    try:
        lesson = read_lesson(find(str(which)))
    except PlaygroundError as error:
        return state.fail(error)
    course = Course(lesson, after=following(lesson.path))
    return replace(state, lesson=course, sheet="").say(lesson.title)


def read_again(state: State) -> State:
    """The lesson as its file is now, at the same step."""
    if state.lesson is None:
        return state
    try:
        lesson = read_lesson(state.lesson.lesson.path)
    except PlaygroundError as error:
        return replace(state, lesson=replace(state.lesson, pages=(), error=str(error)))
    step = min(state.lesson.step, len(lesson.steps) - 1)
    again = Course(lesson, step, answers=state.lesson.answers, after=state.lesson.after)
    return replace(state, lesson=again).say(f"{lesson.path.name} was read again")


def close_lesson(state: State) -> State:
    """The window without the lesson; the scene stays."""
    return state if state.lesson is None else replace(state, lesson=None).say("the lesson is over")


def go_on(state: State) -> State:
    """Past the open question, or to the next step."""
    course = state.lesson
    if course is None:
        return state
    question = course.open_question
    if question is not None:
        return answer(state, question, SKIPPED)
    if course.last:
        return state.say("this is the last step")
    return _at(state, course, course.step + 1)


def go_back(state: State) -> State:
    """To the step before."""
    course = state.lesson
    if course is None:
        return state
    if course.step == 0:
        return state.say("this is the first step")
    return _at(state, course, course.step - 1)


def _at(state: State, course: Course, step: int) -> State:
    heading = course.lesson.steps[step].heading
    return replace(state, lesson=replace(course, step=step)).say(heading)


def answer(state: State, question: int, choice: int) -> State:
    """The student's answer to a question of this step; the first one counts."""
    course = state.lesson
    if course is None or course.choice(question) is not None:
        return state
    given = (*course.answers, (course.step, question, choice))
    return replace(state, lesson=replace(course, answers=given))


def hint(state: State, goal: int) -> State:
    """Show the hint to a goal of this step."""
    if state.lesson is None:
        return state
    hinted = state.lesson.hinted | {(state.lesson.step, goal)}
    return replace(state, lesson=replace(state.lesson, hinted=hinted))


def reach(state: State, step: int, goal: int) -> State:
    """A goal is reached."""
    if state.lesson is None:
        return state
    reached = state.lesson.reached | {(step, goal)}
    return replace(state, lesson=replace(state.lesson, reached=reached)).say("goal reached")


def staged(state: State) -> State:
    """The window set to what the lesson shows, if that has changed; undo leads back."""
    course = state.lesson
    view = course.view() if course is not None else None
    if course is None or view is None or view is course.shown or course.page is None:
        return state
    state = replace(state, lesson=replace(course, shown=view))
    layout = view.layout or ("side by side" if view.beside else "single")
    try:
        opened = state.opened(view.setup)
        other = view.beside or opened.other
        state = replace(opened, method=view.method, layout=layout, other=other)
    except PlaygroundError as error:
        return state.fail(f"{course.lesson.path}: {error}")
    clue = replace(state.clue, picture=0, seen=("single", SIZE))  # there the pixel was chosen
    shaders = state.shaders or view.panel == SHADERS
    return replace(state, pixel=view.pixel, clue=clue, unfold=view.panel, shaders=shaders)
