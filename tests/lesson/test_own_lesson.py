"""A lesson of one's own: copied, run, shown as a page; and every mistake told with its line."""

import os
import re
import runpy
import subprocess
import sys

import pytest
from whole import run_whole

import playground as pg
from playground.cli import main
from playground.lesson.mistake import LessonError
from playground.lesson.parts import Figure, Goal, Question, Text, View
from playground.lesson.script import read_lesson


def test_it_is_read_without_being_run(own):
    lesson = read_lesson(own(("half = ball", "raise SystemExit\nhalf = ball")))
    assert lesson.title == "My own lesson" and lesson.number is None
    assert [step.heading for step in lesson.steps] == ["My own lesson", "The experiment"]
    assert lesson.minutes == 3.5 and lesson.slides == (2, 4, 5)
    assert [step.slides for step in lesson.steps] == [(2,), (4, 5)]


def test_it_runs_and_its_numbers_are_filled_in(own):
    _, pages = run_whole(own())
    kinds = [type(item) for item in pages[1].items]
    assert kinds == [Text, View, Figure, Question, Figure, Figure, View, Goal, Text]
    assert pages[1].items[-1].blocks[0].text == "It is 0.50."
    assert pages[1].step.notes[0].text == "Say it 0.5 times."
    spans = {span.kind: span.text for span in pages[1].items[0].blocks[0].spans}
    assert spans["formula"] == r"\max(n \cdot l, 0)"
    assert spans["code"] == "code" and spans["strong"] == "weight"
    live, row, curve = [item for item in pages[1].items if isinstance(item, Figure)]
    assert live.live and not row.live
    assert row.codes.shape[1] > 2 * 64 and curve.svg.startswith("<svg")


