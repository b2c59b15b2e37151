"""The page in front of the handouts of all lessons."""

import re

import playground.lesson.command as command
from playground.cli import main
from playground.lesson.index import index
from playground.lesson.library import following, lessons, read_all
from playground.lesson.script import read_lesson


def test_it_leads_to_every_lesson_and_every_slide():
    every = read_all()
    page = index(every)
    for lesson in every:
        assert f'<a href="{lesson.path.stem}.html">' in page
        assert f"<td>{lesson.minutes:g}</td>" in page
    assert sum(lesson.minutes for lesson in every) == int(re.search(r"(\d+) minutes", page)[1])
    slides = page.split("<h2>Slides</h2>")[1]
    assert [int(n) for n in re.findall(r"<tr><td>(\d+)</td>", slides)] == list(range(1, 21))
    assert '<a href="07_specular.html#step-3">7.3</a> How fast it falls off' in slides
    assert '"07_specular-notes.html#step-3"' in index(every, notes=True)


def test_all_lessons_get_one(own, tmp_path, monkeypatch, capsys):
    file = own()
    monkeypatch.setattr(command, "lessons", lambda: [file])
    out = tmp_path / "out"
    assert main(["lesson", "all", "-o", str(out)]) == 0
    assert capsys.readouterr().out.splitlines()[-1] == str(out / "index.html")
    page = (out / "index.html").read_text(encoding="utf-8")
    links = re.findall(r'href="([^"#]+)(?:#([^"]+))?"', page)
    assert {name for name, _ in links} == {"mine.html"}
    handout = (out / "mine.html").read_text(encoding="utf-8")
    assert {place for _, place in links} - {""} == {"step-1", "step-2"}
    assert all(f'id="{place}"' in handout for _, place in links if place)


def test_one_lesson_has_none(own, tmp_path):
    out = tmp_path / "out"
    assert main(["lesson", str(own()), "-o", str(out)]) == 0
    assert not (out / "index.html").exists()


def test_a_lesson_without_slides_has_no_table_of_them(own):
    lesson = read_lesson(own(("slides=[2] ", ""), ("slides=[4, 5] ", "")))
    assert "<h2>Slides</h2>" not in index([lesson]) and "1 lesson, " in index([lesson])


def test_which_lesson_comes_next(own):
    every = lessons()
    assert [following(path) for path in every] == [*every[1:], None]
    assert following(own()) is None
