"""Assignments: what is right is called right, and each mistake by its name."""

from pathlib import Path

import numpy as np
import pytest

from playground import locate
from playground.cli import main
from playground.lesson import student
from playground.lesson.assignments.phong import ASSIGNMENT, DIFFUSE, SPECULAR, diffuse, specular
from playground.render.image_file import read_image

DIFFUSE_TASK, SPECULAR_TASK = ASSIGNMENT.tasks
RIGHT = """
import numpy as np

def diffuse(normal, to_light, light, material):
    normal = normal / np.linalg.norm(normal)
    return max(normal @ to_light, 0) * light * material

def specular(normal, to_light, to_eye, shininess, light, material):
    normal = normal / np.linalg.norm(normal)
    r = 2 * normal * (normal @ to_light) - to_light
    return max(r @ to_eye, 0) ** shininess * light * material
"""
RIGHT_GLSL = """
vec3 diffuse(vec3 normal, vec3 to_light, vec3 light, vec3 material) {
    return max(dot(normalize(normal), to_light), 0.0) * light * material;
}
vec3 specular(vec3 normal, vec3 to_light, vec3 to_eye, float shininess, vec3 light, vec3 material) {
    vec3 r = reflect(-to_light, normalize(normal));
    return pow(max(dot(r, to_eye), 0.0), shininess) * light * material;
}
"""
UNIT = "normal = normal / np.linalg.norm(normal)\n"
SPOILT = {  # what a student writes, and the words by which the mistake is named
    "max": ("max(normal @ to_light, 0)", "(normal @ to_light)", DIFFUSE["max"]),
    "abs": ("max(normal @ to_light, 0)", "abs(normal @ to_light)", DIFFUSE["abs"]),
    "reversed": ("max(normal @ to_light", "max(normal @ -to_light", DIFFUSE["light"]),
    "sum": ("0) * light * material\n\n", "0) * (light + material)\n\n", DIFFUSE["sum"]),
    "max of r·v": ("max(r @ to_eye, 0)", "(r @ to_eye)", SPECULAR["max"]),
    "r reversed": (
        "2 * normal * (normal @ to_light) - to_light",
        "to_light - 2 * normal * (normal @ to_light)",
        SPECULAR["light"],
    ),
    "swapped": (
        "2 * normal * (normal @ to_light) - to_light",
        "2 * to_light * (normal @ to_light) - normal",
        SPECULAR["swapped"],
    ),
    "factor": (" ** shininess", " * shininess", SPECULAR["factor"]),
    "blinn": (
        "max(r @ to_eye, 0)",
        "max(normal @ (to_light + to_eye) / np.linalg.norm(to_light + to_eye), 0)",
        SPECULAR["halfway"],
    ),
}


def checked(tmp_path, capsys, text, suffix=".py"):
    file = tmp_path / f"student{suffix}"
    file.write_text(text, encoding="utf-8")
    status = main(["lesson", "7", "--check", str(file)])
    return status, capsys.readouterr()


def test_without_mistakes_the_zoo_is_right():
    for task, made in ((DIFFUSE_TASK, diffuse), (SPECULAR_TASK, specular)):
        np.testing.assert_allclose(made(*task.cases), task.right(*task.cases), rtol=1e-12)


def test_no_two_mistakes_look_alike_in_the_cases():
    for task in ASSIGNMENT.tasks:
        named = [answer(*task.cases) for answer in (task.right, *task.wrong.values())]
        singles = len(DIFFUSE if task.name == "diffuse" else SPECULAR) + 1
        for i in range(singles):
            for j in range(i):
                assert np.abs(named[i] - named[j]).max() > 0.01, (task.name, i, j)


def test_the_right_answer_is_right(tmp_path, capsys):
    status, said = checked(tmp_path, capsys, RIGHT)
    assert status == 0
    assert said.out.count("right in all 240 cases") == 2
    assert read_image(tmp_path / "student-check.png").size[0] > 3 * 120


@pytest.mark.parametrize("name", SPOILT)
def test_a_mistake_is_named(name, tmp_path, capsys):
    old, new, words = SPOILT[name]
    assert RIGHT.count(old) == 1
    status, said = checked(tmp_path, capsys, RIGHT.replace(old, new))
    assert status == 1
    assert f"likely: {words}\n" in said.out
    assert said.out.count("right in all 240 cases") == 1


def test_two_mistakes_are_named_together(tmp_path, capsys):
    text = RIGHT.replace(f"    {UNIT}    r =", "    r =").replace(
        "max(r @ to_eye, 0)", "(r @ to_eye)"
    )
    _, said = checked(tmp_path, capsys, text)
    assert f"likely: {SPECULAR['max']}; and {SPECULAR['normal']}" in said.out


def test_a_mistake_that_nobody_knows_is_not_given_a_name(tmp_path, capsys):
    status, said = checked(tmp_path, capsys, RIGHT.replace("** shininess", "** (shininess / 3)"))
    assert status == 1 and "likely: none of the mistakes" in said.out


