"""The assignment of lesson 13: the right refraction is called right, each mistake by its name."""

import numpy as np
import pytest

from playground import locate
from playground.cli import main
from playground.lesson.assignments.refract import (
    ASSIGNMENT,
    MIRRORED,
    NEAREST,
    REFRACTION,
    STRAIGHT,
    refraction,
)
from playground.render.image_file import read_image

(TASK,) = ASSIGNMENT.tasks
RIGHT = """
import numpy as np

def refraction(normal, to_eye, index_i, index_t):
    ratio = index_i / index_t
    cos_i = normal @ to_eye
    squared = 1 - ratio ** 2 * (1 - cos_i ** 2)
    if squared < 0:
        return np.zeros(3)
    return ratio * (cos_i * normal - to_eye) - np.sqrt(squared) * normal
"""
RIGHT_GLSL = """
vec3 refraction(vec3 normal, vec3 to_eye, float index_i, float index_t) {
    float ratio = index_i / index_t, cos_i = dot(normal, to_eye);
    float squared = 1.0 - ratio * ratio * (1.0 - cos_i * cos_i);
    if (squared < 0.0) return vec3(0.0);
    return ratio * (cos_i * normal - to_eye) - sqrt(squared) * normal;
}
"""
TOTAL = "    if squared < 0:\n        return np.zeros(3)\n"
SPOILT = {  # what a student writes, and the words by which the mistake is named
    "indices": ("index_i / index_t", "index_t / index_i", REFRACTION["indices"]),
    "reversed": ("    ratio =", "    to_eye = -to_eye\n    ratio =", REFRACTION["reversed"]),
    "square": ("ratio ** 2", "ratio", REFRACTION["square"]),
    "sine": ("(1 - cos_i ** 2)", "(1 - cos_i)", REFRACTION["sine"]),
    "root": ("np.sqrt(squared)", "squared", REFRACTION["root"]),
    "total": (TOTAL, "", REFRACTION["total"]),
    "clamped": (TOTAL, "    squared = max(squared, 0)\n", REFRACTION["clamped"]),
    "along": ("ratio * (cos_i * normal", "(cos_i * normal", REFRACTION["along"]),
    "side": ("- np.sqrt", "+ np.sqrt", REFRACTION["side"]),
    "mirrored": (
        "ratio * (cos_i * normal - to_eye) - np.sqrt(squared) * normal",
        "2 * normal * cos_i - to_eye",
        MIRRORED,
    ),
    "straight": (
        "ratio * (cos_i * normal - to_eye) - np.sqrt(squared) * normal",
        "-to_eye",
        STRAIGHT,
    ),
}
WITHOUT_TOTAL = ("mirrored", "straight")  # there is no total reflection in these formulas


def checked(tmp_path, capsys, text, suffix=".py"):
    file = tmp_path / f"student{suffix}"
    file.write_text(text, encoding="utf-8")
    status = main(["lesson", "13", "--check", str(file)])
    return status, capsys.readouterr()


def test_without_mistakes_the_zoo_is_right():
    # Both are exact to a few roundings, which a root near the critical angle makes larger.
    allowed = 8 * np.finfo(float).eps / np.sqrt(NEAREST)
    np.testing.assert_allclose(refraction(*TASK.cases), TASK.right(*TASK.cases), atol=allowed)


def test_the_cases_have_what_the_mistakes_need():
    normal, to_eye, index_i, index_t = TASK.cases
    assert len(normal) == 240
    assert np.all(np.sum(normal * to_eye, axis=1) > 0)
    nothing = ~TASK.right(*TASK.cases).any(axis=1)
    assert 24 < nothing.sum() < 120  # total internal reflection
    assert 80 < np.sum(index_i < index_t) < 160


