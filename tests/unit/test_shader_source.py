"""What a setup needs, and the shader text that is made of it; errors with file and line."""

from dataclasses import replace

import numpy as np
import pytest

import playground as pg
from playground.render.gl.program import Program, ShaderError, sources_for
from playground.render.gl.source import assemble, bake
from playground.render.needs import needs
from playground.render.surface import surfaces
from playground.render.view import view_of

SIZE = (48, 32)


def wanted(setup, display=False):
    everything = surfaces(setup.scene, setup.settings.weights)
    view = view_of(setup.camera, everything, SIZE)
    return needs(everything[0], view, setup.settings, display)


def test_needs_are_what_the_setup_uses():
    sphere = wanted(pg.load("sphere"))
    assert (sphere.point_lights, sphere.directional_lights, sphere.spot_lights) == (1, 0, 0)
    assert sphere.diffuse
    assert sphere.specular
    assert not (sphere.two_sided or sphere.texture or sphere.attenuation or sphere.stretched)
    assert not wanted(pg.load("yellow")).specular  # m_s is black
    dark = wanted(pg.load("sphere").with_(terms=("ambient",)))
    assert dark.point_lights == 0  # the ambient term needs no light vector
    assert wanted(pg.load("teapot")).two_sided  # an open surface
    assert wanted(pg.load("textured")).texture
    assert "1 point light" in sphere.describe()


def test_what_a_setup_does_not_need_is_not_compiled():
    for setup, absent in [
        (pg.load("teapot"), ["point_position", "attenuation(", "bilinear(", "spot_cone("]),
        (pg.load("yellow"), ["lobe(reflection", "shininess"]),
    ]:
        _, fragment = sources_for(wanted(setup))
        kept = preprocessed(fragment.text)
        main = kept[kept.index("void shade(") :]
        for words in absent:
            assert words not in main, words


def preprocessed(text):
    """What `#if NAME` and `#if NAME > 0` leave, for defines that are whole numbers."""
    values, stack, kept = {}, [], []
    for line in text.splitlines():
        words = line.split()
        live = all(stack)
        if line.startswith("#define") and live and len(words) == 3:
            values[words[1]] = int(words[2]) if words[2].isdigit() else words[2]
        elif line.startswith("#define") and live:
            values[words[1]] = 1
        elif line.startswith("#ifdef"):
            stack.append(words[1] in values)
        elif line.startswith("#ifndef"):
            stack.append(words[1] not in values)
        elif line.startswith("#if"):
            test = line[3:].replace("&&", " and ").replace("||", " or ").replace("!", " not ")
            stack.append(bool(eval(test, {}, dict(values))))
        elif line.startswith("#else"):
            stack[-1] = not stack[-1]
        elif line.startswith("#endif"):
            stack.pop()
        elif live:
            kept.append(line.split("//")[0])
    return "\n".join(kept)


def test_errors_in_shaders_name_file_and_line(tmp_path, monkeypatch):
    source = assemble("phong.frag", {})
    line = next(
        i for i, text in enumerate(source.text.splitlines(), 1) if "vec3 reflection(" in text
    )
    log = f"0:{line}(5): error: syntax error, unexpected IDENTIFIER"
    assert source.explain(log).startswith("shaders/lib/vector.glsl:")
    assert "syntax error" in source.explain(log)
    nvidia = f"0({line}) : error C0000: syntax error"
    assert source.explain(nvidia).startswith("shaders/lib/vector.glsl:")


@pytest.mark.gl
def test_a_broken_shader_is_told_by_our_file_and_line(gl):
    vertex, fragment = sources_for(wanted(pg.load("sphere")))
    broken = replace(
        fragment, text=fragment.text.replace("diffuse += diffuse_term(", "diffuse += difuse_term(")
    )
    with pytest.raises(ShaderError, match=r"shaders/shade\.glsl:\d+: "):
        Program(gl, (vertex, broken))


def test_includes_are_guarded_and_checked():
    text = assemble("phong.frag").text
    assert text.count("#ifndef INCLUDED_lib_vector_glsl") >= 2
    assert "// from: lib/phong.glsl" in text
    with pytest.raises(FileNotFoundError):
        assemble("no_such_file.frag")


def test_baking_turns_uniforms_into_constants():
    setup = pg.load("sphere")
    source = sources_for(wanted(setup))[1]
    baked = bake(source, {"shininess": 0.1, "point_diffuse": np.array([[1, 2, 3]])}).text
    assert "const float shininess = 1.00000001e-01;" in baked
    assert "const vec3 point_diffuse[POINT_LIGHTS] = vec3[1](vec3(" in baked
    assert "uniform vec3 point_specular" in baked