@pytest.mark.gl
def test_glsl_is_checked_by_the_gpu(gl, tmp_path, capsys):
    status, said = checked(tmp_path, capsys, RIGHT_GLSL, ".glsl")
    assert status == 0, said.out
    status, said = checked(
        tmp_path,
        capsys,
        RIGHT_GLSL.replace("normalize(normal), to_light", "normal, to_light"),
        ".glsl",
    )
    assert status == 1 and f"likely: {DIFFUSE['normal']}\n" in said.out


@pytest.mark.gl
def test_glsl_that_does_not_compile_is_told_with_its_line(gl, tmp_path, capsys):
    status, said = checked(tmp_path, capsys, RIGHT_GLSL.replace("vec3 r =", "vec2 r ="), ".glsl")
    assert status == 2 and "student.glsl:6" in said.err


@pytest.mark.parametrize("suffix", [".py", pytest.param(".glsl", marks=pytest.mark.gl)])
def test_the_stubs_are_not_written_yet(suffix, tmp_path, capsys, request):
    if suffix == ".glsl":
        request.getfixturevalue("gl")
    stub = locate.lesson(f"assignments/phong{suffix}").read_text(encoding="utf-8")
    status, said = checked(tmp_path, capsys, stub, suffix)
    assert status == 1 and said.out.count("not written yet") == 2


@pytest.mark.parametrize(
    ("text", "line", "words"),
    [
        ("def diffuse(:\n", 1, "syntax error"),
        ("import nowhere\n", 1, "ModuleNotFoundError"),
        (RIGHT.replace("max(normal @ to_light, 0)", "maximum(normal)"), 6, "NameError"),
        (RIGHT.replace("0) * light * material\n\n", "0)\n\n"), 4, "must return a colour"),
        ("import sys\nsys.exit(3)\n", 2, "SystemExit"),
    ],
)
def test_a_file_that_fails_is_told_with_its_line(text, line, words, tmp_path, capsys):
    status, said = checked(tmp_path, capsys, text)
    assert status == 2 and f"student.py:{line}: " in said.err and words in said.err


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("while True:\n    pass\n", (1, 2)),
        (
            "def diffuse(normal, to_light, light, material):\n    while True:\n        pass\n",
            (2, 3),
        ),
    ],
)
def test_what_does_not_end_is_stopped(text, line, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(student, "PATIENCE", 1.5)  # to get as far as the loop on any machine
    status, said = checked(tmp_path, capsys, text)
    assert status == 2 and "no end after 1.5 seconds" in said.err
    assert any(f"student.py:{number}: " in said.err for number in line)


def test_a_clock_that_runs_out_just_after_the_end_interrupts_nobody(tmp_path, monkeypatch):
    clocks, interrupted = [], []

    class Clock:
        def __init__(self, _, deed):
            self.run_out = deed
            clocks.append(self)

        start = cancel = lambda self: None

    monkeypatch.setattr(student, "Timer", Clock)
    monkeypatch.setattr(student, "interrupt_main", lambda: interrupted.append(True))
    with student.limited(tmp_path / "student.py"):
        clocks[0].run_out()
        assert interrupted == [True]
    with student.limited(tmp_path / "student.py"):
        pass
    clocks[1].run_out()
    assert interrupted == [True]


@pytest.mark.gl
@pytest.mark.parametrize(
    "text",
    [
        "vec3 diffuse(vec3 normal, vec3 to_light) { return vec3(0.0); }\n",
        "vec3 diffuse(vec3 normal, vec3 to_light, vec3 light, vec3 material) { return light;\n",
    ],
)
def test_glsl_that_cannot_be_called_is_told_with_its_file(gl, text, tmp_path, capsys):
    status, said = checked(tmp_path, capsys, text, ".glsl")
    assert status == 2 and "student.glsl: diffuse(vec3, vec3, vec3, vec3) cannot be" in said.err
    assert "tail" not in said.err


def test_glsl_without_a_driver_leads_to_python(tmp_path, capsys, monkeypatch):
    from playground.render.gl import context

    def none():
        raise context.NoDriverError("no GL driver was found")

    monkeypatch.setattr(context, "headless", none)
    status, said = checked(tmp_path, capsys, RIGHT_GLSL, ".glsl")
    assert status == 2 and "Write the functions in Python" in said.err


def test_a_folder_for_the_picture_is_made(tmp_path, capsys):
    file = tmp_path / "student.py"
    file.write_text(RIGHT)
    out = tmp_path / "new" / "folder"
    assert main(["lesson", "7", "--check", str(file), "-o", str(out)]) == 0
    assert (out / "student-check.png").is_file()


@pytest.mark.parametrize("which", ["list", "all"])
def test_a_check_needs_a_lesson(which, capsys):
    assert main(["lesson", which, "--check", "mine.py"]) == 2
    assert "playground lesson 7 --check mine.py" in capsys.readouterr().err


def test_what_is_no_assignment_is_refused(tmp_path, capsys):
    assert main(["lesson", "1", "--check", "x.py"]) == 2
    assert "this lesson has no assignment" in capsys.readouterr().err
    assert main(["lesson", "7", "--check", str(Path("x.txt"))]) == 2
    assert ".py or .glsl" in capsys.readouterr().err
