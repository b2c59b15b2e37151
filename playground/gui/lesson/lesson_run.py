"""Keeps an open lesson going, once a frame: runs its steps, asks for its goals and formulas."""

from __future__ import annotations

from dataclasses import replace
from shutil import rmtree
from tempfile import mkdtemp
from time import perf_counter
from weakref import finalize

from playground.files import Stamp, stamp
from playground.gui.lesson.lesson_course import Course, reach, read_again, staged
from playground.gui.lesson.lesson_pictures import LessonPictures
from playground.gui.lesson.lesson_process import LessonProcess
from playground.gui.state import State
from playground.lesson.formula import Mask
from playground.lesson.parts import Lesson, Page, light
from playground.lesson.serve import Complaint, Reached, Request, RunNext, Typeset
from playground.scene.setup import Setup

GLANCE = 0.5  # seconds between two looks at whether the file has changed


class LessonRun:
    """Advances the lesson of the state; `advance` is called once a frame."""

    def __init__(self, pictures: LessonPictures) -> None:
        self._pictures = pictures
        self._process: LessonProcess | None = None
        self._lesson: Lesson | None = None
        self._asked: dict[tuple[int, int], Setup] = {}  # what each goal was held against last
        self._drawn = (0, 0)  # the step and the number of pages that the last frame has drawn
        self._stamp: Stamp | None = None
        self._looked = 0.0
        self._scratch = ""  # stays when the lesson is closed: the scene may use its files

    @property
    def coming(self) -> bool:
        """Whether an answer is on its way."""
        return self._process is not None and not self._process.idle

    def advance(self, state: State) -> State:
        """The state with what the lesson has to say by now."""
        if state.lesson is None:
            self.close()
            return state
        state = self._changed(state)
        course = state.lesson
        assert course is not None
        if course.lesson is not self._lesson:
            self._start(course)
        state = staged(self._taken(state))
        if self._process is not None and self._process.idle and state.lesson is not None:
            request = self._wanted(state, state.lesson)
            if request is not None:
                self._process.ask(request)
        return state

    def close(self) -> None:
        """Let go of the lesson."""
        if self._process is not None:
            self._process.close()
            self._pictures.forget()
        self._process = self._lesson = None

    def _start(self, course: Course) -> None:
        self.close()
        self._lesson, self._asked = course.lesson, {}
        self._stamp = stamp(course.lesson.path)
        if not course.error:
            if not self._scratch:
                self._scratch = mkdtemp(prefix="playground-lesson-")
                finalize(self, rmtree, self._scratch, ignore_errors=True)
            self._process = LessonProcess(course.lesson.path, self._scratch)

    def _changed(self, state: State) -> State:
        """Read the file again where its author has changed it."""
        now = perf_counter()
        if state.lesson is None or state.lesson.lesson is not self._lesson:
            return state
        if now - self._looked < GLANCE:
            return state
        self._looked = now
        if stamp(state.lesson.lesson.path) == self._stamp:
            return state
        self._stamp = stamp(state.lesson.lesson.path)
        return read_again(state)

    def _taken(self, state: State) -> State:
        """The state with the answer that has come."""
        found = self._process.take() if self._process is not None else None
        course = state.lesson
        if course is None or self._process is None:
            return state
        if found is None:
            if self._process.dead and not course.error:
                return _failed(state, course, "the lesson has ended by itself")
            return state
        request, answer = found
        if isinstance(answer, Page):
            return replace(state, lesson=replace(course, pages=(*course.pages, answer)))
        if isinstance(answer, Mask) and isinstance(request, Typeset):
            self._pictures.keep(request, answer)
        elif isinstance(answer, Complaint):
            if isinstance(request, Typeset):
                self._pictures.refuse(request)
                return state.fail(answer.text)
            return _failed(state, course, answer.text)
        elif isinstance(request, Reached) and answer is True:
            return reach(state, request.step, request.goal)
        return state

    def _wanted(self, state: State, course: Course) -> Request | None:
        """What to ask for next, the most urgent first."""
        if course.error:
            return None
        typeset = self._pictures.wanted()
        if typeset is not None:  # first of all: it is quick, and is being read
            return typeset
        if course.page is None:
            return RunNext()
        for i in course.goals():
            key = (course.step, i)
            if self._asked.get(key) is not state.setup:
                self._asked[key] = state.setup
                return Reached(course.step, i, light(state.setup))
        drawn = (course.step, len(course.pages))
        if drawn != self._drawn:  # its formulas are first asked for when it is drawn
            self._drawn = drawn
            return None
        ahead = len(course.pages) <= course.step + 1 < len(course.lesson.steps)
        return RunNext() if ahead and not course.goals() else None


def _failed(state: State, course: Course, error: str) -> State:
    return replace(state, lesson=replace(course, error=error)).fail(error)
