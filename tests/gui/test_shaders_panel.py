"""The shaders in the window: what is shown is what runs, and typing changes the picture."""

from dataclasses import replace

import numpy as np
import pytest

from playground import locate
from playground.gui.shader import twins
from playground.gui.state import State, start
from playground.scene.library import load

pytestmark = pytest.mark.gl


def texts(name):
    return locate.shader(name).read_text(encoding="utf-8")


def with_text(hands, file, text):
    from playground.gui.shader.shader_edit import edited

    hands.window.state = edited(hands.window.state, file, text)
    hands.frames(3)


@pytest.mark.parametrize("shading", ["flat", "per-vertex", "per-fragment"])
def test_the_files_shown_are_the_ones_that_run(window, shading):
    from playground.gui.shader.shader_edit import running
    from playground.render.gl.program import STAGES

    files = running(start(load("teapot").with_(shading=shading)))
    assert files[:2] == STAGES[shading]
    assert "shade.glsl" in files and "lib/phong.glsl" in files
    assert not any("texture" in file for file in files)
    assert len(set(files)) == len(files)


def test_an_edit_draws_another_picture_and_revert_the_old_one(hands, window):
    from playground.gui.shader.shader_edit import reverted

    before = hands.pixels()
    with_text(hands, "present.glsl", texts("present.glsl").replace("shown", "shown.bgr", 1))
    text = texts("colour.frag")
    hands.key("v")
    hands.load("teapot", shading="per-vertex")
    with_text(hands, "colour.frag", text.replace("present(shown)", "vec4(1.0, 0.0, 0.0, 1.0)"))
    seen = hands.pixels()
    assert not hands.state.shader_error
    red = (seen == (255, 0, 0)).all(axis=-1)
    assert red.mean() > 0.05
    window.state = reverted(hands.state)
    window.state = replace(window.state, setup=load("teapot"))
    hands.frames(3)
    np.testing.assert_array_equal(hands.pixels(), before)


def test_a_broken_shader_keeps_the_last_good_one_and_says_where(hands, window):
    good = texts("shade.glsl").replace("diffuse = vec3(0.0);", "diffuse = vec3(0.25);")
    with_text(hands, "shade.glsl", good)
    last = hands.pixels()
    line = good.splitlines().index("    rest = constant_terms;") + 1
    with_text(hands, "shade.glsl", good.replace("    rest = constant_terms;", "    rest = oops;"))
    assert f"shaders/shade.glsl:{line}: " in hands.state.shader_error
    assert "oops" in hands.state.shader_error
    np.testing.assert_array_equal(hands.pixels(), last)
    hands.drag((460, 350), (560, 380))  # the camera still moves, with the last good program
    assert not np.array_equal(hands.pixels(), last)
    hands.frames(20)  # and a still scene too, when colours become constants
    assert f"shaders/shade.glsl:{line}: " in hands.state.shader_error
    with_text(hands, "shade.glsl", good)
    assert hands.state.shader_error == ""


def test_edits_outlive_a_broken_include_and_are_never_in_the_setup(hands):
    setup = hands.state.setup
    with_text(hands, "phong.frag", '#include "nowhere.glsl"\n' + texts("phong.frag"))
    assert "shaders/phong.frag:1" in hands.state.shader_error
    assert hands.state.setup is setup
    with_text(hands, "phong.frag", '#include "phong.frag"\n')
    assert "includes itself" in hands.state.shader_error
    with_text(hands, "phong.frag", '#include "shade.glsl" oops;\n')
    assert hands.state.shader_error.startswith("shaders/phong.frag:1: an include is")


def test_shaders_that_compile_but_cannot_be_fed_give_way_too(hands):
    before = hands.pixels()
    text = texts("shade.glsl").replace("= constant_terms;", "= constant_terms.xyz;")
    with_text(hands, "shade.glsl", text)
    assert not hands.state.shader_error
    surface = texts("interface/surface.glsl")
    wide = surface.replace("vec3 constant_terms", "vec4 constant_terms")
    assert wide != surface
    with_text(hands, "interface/surface.glsl", wide)
    assert "cannot be drawn with" in hands.state.shader_error
    np.testing.assert_array_equal(hands.pixels(), before)
    hands.frames(12)
    with_text(hands, "interface/surface.glsl", surface)
    assert not hands.state.shader_error
    vertex = texts("phong.vert").replace("in vec3 object_position", "in vec4 object_position")
    with_text(hands, "phong.vert", vertex.replace("vec4(object_position, 1.0)", "object_position"))
    hands.frames(12)
    assert hands.pixels().std() > 1.0


