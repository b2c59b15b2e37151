"""Every lesson that comes with the project: it runs, and keeps what the lecture promises."""

import ast
import re

import pytest
from whole import run_whole

from playground import locate
from playground.cli import main
from playground.lesson.library import lessons, read_all, slide_titles
from playground.lesson.page import page
from playground.lesson.parts import Figure, Goal, Question
from playground.lesson.script import read_lesson

FILES = lessons()
# The slides that each lesson is to teach; together they are all of the lecture. A lesson that is
# not written yet owes its slides; as soon as its file is there, the test asks for them.
PLAN = {
    1: {1, 2},
    2: {3},
    3: {4},
    4: {4},
    5: {5},
    6: {6},
    7: {7, 8},
    8: {9, 10},
    9: {11},
    10: {12, 14},
    11: {13},
    12: {15, 17},
    13: {16},
    14: {18},
    15: {19, 20},
    16: {2},
}
LIBRARIES = {"atexit", "math", "numpy", "playground", "shutil", "tempfile", "time"}
WORDS = {"figure", "goal", "listing", "number", "plot", "predict", "show"}


def test_the_plan_covers_the_lecture():
    titles = slide_titles(locate.lesson(""))
    assert set.union(*PLAN.values()) == set(range(1, len(titles) + 1))
    assert titles[7 - 1].startswith("Phong Lighting Model - Specular Term")


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_a_lesson_teaches_the_slides_that_are_planned(path):
    lesson = read_lesson(path)
    assert lesson.number in PLAN
    assert PLAN[lesson.number] <= set(lesson.slides) <= set(range(1, 21))
    assert 5 <= lesson.minutes <= 45
    assert all(step.minutes > 0 for step in lesson.steps)


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_a_lesson_runs_and_every_number_figure_and_goal_is_true(path):
    lesson, pages = run_whole(path)  # raises where a number, a caption or a goal is not true
    items = [item for made in pages for item in made.items]
    assert any(isinstance(item, Question) for item in items)
    assert any(isinstance(item, Goal) for item in items)
    assert any(made.step.notes for made in pages)
    figures = [item for item in items if isinstance(item, Figure)]
    assert len(figures) >= 2
    assert all(figure.codes.std() > 5 for figure in figures)  # of 255: none is empty
    made = page(lesson, pages)  # typesets every formula
    assert made.count("<figure>") == len(figures)
    assert "try this" in pages[-1].step.heading.lower()


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_a_lesson_uses_the_public_api_only(path):
    tree = ast.parse(path.read_text(encoding="utf-8"))
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            assert {alias.name for alias in node.names} <= LIBRARIES
        elif isinstance(node, ast.ImportFrom):
            assert node.module == "playground.lesson"
            assert {alias.name for alias in node.names} <= WORDS
        elif isinstance(node, ast.Attribute):
            assert not node.attr.startswith("_"), f"{path.name}:{node.lineno}"


def test_titles_and_numbers_are_told_apart():
    every = read_all()
    assert len({lesson.title for lesson in every}) == len(every)
    assert len({lesson.number for lesson in every}) == len(every)


def test_the_list_and_the_slides(capsys):
    assert main(["lesson", "list"]) == 0
    rows = capsys.readouterr().out.splitlines()
    assert len(rows) == len(lessons()) + 1 and rows[0].startswith("  1  What is illumination?")
    assert main(["lesson", "--slides"]) == 0
    rows = capsys.readouterr().out.splitlines()
    assert len(rows) == 20
    assert re.search(r"^  8  Phong .* 7\.3 How fast it falls off", rows[7])


@pytest.mark.parametrize("number", [1, 9, 11])
def test_a_lesson_without_gl_has_the_same_numbers(number, monkeypatch):
    from playground.render.gl import context

    def none():
        raise context.NoDriverError("no GL driver was found")

    monkeypatch.setattr(context, "headless", none)
    run_whole(FILES[number - 1])
