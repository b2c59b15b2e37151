"""The lesson beside the picture: its text and figures, its questions and goals."""

from __future__ import annotations

from dataclasses import replace

from imgui_bundle import imgui

from playground.gui.lesson import lesson_text
from playground.gui.lesson.lesson_course import (
    SKIPPED,
    Course,
    answer,
    close_lesson,
    go_back,
    go_on,
    hint,
    open_lesson,
    read_again,
)
from playground.gui.lesson.lesson_pictures import LessonPictures
from playground.gui.state import State
from playground.gui.widget.plots import wrapped
from playground.gui.widget.theme import PALETTES
from playground.lesson.page import listed, plural
from playground.lesson.parts import Figure, Goal, Item, Question, Text, View
from playground.lesson.prose import Block, Span
from playground.lesson.script import opening

WIDTH = 430.0  # pixels, at text size 1
WIDEST = 0.4  # of the window
SETTLED = 4  # frames after which ImGui knows how far it can scroll, and where to
Rgb = tuple[float, float, float]
RIGHT: dict[str, Rgb] = {"dark": (0.52, 0.85, 0.56), "light": (0.05, 0.42, 0.14)}


def width(state: State, room: int, scale: float) -> int:
    """How much of ``room`` the lesson takes."""
    return 0 if state.lesson is None else round(min(WIDTH * scale, WIDEST * room))


def draw(state: State, pictures: LessonPictures) -> State:
    """Fill the current ImGui window."""
    course = state.lesson
    if course is None:
        return state
    state = _head(state, course)
    imgui.separator()
    if imgui.begin_child(f"step {course.step}"):  # each step scrolls by itself
        if course.error:
            state = _error(state, course)
        else:
            _heading(course, pictures)
            state = _page(state, course, pictures)
            _order(course, pictures)
    imgui.end_child()
    return state


def _head(state: State, course: Course) -> State:
    """Where we are, and the ways on, back and out."""
    step, steps = course.lesson.steps[course.step], len(course.lesson.steps)
    size = imgui.get_font_size()
    for label, do, tip in (
        ("◀##back", go_back, "the step before (Page Up)"),
        ("▶##on", go_on, "go on (Page Down)"),
    ):
        if imgui.button(label):
            state = do(state)
        imgui.set_item_tooltip(tip)
        imgui.same_line()
    number = course.lesson.number
    words = [f"lesson {number}"] if number is not None else []
    words += [f"{course.step + 1} of {steps}"]
    words += [f"{plural('slide', len(step.slides))} {listed(step.slides)}"] if step.slides else []
    words += [f"{step.minutes:g} min"] if step.minutes else []
    close = imgui.get_window_width() - 2.4 * size
    while imgui.get_cursor_pos_x() + imgui.calc_text_size(" · ".join(words)).x > close:
        words.pop()  # the button is more important
    imgui.align_text_to_frame_padding()
    imgui.text_disabled(" · ".join(words))
    imgui.same_line(close)
    if imgui.button("×##close"):
        state = close_lesson(state)
    imgui.set_item_tooltip("close the lesson; the scene stays as it is")
    return state


def _error(state: State, course: Course) -> State:
    wrapped(course.error, PALETTES[state.theme].alarm)
    if imgui.button("Read the file again"):
        state = read_again(state)
    imgui.set_item_tooltip("happens by itself when the file has changed")
    return state


def _heading(course: Course, pictures: LessonPictures) -> None:
    heading = course.lesson.steps[course.step].heading
    imgui.push_font(None, 1.2 * imgui.get_style().font_size_base)
    lesson_text.draw((Block("heading", (Span("text", heading),)),), pictures)
    imgui.pop_font()


def _page(state: State, course: Course, pictures: LessonPictures) -> State:
    """The items of the step; until it has run, the prose before its first experiment."""
    if course.page is None:
        imgui.spacing()
        lesson_text.draw(opening(course.lesson, course.step), pictures)
        imgui.spacing()
        imgui.text_disabled("the experiment of this step is running ...")
        return state
    questions = goals = 0
    for item in course.seen():
        imgui.spacing()
        if isinstance(item, Text):
            lesson_text.draw(item.blocks, pictures)
        elif isinstance(item, View):
            if item is course.view():  # not below a picture that has gone
                lesson_text.draw(item.caption, pictures, faint=True)
        elif isinstance(item, Figure):
            _figure(item, pictures)
        elif isinstance(item, Question):
            state = _question(state, course, questions, item, pictures)
            questions += 1
        else:
            state = _goal(state, course, goals, item, pictures)
            goals += 1
    imgui.spacing()
    notes = course.page.step.notes
    if notes and imgui.tree_node("for the lecturer"):
        lesson_text.draw(notes, pictures)
        imgui.tree_pop()
    return _foot(state, course)


def _order(course: Course, pictures: LessonPictures) -> None:
    """Ask for formulas before they are seen: while the next step runs, none would come."""
    for item in course.page.items if course.page else ():
        for blocks in _texts(item):
            lesson_text.order(blocks, pictures)
    if course.page is not None and len(course.pages) == course.step + 1 and not course.last:
        lesson_text.order(opening(course.lesson, course.step + 1), pictures)


