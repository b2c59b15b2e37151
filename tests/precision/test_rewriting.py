"""Shaders in another precision: what stands in them afterwards."""

import re
import subprocess
import sys
from types import SimpleNamespace

import numpy as np
import pytest

from playground import locate
from playground.errors import PlaygroundError
from playground.render.gl.other_precision import half_literal, in_precision
from playground.render.gl.program import check_precision, sources_for
from playground.render.gl.source import Source
from playground.render.needs import Needs
from playground.shading import arc, area_light

BEFORE = """float f(float a, vec3 v) {
    float c = a * a + 0.1;   // a comment with a * b
    c += dot(v, v);
#if X
    c *= 2.0;
#endif
    return -c / sqrt(c);
}"""


def rewritten(text, precision, name="test.glsl"):
    lines = tuple((name, i) for i in range(1, text.count("\n") + 2))
    return in_precision(Source(name, text, lines), precision, {}).text


def test_float16_rounds_every_operation():
    after = rewritten(BEFORE, "float16").splitlines()
    assert (
        after[1]
        == "    float c = rounded(rounded(a * a) + 0.0999755859375);   // a comment with a * b"
    )
    assert after[2] == "    c = rounded(c + (rounded(dot(v, v))));"
    assert after[3:6] == ["#if X", "    c = rounded(c * (2.0));", "#endif"]
    assert after[6] == "    return rounded(-c / rounded(sqrt(c)));"


def test_float64_widens_types_and_numbers():
    text = "#version 330 core\nin vec3 p;\nout vec3 q;\n" + BEFORE
    text += "\nvoid main() {\n    q = f(1, p) * p;\n    gl_Position = vec4(p, 1.0);\n}"
    after = rewritten(text, "float64").splitlines()
    assert after[1:3] == ["in vec3 p;", "out vec3 q;"]  # the rasteriser interpolates float32
    assert after[3] == "double f(double a, dvec3 v) {"
    assert after[4].startswith("    double c = a * a + 0.1lf;")
    assert after[12] == "    q = vec3(f(1, dvec3(p)) * dvec3(p));"
    assert after[13] == "    gl_Position = vec4(p, 1.0);"


@pytest.mark.parametrize("precision", ["float16", "float64"])
def test_what_cannot_be_rewritten_is_told_with_its_line(precision):
    with pytest.raises(ValueError, match=r"shaders/test\.glsl:2: '\)' expected"):
        rewritten("float f(float a) {\n    return (a + 1.0;\n}", precision)


@pytest.mark.parametrize(
    ("value", "literal"),
    [(1.17549435e-38, "6.103515625e-05"), (1e18, "65504.0"), (0.0, "0.0"), (0.25, "0.25")],
)
def test_constants_of_float16(value, literal):
    assert half_literal(value) == literal
    assert float(np.float16(float(literal))) == float(literal)


def test_native_shaders_hold_nothing_of_other_precisions():
    for shading in ("flat", "per-vertex", "per-fragment"):
        for source in sources_for(Needs(shading, point_lights=1, diffuse=True, specular=True)):
            for word in ("rounded(", "own_", "double", "dvec"):
                assert word not in source.text, (source.name, word)
            assert source.text.startswith("#version 330 core")
            assert "#define MARKS 0" in source.text


def test_native_pictures_load_nothing_of_other_precisions():
    code = (
        "import sys, playground as pg; from playground.render.gl.program import sources_for; "
        "from playground.render.needs import Needs; sources_for(Needs('per-fragment')); "
        "pg.render(pg.load('sphere'), (8, 8), renderer='numpy'); "
        "print([m for m in sys.modules if m.endswith(('other_precision', 'gl.glsl'))])"
    )
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert result.stdout.strip() == "[]", result.stderr


def test_a_driver_without_float64_is_told():
    old = SimpleNamespace(version_code=330)
    for precision in ("native", "float16"):
        check_precision(old, Needs("flat", precision=precision))
    with pytest.raises(PlaygroundError, match=r"no float64.*OpenGL 3\.3.*--renderer numpy"):
        check_precision(old, Needs("flat", precision="float64"))


@pytest.mark.parametrize("name", ["TINY", "angle_of"])
def test_an_edited_function_of_area_lights_is_the_one_that_runs(name):
    wanted = Needs("flat", area_lights=1, diffuse=True, precision="float64")
    assert f"own_{name}" in called(sources_for(wanted)[0].text)
    for file in ("lib/arc.glsl", "lib/area_light.glsl"):
        text = locate.shader(file).read_text(encoding="utf-8")
        edited = sources_for(wanted, overrides={file: text})[0].text
        here = re.search(rf"^(const )?float {name}\b", text, re.MULTILINE) is not None
        assert (f"own_{name}" in called(edited)) != here


def called(text):
    """A stage without the file of its stand-ins: what it calls."""
    return re.sub(r"// from: precision/double_area\.glsl.*?// from:", "", text, flags=re.DOTALL)


def test_limits_and_points_of_double_are_those_of_numpy():
    text = locate.shader("precision/double_area.glsl").read_text(encoding="utf-8")
    given = dict(re.findall(r"^const \w+ own_(\w+) = ([\d.]+)(?:lf)?;", text, re.MULTILINE))
    here = {"TINY": area_light.TINY, "TINY_LOBE": area_light.TINY_LOBE, "STEEP": area_light.STEEP}
    here |= {"NEGLIGIBLE": arc.NEGLIGIBLE, "ARC_POINTS": len(arc.NODES) / 2}
    assert {name: float(number) for name, number in given.items()} == here
    points = re.findall(r"dvec2\(([\d.]+)lf, ([\d.]+)lf\)", text)
    half = arc.NODES > 0
    want = np.stack([arc.NODES[half], arc.WEIGHTS[half]], axis=1)
    np.testing.assert_array_equal(np.array(points, float), want)


def test_only_area_lights_bring_what_they_take():
    for lights in (0, 1):
        wanted = Needs("flat", area_lights=lights, diffuse=True, precision="float64")
        assert ("own_angle_of" in sources_for(wanted)[0].text) == bool(lights)
