"""A lesson in the window: its steps, questions, goals, mistakes, and that nothing freezes."""

import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from playground.gui.frame import PANEL_WIDTH, between
from playground.gui.lesson.lesson_course import SHADERS, Course, open_lesson, staged
from playground.gui.panels import lesson as panel
from playground.gui.shortcuts import ACTIONS
from playground.gui.state import State
from playground.lesson.library import lessons
from playground.lesson.parts import View
from playground.lesson.run import Running
from playground.lesson.script import read_lesson
from playground.scene.library import load

TEXT = """# %% [markdown]
# # A lesson
#
# A formula: $\\\\frac{a}{b}$.

# %%
import playground as pg
from playground.lesson import figure, goal, number, predict, show

ball = pg.load("sphere")
show(ball)

# %% [markdown] slides=[3] minutes=2
# ## The second
#
# Before the question.

# %%
predict("Which?", "this", "that", answer="that", why="Because $c^2$.")
show(ball.with_(shininess=7), method="ray-tracing", beside="per-vertex")
number("seven", 7, expected=7)
pictures = [pg.render(ball, (32, 24), renderer="numpy") for _ in range(2)]
figure(pictures, "Two.", names="ab", shows=lambda a, b: a.pixels.std() > 0.01)

# %% [markdown]
# After the question: {seven:.0f}.

# %% [markdown] tags=["notes"]
# A note.

# %% [markdown]
# ## The third

# %%
show(ball.with_(shininess=10), panel="Material")
goal(
    "Shinier.",
    reached=lambda setup: setup.scene.objects[0].material.shininess > 50,
    hint="The slider.",
    solution=ball.with_(shininess=80),
)
"""


@pytest.fixture
def course(hands, tmp_path):
    """The window on a lesson in a temporary folder."""
    file = tmp_path / "mine.py"
    file.write_text(TEXT.replace("\\\\", "\\"), encoding="utf-8")
    hands.load("teapot")
    hands.window.state = open_lesson(hands.state, file)
    hands.until(lambda: hands.state.lesson.page is not None)
    yield file
    hands.window.state = replace(hands.state, lesson=None)
    hands.frames(2)


def shininess(hands):
    return hands.state.setup.scene.objects[0].material.shininess


def test_keys_lead_through_the_steps_and_set_the_scene(hands, course):
    assert hands.state.setup == load("sphere")
    hands.key("page_up")
    assert hands.state.message == "this is the first step" and hands.state.lesson.step == 0
    hands.key("page_down")
    hands.until(lambda: hands.state.lesson.page is not None)
    assert hands.state.lesson.step == 1
    assert hands.state.setup == load("sphere")  # the question hides what comes after it
    hands.key("page_down")  # on without an answer
    hands.frames(2)
    assert hands.state.lesson.step == 1 and shininess(hands) == 7
    assert (hands.state.method, hands.state.other) == ("ray-tracing", "per-vertex")
    assert hands.state.layout == "side by side"
    hands.key("page_down")
    hands.until(lambda: hands.state.lesson.page is not None)
    assert (hands.state.method, hands.state.layout) == ("raster", "single")
    assert shininess(hands) == 10
    hands.key("page_down")
    assert hands.state.message == "this is the last step"
    hands.key("page_up")
    hands.frames(2)
    assert hands.state.lesson.step == 1 and shininess(hands) == 7
    hands.key("l", "ctrl")
    assert hands.state.lesson is None and shininess(hands) == 7
    before = hands.state.setup.camera
    hands.key("page_up")
    assert hands.state.setup.camera != before  # without a lesson the key moves the camera


def test_a_step_is_a_step_of_undo(hands, course):
    hands.key("z", "ctrl")
    assert hands.state.setup.name == "teapot" and hands.state.lesson is not None


def test_an_answer_is_given_by_the_mouse_and_opens_the_rest(hands, course):
    hands.key("page_down")
    hands.until(lambda: hands.state.lesson.page is not None)
    kinds = [type(item).__name__ for item in hands.state.lesson.seen()]
    assert kinds == ["Text", "Question"]
    press(hands, "question 0 choice 0/##choose", "step 1")
    assert hands.state.lesson.choice(0) == 0
    kinds = [type(item).__name__ for item in hands.state.lesson.seen()]
    assert kinds == ["Text", "Question", "View", "Figure", "Text"]
    assert hands.state.lesson.seen()[-1].blocks[0].text == "After the question: 7."
    press(hands, "###go on", "step 1")
    assert hands.state.lesson.step == 2


