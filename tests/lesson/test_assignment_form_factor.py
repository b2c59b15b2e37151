"""The assignment of lesson 14: right is called right, in Python and GLSL, and mistakes by name."""

import numpy as np
import pytest

from playground import locate
from playground.cli import main
from playground.lesson.assignment import Right
from playground.lesson.assignments.form_factor import (
    ASSIGNMENT,
    PATCHES,
    POINTS,
    SIZE,
    TILES,
    patch_to_patch,
    point_to_point,
)
from playground.render.image_file import read_image
from playground.shading.polygon_pair import pair_form_factor

POINTS_TASK, PATCHES_TASK = ASSIGNMENT.tasks
RIGHT = """
import numpy as np

def point_to_point(x, normal_x, y, normal_y):
    v = y - x
    r = np.linalg.norm(v)
    n, m = normal_x / np.linalg.norm(normal_x), normal_y / np.linalg.norm(normal_y)
    cos_x, cos_y = n @ v / r, m @ -v / r
    return max(cos_x, 0) * max(cos_y, 0) / (np.pi * r**2)

def pieces(corner, first, second):
    places = [(k + 0.5) / 4 for k in range(4)]
    return [corner + s * first + t * second for s in places for t in places]

def patch_to_patch(corner_i, first_i, second_i, corner_j, first_j, second_j):
    n, m = np.cross(first_i, second_i), np.cross(first_j, second_j)
    area = np.linalg.norm(m) / 16
    total = 0
    for x in pieces(corner_i, first_i, second_i):
        for y in pieces(corner_j, first_j, second_j):
            total += point_to_point(x, n, y, m) * area
    return total / 16
"""
RIGHT_GLSL = """
float point_to_point(vec3 x, vec3 normal_x, vec3 y, vec3 normal_y) {
    vec3 v = normalize(y - x);
    float c = max(dot(normalize(normal_x), v), 0.0) * max(dot(normalize(normal_y), -v), 0.0);
    return c / (3.14159265358979 * dot(y - x, y - x));
}
float patch_to_patch(
    vec3 corner_i, vec3 first_i, vec3 second_i, vec3 corner_j, vec3 first_j, vec3 second_j
) {
    vec3 n = cross(first_i, second_i), m = cross(first_j, second_j);
    float sum = 0.0;
    for (int k = 0; k < 256; k++) {
        vec4 at = (vec4(k % 4, k / 4 % 4, k / 16 % 4, k / 64) + 0.5) / 4.0;
        vec3 x = corner_i + at.x * first_i + at.y * second_i;
        vec3 y = corner_j + at.z * first_j + at.w * second_j;
        sum += point_to_point(x, n, y, m);
    }
    return sum * length(m) / 256.0;
}
"""
SPOILT = {  # what a student writes, and the words by which the mistake is named
    "pi": ("/ (np.pi * r**2)", "/ r**2", POINTS["pi"]),
    "here": ("return max(cos_x, 0) * ", "return ", POINTS["here"]),
    "there": (" * max(cos_y, 0)", "", POINTS["there"]),
    "distance": ("r**2", "r", POINTS["distance"]),
    "clamp": ("max(cos_x, 0) * max(cos_y, 0)", "cos_x * cos_y", POINTS["clamp"]),
    "abs": ("max(cos_x, 0) * max(cos_y, 0)", "abs(cos_x * cos_y)", POINTS["abs"]),
    "reversed": ("m @ -v", "m @ v", POINTS["reversed"]),
    "length": ("n @ v / r, m @ -v / r", "n @ v, m @ -v", POINTS["length"]),
    "normals": (
        "normal_x / np.linalg.norm(normal_x), normal_y / np.linalg.norm(normal_y)",
        "normal_x, normal_y",
        POINTS["normals"],
    ),
    "swapped": ("n, m = normal_x", "m, n = normal_x", POINTS["swapped"]),
}
SPOILT_PATCHES = {
    "area": (" * area", "", PATCHES["area"]),
    "sum": ("return total / 16", "return total", PATCHES["sum"]),
    "other": ("norm(m) / 16", "norm(n) / 16", PATCHES["other"]),
    "corners": ("(k + 0.5) / 4", "k / 4", PATCHES["corners"]),
    "centres": (
        "    area = np.linalg.norm(m) / 16\n",
        "    return point_to_point(corner_i + (first_i + second_i) / 2, n,\n"
        "        corner_j + (first_j + second_j) / 2, m) * np.linalg.norm(m)\n",
        PATCHES["centres"],
    ),
    "half": (
        "    n, m = np.cross(first_i",
        "    first_i, second_i, first_j, second_j = (\n"
        "        2 * edge for edge in (first_i, second_i, first_j, second_j))\n"
        "    n, m = np.cross(first_i",
        PATCHES["half"],
    ),
}


def checked(tmp_path, capsys, text, suffix=".py"):
    file = tmp_path / f"student{suffix}"
    file.write_text(text, encoding="utf-8")
    status = main(["lesson", "14", "--check", str(file)])
    return status, capsys.readouterr()


def spoilt(old, new):
    assert RIGHT.count(old) == 1, old
    return RIGHT.replace(old, new)