def test_typing_into_the_box_edits_the_file(hands, window):
    hands.key("f4")
    assert hands.state.shaders and hands.state.code_file in ("shade.glsl", "phong.vert")
    hands.frames(5)
    assert not hands.state.edits  # showing a file does not change it
    view = window.view_box()
    low = 720 - 60
    hands.click(view[2] * 0.3, (view[1] + view[3] + low) / 2 + 40)
    hands.io.add_input_characters_utf8("q")
    hands.frames(3)
    assert [file for file, _ in hands.state.edits] == [hands.state.code_file]
    text = dict(hands.state.edits)[hands.state.code_file]
    assert len(text) == len(texts(hands.state.code_file)) + 1
    hands.key("f4")
    assert not hands.state.shaders


@pytest.mark.parametrize("name", ["teapot", "sphere"])
def test_both_views_and_every_twin_are_drawn(hands, window, name):
    from playground.gui.state import TWINS

    hands.load(name)
    window.state = replace(window.state, shaders=True)
    for view in ("files", "move the code"):
        for twin in TWINS:
            window.state = replace(window.state, code_view=view, twin=twin)
            for file in ("shade.glsl", "lib/phong.glsl", "present.glsl"):
                window.state = replace(window.state, code_file=file)
                hands.frames(2)
                assert not hands.state.edits and not hands.state.failed


def test_every_twin_named_exists():
    from playground.gui.shader.twins import twin_of

    assert twin_of("lib/phong.glsl", "NumPy").name == "phong.py"
    assert twin_of("shade.glsl", "NumPy").name == "shade.py"
    assert twin_of("phong.frag", "HLSL").name == "phong_per_fragment.hlsl"
    assert twin_of("gouraud.vert", "Cg").name == "phong_per_vertex.cg"
    assert twin_of("lib/power.glsl", "Cg").name == "phong.cg"
    assert twin_of("present.glsl", "HLSL") is None
    assert twin_of("flat.vert", "NumPy") is None


def test_the_call_of_the_model_is_found_in_each_stage():
    from playground.gui.shader.shader_edit import calls, includes

    for file, word in (("gouraud.vert", "emit_colours("), ("phong.frag", "shade(")):
        text = texts(file)
        lines = calls(text)
        assert len(lines) == 1 and word in text.splitlines()[lines[0] - 1]
        assert includes(text)


def test_a_file_that_changes_on_disk_is_read_again(tmp_path, monkeypatch):
    import shutil

    from playground.gui.shader import shader_edit

    shutil.copytree(locate.shader(""), tmp_path / "shaders")
    monkeypatch.setattr(shader_edit.locate, "shader", lambda name: tmp_path / "shaders" / name)
    monkeypatch.setattr(shader_edit, "PAUSE", 0.0)
    watch = shader_edit.Watch()
    assert watch.changed() == () and not watch.due()
    path = tmp_path / "shaders" / "lib" / "phong.glsl"
    path.write_text(path.read_text(encoding="utf-8") + "// more\n", encoding="utf-8")
    assert watch.due()
    ((file, text),) = watch.changed()
    assert file == "lib/phong.glsl" and text.endswith("// more\n")
    state = shader_edit.reloaded(State(), ((file, text),))
    assert shader_edit.overrides(state) == {file: text}
    assert shader_edit.text_of(state, file) == text
    mine = shader_edit.edited(state, file, "mine")
    again = shader_edit.reloaded(mine, ((file, "theirs"),))
    assert shader_edit.text_of(again, file) == "mine" and "revert" in again.message
    assert shader_edit.text_of(shader_edit.reverted(again, file), file) == "theirs"
    assert watch.changed() == ()


def test_a_long_twin_is_shown_where_it_meets_the_shader():
    def led_to(file, language):
        text, path = locate.shader(file).read_text(), twins.twin_of(file, language)
        lines = twins.first_shared(text, twins.twin_text(path))
        return [twins.twin_text(path).splitlines()[line - 1] for line in lines]

    assert led_to("shade.glsl", "NumPy") == ["def shade("]
    assert led_to("lib/phong.glsl", "Cg") == [
        "float diffuse_factor(float3 normal, float3 to_light) {"
    ]
    assert led_to("lib/phong.glsl", "NumPy") == []  # it begins near the top, below its formula