def press(hands, label, child):
    """Press what stands still: a formula that arrives moves all below it."""
    pictures = hands.window.slots.lesson
    hands.until(lambda: pictures.wanted() is None and not hands.window.lesson.coming)

    def script(c):
        tests = hands.imgui.test_engine
        c.set_ref(tests.TestRef(c.window_info(f"//Lesson/{child}").window.id_))
        c.item_click(label)
        c.yield_(2)

    hands.do(script)


def at_goal(hands):
    hands.window.state = replace(hands.state, lesson=replace(hands.state.lesson, step=2))
    hands.until(lambda: hands.state.lesson.page is not None)


def test_a_goal_is_seen_to_be_reached_by_the_student(hands, course):
    at_goal(hands)
    hands.frames(5)
    assert not hands.state.lesson.reached
    hands.window.state = hands.state.with_setup(hands.state.setup.with_(shininess=60))
    hands.until(lambda: (2, 0) in hands.state.lesson.reached)
    assert hands.state.message == "goal reached" and shininess(hands) == 60


def test_hint_solution_and_start_are_a_click_away(hands, course):
    at_goal(hands)
    press(hands, "goal 0/Hint", "step 2")
    assert hands.state.lesson.hinted == {(2, 0)}
    press(hands, "goal 0/Hint", "step 2")  # it is still there, and does nothing
    assert shininess(hands) == 10
    press(hands, "goal 0/Show me", "step 2")
    assert shininess(hands) == 80
    hands.until(lambda: (2, 0) in hands.state.lesson.reached)
    press(hands, "goal 0/From the start", "step 2")
    hands.frames(2)
    assert shininess(hands) == 10


def test_the_last_step_leads_to_the_next_lesson(hands, course):
    at_goal(hands)
    assert hands.state.lesson.after is None  # behind a lesson of one's own there is none
    hands.window.state = open_lesson(hands.state, "1")
    assert hands.state.lesson.after == lessons()[1]
    at_goal(hands)
    last = replace(hands.state.lesson, step=len(hands.state.lesson.lesson.steps) - 1)
    page = replace(last.pages[2], items=())  # as if it had run
    pages = (*last.pages, *[page] * (last.step + 1 - len(last.pages)))
    hands.window.state = replace(hands.state, lesson=replace(last, pages=pages))
    press(hands, "###next lesson", f"step {last.step}")
    assert hands.state.lesson.lesson.path == lessons()[1] and hands.state.lesson.step == 0


def test_formulas_and_figures_are_drawn(hands, course):
    pictures = hands.window.slots.lesson
    hands.until(lambda: pictures.wanted() is None and not hands.window.lesson.coming)
    before = lesson_pixels(hands)
    letters = pictures.formula(r"\frac{a}{b}", max(k.size for k in pictures._formulas))
    assert letters is not None and letters.height > 15
    pictures._formulas.clear()  # as it was before the formula came: its source is shown
    pictures.wanted, kept = lambda: None, pictures.wanted
    hands.frames(2)
    assert np.abs(lesson_pixels(hands) - before).max() > 100
    pictures.wanted = kept
    hands.until(lambda: pictures.wanted() is None and not hands.window.lesson.coming)
    assert np.array_equal(lesson_pixels(hands), before)


def test_a_formula_behind_a_question_is_there_before_the_answer(hands, course):
    hands.key("page_down")
    formulas = hands.window.slots.lesson._formulas
    ran: list[int] = []  # pages that were there in each frame

    def arrived():
        ran.append(len(hands.state.lesson.pages))
        return any(key.formula == "c^2" for key in formulas)

    hands.until(arrived)
    assert hands.state.lesson.step == 1 and hands.state.lesson.open_question == 0
    assert ran[-1] == 2  # the next step runs after it


def lesson_pixels(hands):
    x, _, _, _ = hands.window.view_box()
    return hands.window.pixels((0, 60, x, 500)).astype(float)


def test_the_view_makes_room(hands, course):
    x, _, width, _ = hands.window.view_box()
    wide = panel.width(hands.state, 1280, 1.0)
    lesson, controls = between(wide, round(PANEL_WIDTH), 1280, 1.0)
    assert wide == 430 and x == lesson and width == 1280 - lesson - controls
    hands.window.state = replace(hands.state, lesson=None)
    hands.frames(2)
    assert hands.window.view_box()[0] == 0
    assert hands.window.view_box()[2] == 1280 - PANEL_WIDTH