def test_no_two_mistakes_look_alike_in_the_cases():
    named = [answer(*TASK.cases) for answer in (TASK.right, *TASK.wrong.values())]
    single = [*range(len(REFRACTION) + 1), -2, -1]
    for i in single:
        for j in single:
            if i != j:
                same = np.isclose(named[i], named[j], atol=0.01, equal_nan=True)
                assert not same.all(), (i, j)


def test_the_right_answer_is_right(tmp_path, capsys):
    status, said = checked(tmp_path, capsys, RIGHT)
    assert status == 0
    assert said.out.count("right in all 240 cases") == 1
    assert "they differ by at most 0\n" in said.out or "e-" in said.out.splitlines()[-1]
    assert read_image(tmp_path / "student-check.png").size[0] > 3 * 240


@pytest.mark.parametrize("name", SPOILT)
def test_a_mistake_is_named(name, tmp_path, capsys):
    old, new, words = SPOILT[name]
    assert RIGHT.count(old) == 1
    text = RIGHT.replace(old, new)
    status, said = checked(
        tmp_path, capsys, text.replace(TOTAL, "") if name in WITHOUT_TOTAL else text
    )
    assert status == 1
    assert f"likely: {words}\n" in said.out


def test_two_mistakes_are_named_together(tmp_path, capsys):
    text = RIGHT.replace(TOTAL, "").replace("index_i / index_t", "index_t / index_i")
    _, said = checked(tmp_path, capsys, text)
    assert f"likely: {REFRACTION['indices']}; and {REFRACTION['total']}" in said.out


def test_a_mistake_that_nobody_knows_is_not_given_a_name(tmp_path, capsys):
    status, said = checked(tmp_path, capsys, RIGHT.replace("cos_i ** 2", "cos_i ** 3"))
    assert status == 1 and "likely: none of the mistakes" in said.out


def test_a_mistake_is_seen_in_the_picture():
    class Wrong:
        tolerance = 0.0

        def missing(self, name):
            return ""

        def call(self, name, arguments):
            return refraction(*arguments, wrong=["indices"])

    from playground.lesson.assignment import Right

    with np.errstate(all="ignore"):
        right, wrong = (ASSIGNMENT.picture(s).pixels for s in (Right(ASSIGNMENT), Wrong()))
    differs = np.abs(right - wrong).max(axis=2) > 0.2
    assert differs[:, :120].mean() > 0.2 and differs[:, 120:].mean() > 0.2  # of either ball
    assert not differs[0].any()  # the tiles beside them


@pytest.mark.gl
def test_glsl_is_checked_by_the_gpu(gl, tmp_path, capsys):
    status, said = checked(tmp_path, capsys, RIGHT_GLSL, ".glsl")
    assert status == 0, said.out
    text = RIGHT_GLSL.replace("index_i / index_t", "index_t / index_i")
    status, said = checked(tmp_path, capsys, text, ".glsl")
    assert status == 1 and f"likely: {REFRACTION['indices']}\n" in said.out


@pytest.mark.gl
def test_the_function_that_glsl_has_will_do(gl, tmp_path, capsys):
    head = "vec3 refraction(vec3 normal, vec3 to_eye, float index_i, float index_t) {"
    text = f"{head}\n    return refract(-to_eye, normal, index_i / index_t);\n}}\n"
    assert checked(tmp_path, capsys, text, ".glsl")[0] == 0
    _, said = checked(tmp_path, capsys, text.replace("(-to_eye", "(to_eye"), ".glsl")
    assert f"likely: {REFRACTION['reversed']}\n" in said.out


@pytest.mark.parametrize("suffix", [".py", pytest.param(".glsl", marks=pytest.mark.gl)])
def test_the_stubs_are_not_written_yet(suffix, tmp_path, capsys, request):
    if suffix == ".glsl":
        request.getfixturevalue("gl")
    stub = locate.lesson(f"assignments/refract{suffix}").read_text(encoding="utf-8")
    status, said = checked(tmp_path, capsys, stub, suffix)
    assert status == 1 and said.out.count("not written yet") == 1