def test_it_runs_as_a_plain_script(own, capsys, monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    file = own()
    names = runpy.run_path(str(file))
    said = capsys.readouterr().out
    assert "share = 0.5" in said and "Predict: And with half the light?" in said
    assert names["ball"] == pg.load("sphere")
    assert list(tmp_path.iterdir()) == [file]  # nothing is saved


def test_the_handout_is_one_page_with_everything_in_it(own, tmp_path, capsys):
    out = tmp_path / "out"
    assert main(["lesson", str(own()), "-o", str(out)]) == 0
    said = capsys.readouterr().out.split()
    assert said == [
        str(out / name) for name in ("mine.html", *(f"mine-{i}.png" for i in (1, 2, 3)))
    ]
    page = (out / "mine.html").read_text(encoding="utf-8")
    assert "It is 0.50." in page and "Say it" not in page
    assert page.count("data:image/png;base64,") == 2 and "A line.</figcaption>" in page
    assert not re.search(r'(src|href)="(?!data:|#)', page), "it needs another file"
    assert page.count('aria-label="\\max(n \\cdot l, 0)"') == 1
    assert "<summary>the answer</summary>" in page and "diffuse_weight=0.5" in page


def test_the_lecturer_has_notes_and_answers(own, tmp_path):
    assert main(["lesson", str(own()), "-o", str(tmp_path), "--notes"]) == 0
    page = (tmp_path / "mine-notes.html").read_text(encoding="utf-8")
    assert "Say it 0.5 times." in page and "2.5 minutes" in page and "slide 4" in page
    assert ">1 minute · slide 2" in page and "slides 2, 4, 5 · 3.5 minutes" in page
    assert page.count("____ hands") == 2 and "the answer</summary>" not in page


def test_slides_of_a_folder_have_the_titles_written_there(own, tmp_path, capsys):
    (tmp_path / "slides.txt").write_text("one\ntwo\nthree\nfour\nfive\n")
    assert main(["lesson", str(own()), "--slides"]) == 0
    rows = capsys.readouterr().out.splitlines()
    assert re.fullmatch(r" +2  two +mine\.1 My own lesson", rows[1])
    assert re.fullmatch(r" +3  three +\(no lesson yet\)", rows[2])
    assert rows[3].endswith("mine.2 The experiment")


def line_of(file, words):
    rows = file.read_text(encoding="utf-8").splitlines()
    return next(i for i, row in enumerate(rows, 1) if words in row)


MISTAKES = {  # what is spoilt, the line that is to blame (by its words), what is said
    "syntax error": ("half = ball.with_(", "half = = ball.with_(", "half = =", "syntax error"),
    "exception": ("half = ball", "1 / 0\nhalf = ball", "1 / 0", "ZeroDivisionError"),
    "exit": ("half = ball", "raise SystemExit(3)\nhalf = ball", "raise System", "SystemExit: 3"),
    "unknown knob": ("diffuse_weight=0.5", "weight=0.5", "weight=0.5", "unknown quantity"),
    "wrong number": ("expected=0.5", "expected=0.6", "expected=0.6", "share is not as expected"),
    "unknown number": ("{share:.2f}", "{shore:.2f}", "{shore", "Did you mean 'share'?"),
    "bad format": ("{share:.2f}", "{share:.2q}", "{share:.2q", "cannot be written so"),
    "formula without end": (r"$\max(n \cdot l, 0)$", r"$\max(n", r"$\max", "no partner"),
    "wrong formula": (r"\max(n", r"\mux(n", r"\mux", "cannot be typeset"),
    "wrong caption": ("a.pixels.sum() > b", "a.pixels.sum() < b", "    pair,", "does not show"),
    "vacuous check": ("a.pixels.sum() > b.pixels.sum()", "True", "    pair,", "is not checked"),
    "vacuous plot": ("a[2] == 2 * a[1] > 0", "a[2] == 2 * a[1]", "plot(", "is not checked"),
    "no solution": ("    solution=ball,\n", "", "goal(", "solution"),
    "goal reached at once": ("weight >= 1", "weight > 0", "goal(", "from the start"),
    "goal out of reach": ("weight >= 1", "weight > 1", "goal(", "does not reach"),
    "answer is no choice": ('answer="half"', 'answer="all"', "predict(", "one of two or more"),
    "caption unchecked": (
        "show(half)", 'show(half, "Half.")', "show(half", "a caption needs shows="
    ),
    "no title": ("# # My own lesson", "# My own lesson", "# My own", "begins with its title"),
    "prose in the open": ("# It is", "It is", "It is {", "prose is written in comments"),
    "unknown option": ("slides=[2]", "slide=[2]", "slide=", "unknown option slide"),
    "wrong option": ("slides=[2]", "slides=[two]", "slides=[two", "cannot read slides"),
    "heading inside": ("# A formula", "# ## More\n#\n# A formula", "## More", "head of a cell"),
}  # fmt: skip


@pytest.mark.parametrize("name", MISTAKES)
def test_a_mistake_is_told_with_file_and_line(name, own, tmp_path, capsys):
    old, new, where, said = MISTAKES[name]
    file = own((old, new))
    assert main(["lesson", str(file), "-o", str(tmp_path / "out")]) == 2
    message = capsys.readouterr().err
    found = re.search(rf"{re.escape(str(file))}:(\d+): ", message)
    assert found and said in message and "Traceback" not in message
    expected = line_of(file, where)
    # Of a call in several lines, Python names the first.
    inside = file.read_text(encoding="utf-8").splitlines()[expected - 1].endswith(",")
    assert int(found[1]) == expected - inside


def test_the_command_ends_with_status_2_and_no_traceback(own):
    file = own(("half = ball", "1 / 0\nhalf = ball"))
    done = subprocess.run(
        [sys.executable, "-m", "playground", "lesson", str(file)],
        capture_output=True,
        text=True,
        check=False,
        env=os.environ | {"PYTHONPATH": pg.__path__[0] + "/.."},
    )
    assert done.returncode == 2 and "Traceback" not in done.stderr
    assert f"{file}:{line_of(file, '1 / 0')}: ZeroDivisionError" in done.stderr


def test_an_unknown_lesson_is_answered_with_those_there_are(capsys):
    assert main(["lesson", "99"]) == 2
    said = capsys.readouterr().err
    assert "there is no such lesson; got 99; allowed: 1, " in said and "(.py)" in said


def test_a_goal_that_fails_while_the_student_works_is_told(own):
    from playground.lesson.run import Running

    file = own(
        ("setup.settings.diffuse_weight >= 1", "1 / len(setup.scene.lights) and setup == ball")
    )
    running = Running(read_lesson(file))
    for _ in running.lesson.steps:
        running.step()
    assert running.reached(1, 0, pg.load("sphere"))
    with pytest.raises(LessonError, match=rf"mine.py:{line_of(file, '1 / len')}: ZeroDivision"):
        running.reached(1, 0, pg.load("sphere").with_(lights=[]))