def test_a_saved_change_is_read_at_once_and_the_step_stays(hands, course):
    at_goal(hands)
    course.write_text(course.read_text().replace("shininess=10", "shininess=11"))
    hands.window.lesson._looked = 0.0
    hands.until(lambda: shininess(hands) == 11)
    assert hands.state.lesson.step == 2


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("ball = pg", "ball = = pg", "syntax error"),
        ("ball = pg", "1 / 0\nball = pg", "ZeroDivisionError"),
        ("ball = pg", "import os; os._exit(3)\nball = pg", "ended by itself"),
        ("# # A lesson", "# A lesson", "begins with its title"),
    ],
)
def test_a_bad_lesson_is_told_and_the_window_lives(hands, course, old, new, words):
    good = course.read_text()
    course.write_text(good.replace(old, new))
    hands.window.lesson._looked = 0.0
    hands.until(lambda: hands.state.lesson.error)
    assert words in hands.state.lesson.error
    hands.frames(3)
    hands.key("v")
    assert hands.state.setup.settings.shading == "per-vertex"
    course.write_text(good)
    hands.window.lesson._looked = 0.0
    hands.until(lambda: hands.state.lesson.page is not None)
    assert hands.state.lesson.error == ""


def test_a_cell_without_an_end_freezes_nothing(hands, course):
    course.write_text(TEXT.replace("ball = pg", "while True: pass\nball = pg"))
    hands.window.lesson._looked = 0.0
    hands.until(lambda: hands.state.lesson.page is None)
    process = hands.window.lesson._process._process
    hands.frames(10)
    assert hands.state.lesson.page is None and process.poll() is None
    hands.key("l", "ctrl")
    hands.frames(2)
    assert process.poll() is not None  # the process is gone


def test_the_menu_lists_the_lessons_and_opens_them(hands):
    path = lessons()[-1]
    lesson = read_lesson(path)
    name = f"{lesson.number}  {lesson.title}"
    hands.do(lambda c: c.menu_click(f"//##MainMenuBar/Lessons/{name}"))
    assert hands.state.lesson.lesson.path == path
    hands.do(lambda c: (c.menu_click("//##MainMenuBar/Lessons/Close the lesson"), c.yield_(2)))
    assert hands.state.lesson is None


def test_every_control_of_the_lesson_is_known(hands, course):
    hands.key("page_down")
    hands.until(lambda: hands.state.lesson.page is not None)
    found = {}

    def script(c):
        engine = hands.imgui.test_engine
        items = engine.TestItemList()
        c.gather_items(items, "//Lesson", -1)
        for i in range(items.get_size()):
            number = items[i].id_
            c.item_info(engine.TestRef(number))
            found[number] = engine.find_item_debug_label(c.ui_context, number)

    hands.do(script)
    assert sorted(filter(None, found.values())) == [
        "##choose", "##choose", "for the lecturer", "×##close", "▶##on", "◀##back",
    ]  # fmt: skip


def test_a_lesson_that_is_none_is_refused(hands, tmp_path):
    (tmp_path / "no.py").write_text("x = 1\n")
    before = hands.state
    hands.window.state = open_lesson(before, tmp_path / "no.py")
    assert hands.state.failed and "begins with its title" in hands.state.message
    assert hands.state.lesson is None


@pytest.mark.parametrize("path", lessons(), ids=lambda path: path.stem)
def test_every_view_of_a_lesson_can_be_set(path):
    """What show() asks of the window, the window has: method, layout, panel, other shading."""
    from playground.gui.panels import PANELS

    running = Running(read_lesson(path), live=True)
    for step in range(len(running.lesson.steps)):
        running.step()
        course = Course(running.lesson, step, tuple(running.pages))
        for view in [item for item in course.page.items if isinstance(item, View)]:
            assert view.panel in ("", SHADERS, *PANELS)
            page = replace(course.page, items=(view,))
            here = replace(course, pages=(*course.pages[:step], page))
            state = staged(replace(State(), lesson=here))
            assert not state.failed and state.setup == view.setup


def test_what_keys_do_without_a_lesson():
    state = State()
    for action in ACTIONS:
        if action.menu == "Lessons":
            assert action.do(state) is state


def test_no_window_gives_the_handout(monkeypatch, tmp_path, capsys):
    from playground.cli import main

    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    monkeypatch.setattr("sys.platform", "linux")
    monkeypatch.chdir(tmp_path)
    shutil.copy(lessons()[0], tmp_path / "copy.py")
    assert main(["--lesson", "copy.py"]) == 0
    said = capsys.readouterr()
    assert "no display" in said.err and Path("copy.html").is_file()
    assert main(["--lesson", "99"]) == 2
    assert "there is no such lesson" in capsys.readouterr().err