def _texts(item: Item) -> tuple[tuple[Block, ...], ...]:
    """All that is to be read of an item."""
    if isinstance(item, Text):
        return (item.blocks,)
    if isinstance(item, Question):
        return (item.question, *item.choices, item.why)
    return (item.text, item.hint) if isinstance(item, Goal) else (item.caption,)


def _foot(state: State, course: Course) -> State:
    """A way on where reading ends."""
    if course.open_question is None and not course.last:
        imgui.spacing()
        if imgui.button("Go on  (Page Down)###go on", imgui.ImVec2(-1, 0)):
            state = go_on(state)
    if course.open_question is None and course.last and course.after is not None:
        imgui.spacing()
        if imgui.button("The next lesson###next lesson", imgui.ImVec2(-1, 0)):
            state = open_lesson(state, course.after)
        imgui.set_item_tooltip(course.after.stem)
    return state


def _figure(figure: Figure, pictures: LessonPictures) -> None:
    """The picture as wide as there is room, or as it is."""
    room = imgui.get_content_region_avail().x
    texture = pictures.figure(figure)
    wide = min(room, texture.width / imgui.get_io().display_framebuffer_scale.x)
    size = imgui.ImVec2(wide, wide * texture.height / texture.width)
    imgui.set_cursor_pos_x(imgui.get_cursor_pos_x() + 0.5 * (room - wide))
    imgui.image(imgui.ImTextureRef(texture.glo), size)
    if texture.width > 1.3 * wide and imgui.begin_item_tooltip():  # as large as it is
        imgui.image(imgui.ImTextureRef(texture.glo), imgui.ImVec2(texture.width, texture.height))
        imgui.end_tooltip()
    lesson_text.draw(figure.caption, pictures, faint=True)


def _question(
    state: State, course: Course, number: int, item: Question, pictures: LessonPictures
) -> State:
    """The choices to press; when one is, which is right, and why."""
    imgui.spacing()
    top = imgui.get_cursor_pos_y()
    lesson_text.draw(_after("Predict. ", item.question), pictures)
    given = course.choice(number)
    for i, choice in enumerate(item.choices):
        imgui.push_id(f"question {number} choice {i}")
        imgui.begin_disabled(given is not None)
        if imgui.radio_button("##choose", i == given):
            state = answer(state, number, i)
        imgui.end_disabled()
        imgui.same_line()
        imgui.set_cursor_pos_y(imgui.get_cursor_pos_y() + 0.1 * imgui.get_font_size())
        imgui.begin_group()
        colour = _colour(state, i, given, item)
        if colour:
            imgui.push_style_color(imgui.Col_.text, (*colour, 1.0))
        lesson_text.draw(choice, pictures)
        if colour:
            imgui.pop_style_color()
        imgui.end_group()
        if given is None and imgui.is_item_clicked():
            state = answer(state, number, i)
        imgui.pop_id()
    if given is not None:
        word = "" if given == SKIPPED else "Right. " if given == item.answer else "Not so. "
        lesson_text.draw(_after(word, item.why), pictures)
    _keep_in_sight(f"answer {number}", top, given is not None)
    return state


def _keep_in_sight(name: str, top: float, answered: bool) -> None:
    """Scroll to a question whose answer has just come, if it has come below what is seen."""
    frames, key = imgui.get_state_storage(), imgui.get_id(name)
    if not answered:
        frames.set_int(key, SETTLED)
    elif frames.get_int(key, 0) > 0:
        frames.set_int(key, frames.get_int(key, 0) - 1)
        if imgui.get_cursor_pos_y() - imgui.get_scroll_y() > imgui.get_window_height():
            imgui.set_scroll_from_pos_y(top - imgui.get_scroll_y(), 0.02)


def _colour(state: State, choice: int, given: int | None, item: Question) -> Rgb | None:
    if given is None:
        return None
    if choice == item.answer:
        return RIGHT[state.theme]
    return PALETTES[state.theme].alarm if choice == given else None


def _goal(state: State, course: Course, number: int, item: Goal, pictures: LessonPictures) -> State:
    """What to reach, whether it is, and help."""
    imgui.push_id(f"goal {number}")
    done = (course.step, number) in course.reached
    if done:
        imgui.push_style_color(imgui.Col_.text, (*RIGHT[state.theme], 1.0))
    lesson_text.draw(_after("Goal reached. " if done else "Goal. ", item.text), pictures)
    if done:
        imgui.pop_style_color()
    hinted = (course.step, number) in course.hinted
    if item.hint:
        imgui.begin_disabled(hinted)  # it stays, or a second click would meet the next button
        if imgui.button("Hint"):
            state = hint(state, number)
        imgui.end_disabled()
        imgui.same_line()
    if imgui.button("Show me"):
        state = state.with_setup(item.solution)
    imgui.set_item_tooltip("one way to reach it; Ctrl+Z comes back")
    imgui.same_line()
    if imgui.button("From the start"):
        state = replace(state, lesson=replace(course, shown=None))
    imgui.set_item_tooltip("the scene as this step shows it")
    if hinted:
        lesson_text.draw(item.hint, pictures, faint=True)
    imgui.pop_id()
    return state


def _after(word: str, blocks: tuple[Block, ...]) -> tuple[Block, ...]:
    """The blocks with a strong word before the first."""
    if not word:
        return blocks
    first = blocks[0] if blocks else Block("paragraph", ())
    return (replace(first, spans=(Span("strong", word), *first.spans)), *blocks[1:])
