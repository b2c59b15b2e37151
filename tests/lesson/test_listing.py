"""The word `listing`: lines of a shader as they stand in its file."""

import pytest
from whole import run_whole

import playground as pg
from playground import locate
from playground.lesson import listing
from playground.lesson.parts import Text


def test_it_gives_the_lines_between_two_beginnings(capsys):
    text = listing("phong.frag", first="void main", last="}")
    assert text.startswith("void main() {\n") and text.endswith("\n}")
    assert text in locate.shader("phong.frag").read_text(encoding="utf-8")
    assert capsys.readouterr().out == f"shaders/phong.frag:\n{text}\n"


def test_without_bounds_it_is_the_file_below_its_head_of_comments():
    whole = locate.shader("colour.frag").read_text(encoding="utf-8")
    text = listing("colour.frag")
    assert text.startswith("#include") and whole.startswith("//") and whole.endswith(text + "\n")


def test_the_lines_of_a_plain_surface():
    text = listing("colour.frag", first="void main", last="}", plain=True)
    assert text.splitlines() == [
        "void main() {",
        "    vec3 shown = front_rest;",
        "    colour = present(shown);",
        "}",
    ]
    guarded = listing("lib/phong.glsl", plain=True)
    assert "#" not in guarded.replace("#include", "") and "float diffuse_factor(" in guarded


@pytest.mark.parametrize(
    ("file", "bounds", "words"),
    [
        ("nowhere.frag", {}, "there is no file"),
        ("phong.frag", {"first": "void nothing"}, "no line of shaders/phong.frag begins so"),
        ("phong.frag", {"first": "void main", "last": "in vec3 position"}, "begins so"),
    ],
)
def test_what_is_not_there_is_told(file, bounds, words):
    with pytest.raises(pg.PlaygroundError, match=words):
        listing(file, **bounds)


def test_a_lesson_says_it_as_code(own):
    file = own(
        ("half = ball", 'from playground.lesson import listing\nlisting("phong.frag")\nhalf = ball')
    )
    _, pages = run_whole(file)
    said = [item for item in pages[1].items if isinstance(item, Text)]
    blocks = [block for item in said for block in item.blocks if block.kind == "code"]
    assert len(blocks) == 1 and "void main() {" in blocks[0].text