def test_without_mistakes_the_zoo_is_right():
    made = point_to_point(*POINTS_TASK.cases)
    np.testing.assert_allclose(made, POINTS_TASK.right(*POINTS_TASK.cases), rtol=1e-12)

    # The sum over 4 x 4 pieces is off by some 1/n² of (edge / distance)², 1/16 · 1/4, at the most,
    # where all of one patch sees all of the other.
    facing = [column[:45] for column in PATCHES_TASK.cases]
    corner_i, first_i, second_i, corner_j, first_j, second_j = facing
    a, b = (
        np.stack([c, c + u, c + u + v, c + v], axis=1)
        for c, u, v in ((corner_i, first_i, second_i), (corner_j, first_j, second_j))
    )
    made = patch_to_patch(*facing)[:, 0]
    assert made.min() > 0.001
    np.testing.assert_allclose(made, pair_form_factor(a, b), rtol=1 / 64)


def test_no_two_mistakes_look_alike_in_the_cases():
    for task, named in ((POINTS_TASK, POINTS), (PATCHES_TASK, PATCHES)):
        results = [answer(*task.cases) for answer in (task.right, *task.wrong.values())]
        for i in range(len(named) + 1):
            for j in range(i):
                apart = np.abs(results[i] - results[j])
                # Three times what the arithmetic of GLSL may err, in a tenth of the cases.
                assert np.mean(apart > 3e-4) > 0.1, (task.name, i, j)


def test_the_right_answer_is_right(tmp_path, capsys):
    status, said = checked(tmp_path, capsys, RIGHT)
    assert status == 0, said.out
    assert "right in all 240 cases" in said.out and "right in all 60 cases" in said.out
    assert read_image(tmp_path / "student-check.png").size[0] > 3 * 240


def test_the_picture_shows_light_and_what_the_patches_miss_of_it():
    pixels = ASSIGNMENT.picture(Right(ASSIGNMENT)).pixels[::2, ::2, 0]
    points, patches = pixels[:, :SIZE], pixels[:, SIZE:]
    assert points.max() > 0.5 and points.min() == 0.0
    mean = points.reshape(TILES, SIZE // TILES, TILES, SIZE // TILES).mean(axis=(1, 3))
    coarse = patches[:: SIZE // TILES, :: SIZE // TILES]
    # One point stands for a lamp of 0.9 to within (0.9 / distance)² / 2; over there that is 1/4.
    assert coarse[:, -3:].max() > 0.05
    assert np.abs(mean - coarse)[:, -3:].max() < 0.25 * coarse[:, -3:].max()


@pytest.mark.parametrize("name", SPOILT)
def test_a_mistake_with_points_is_named_in_both(name, tmp_path, capsys):
    """The patches are made of points: their form factor has the same mistake."""
    old, new, words = SPOILT[name]
    status, said = checked(tmp_path, capsys, spoilt(old, new))
    assert status == 1
    first, _, second = said.out.partition("patch_to_patch: ")
    assert f"likely: {words}\n" in first
    assert f"likely: {words}\n" in second


@pytest.mark.parametrize("name", SPOILT_PATCHES)
def test_a_mistake_with_patches_is_named(name, tmp_path, capsys):
    old, new, words = SPOILT_PATCHES[name]
    status, said = checked(tmp_path, capsys, spoilt(old, new))
    assert status == 1
    assert f"likely: {words}\n" in said.out and "right in all 240 cases" in said.out


def test_two_mistakes_are_named_together(tmp_path, capsys):
    text = spoilt("(np.pi * r**2)", "(r**2)").replace("m @ -v", "m @ v")
    _, said = checked(tmp_path, capsys, text)
    assert f"likely: {POINTS['pi']}; and {POINTS['reversed']}" in said.out


def test_a_mistake_that_nobody_knows_is_not_given_a_name(tmp_path, capsys):
    status, said = checked(tmp_path, capsys, spoilt("r**2", "r**3"))
    assert status == 1 and "likely: none of the mistakes" in said.out


def test_three_numbers_are_no_form_factor(tmp_path, capsys):
    status, said = checked(tmp_path, capsys, spoilt("    return total / 16", "    return v"))
    assert status == 2 and "NameError" in said.err
    status, said = checked(tmp_path, capsys, spoilt("    return total / 16", "    return m"))
    assert status == 2 and "patch_to_patch must return one number" in said.err


@pytest.mark.gl
def test_glsl_is_checked_by_the_gpu(gl, tmp_path, capsys):
    status, said = checked(tmp_path, capsys, RIGHT_GLSL, ".glsl")
    assert status == 0, said.out
    text = RIGHT_GLSL.replace("3.14159265358979 * ", "")
    status, said = checked(tmp_path, capsys, text, ".glsl")
    assert status == 1 and said.out.count(f"likely: {POINTS['pi']}\n") == 2


@pytest.mark.parametrize("suffix", [".py", pytest.param(".glsl", marks=pytest.mark.gl)])
def test_the_stubs_are_not_written_yet(suffix, tmp_path, capsys, request):
    if suffix == ".glsl":
        request.getfixturevalue("gl")
    stub = locate.lesson(f"assignments/form_factor{suffix}").read_text(encoding="utf-8")
    status, said = checked(tmp_path, capsys, stub, suffix)
    assert status == 1 and said.out.count("not written yet") == 2
