"""Setups: frozen values, `with_`, assignments, files that keep their comments."""

import dataclasses

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import playground as pg
from playground.scene.assign import assign, parse_light, read
from playground.scene.knob import Knob, knobs
from playground.scene.light import LIGHTS
from playground.scene.setup_file import format_setup, parse_setup
from playground.scene.table import from_table, to_table

DECLARED = [
    pg.Settings,
    pg.Camera,
    pg.Material,
    pg.Object,
    pg.Scene,
    pg.Transform,
    *LIGHTS.values(),
]


def test_the_library_has_what_the_lecture_needs():
    assert len(pg.library()) >= 8
    for name in pg.library():
        setup = pg.load(name)
        assert setup.scene.title, name
        assert setup.name == name


def test_a_setup_never_changes():
    setup = pg.load("teapot")
    changed = setup.with_(shading="flat", shininess=5, terms=("diffuse",), eye=(0, 0, 9))
    assert setup.settings.shading == "per-fragment"
    assert changed.settings.shading == pg.Shading.FLAT
    assert changed.scene.objects[0].material.shininess == 5
    assert changed.camera.eye == (0, 0, 9)
    with pytest.raises(dataclasses.FrozenInstanceError):
        setup.name = "other"
    assert hash(setup.settings) == hash(pg.load("teapot").settings)


@pytest.mark.parametrize("declared", DECLARED, ids=lambda d: d.__name__)
def test_every_knob_explains_itself_and_accepts_its_default(declared):
    for name, knob in knobs(declared).items():
        assert knob.help or name == "title", f"{declared.__name__}.{name}"
        assert knob.check(knob.default, name) == knob.default
        assert knob.allowed


@pytest.mark.parametrize("declared", DECLARED, ids=lambda d: d.__name__)
def test_every_knob_refuses_what_it_must(declared):
    for name, knob in knobs(declared).items():
        bad = {
            "number": [float("nan"), float("inf"), "x", None, True, knob.high * 2 + 1],
            "integer": [1.5, "x", True],
            "switch": [1, "yes", None],
            "choice": ["no such name", 3],
            "names": [["no such name"], 3],
            "colour": [(1, 2), (1, 2, -1), (1, 2, float("nan")), "red", 7],
            "vector": [(1, 2), (1, 2, "x"), (1, 2, float("inf")), 7],
            "vertices": [7, "0,0,0", [(0, 0, 0)] * 2, [(0, 0, 0)] * 17, [(0, 0)] * 3],
            "text": [3, None],
        }[knob.kind]
        for value in bad:
            with pytest.raises(pg.PlaygroundError) as caught:
                knob.check(value, f"here.{name}")
            assert "here." in str(caught.value)


def test_numpy_values_are_welcome():
    import numpy as np

    setup = pg.load("sphere").with_(shininess=np.float32(7), eye=np.array([1, 2, 3]))
    assert setup.scene.objects[0].material.shininess == 7.0
    assert setup.camera.eye == (1.0, 2.0, 3.0)


@pytest.mark.parametrize(
    ("assignment", "check"),
    [
        ("shininess=80", lambda s: s.scene.objects[0].material.shininess == 80),
        ("light.0.diffuse=1,0.5,0", lambda s: s.scene.lights[0].diffuse == (1, 0.5, 0)),
        ("object.0.transform.scale=[1, -2, 3]",
         lambda s: s.scene.objects[0].transform.scale == (1, -2, 3)),
        ("object.0.material.shininess=5", lambda s: s.scene.objects[0].material.shininess == 5),
        ("gate=on", lambda s: s.settings.gate),
        ("settings.clamp=false", lambda s: not s.settings.clamp),
        ("terms=diffuse, ambient", lambda s: s.settings.terms == ("diffuse", "ambient")),
        ("camera.eye=0,0,4", lambda s: s.camera.eye == (0, 0, 4)),
        ("background=0,0,0", lambda s: s.scene.background == (0, 0, 0)),
        ("tessellation=4", lambda s: s.scene.objects[0].tessellation == 4),
    ],
)  # fmt: skip
def test_assignments(assignment, check):
    assert check(assign(pg.load("teapot"), assignment))


def test_a_light_in_one_line():
    spot = parse_light("spot position=1,2,3 axis=0,-1,0 inner_angle=5 outer_angle=6 attenuate=on")
    assert spot == pg.SpotLight(
        position=(1, 2, 3), axis=(0, -1, 0), inner_angle=5, outer_angle=6, attenuate=True
    )


def test_read_turns_text_into_values():
    assert read(Knob("vector", (0, 0, 0)), "1, 2,3", "v") == (1, 2, 3)
    assert read(Knob("switch", False), "Off", "s") is False
    with pytest.raises(pg.PlaygroundError):
        read(Knob("switch", False), "maybe", "s")


@pytest.mark.parametrize("name", pg.library())
def test_files_go_there_and_back(name, tmp_path):
    setup = pg.load(name)
    pg.save(setup, tmp_path / f"{name}.toml")
    assert pg.load(tmp_path / f"{name}.toml") == setup
    assert from_table(to_table(setup), name) == setup


HAND_WRITTEN = """\
# my scene
[scene]
title = "mine"   # a title

# the sun
[[light]]
type = "directional"
to_light = [0.0, 1.0, 0.0]  # noon

[[object]]
mesh = "torus"
"""


def test_comments_of_a_hand_written_file_survive(tmp_path):
    file = tmp_path / "mine.toml"
    file.write_text(HAND_WRITTEN)
    setup = pg.load(file).with_(shininess=80)
    setup = setup.with_(lights=(*setup.scene.lights, pg.PointLight(position=(1, 1, 1))))
    pg.save(setup, file)
    text = file.read_text()
    for comment in ("# my scene", "# a title", "# the sun", "# noon"):
        assert comment in text
    assert pg.load(file) == setup
    pg.save(setup.with_(lights=()), file)
    assert pg.load(file).scene.lights == ()


vectors = st.tuples(*[st.floats(-1e6, 1e6, allow_nan=False)] * 3)
colours = st.tuples(*[st.floats(0, 100, allow_nan=False)] * 3)


@settings(max_examples=60, deadline=None)
@given(colours, vectors, st.floats(0, 1e6), st.sampled_from(["flat", "per-vertex"]), st.booleans())
def test_any_setup_survives_its_file(colour, vector, shininess, shading, switch):
    light = pg.PointLight(diffuse=colour, position=vector, attenuate=switch)
    item = pg.Object(
        "box",
        material=pg.Material(shininess=shininess, ambient=colour),
        transform=pg.Transform(translate=vector),
    )
    setup = pg.Setup(pg.Scene(objects=(item, item), lights=(light, pg.DirectionalLight())))
    setup = setup.with_(shading=shading, gate=switch, background=colour)
    assert parse_setup(format_setup(setup), "untitled") == setup


def test_a_mesh_made_in_python_cannot_be_saved_but_can_be_drawn(tmp_path):
    mesh = pg.Mesh.create([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    setup = pg.Setup(pg.Scene(objects=(pg.Object(arrays=mesh),))).framed()
    with pytest.raises(pg.PlaygroundError, match=r"\.ply"):
        pg.save(setup, tmp_path / "a.toml")
    image = pg.render(setup, (32, 24), "numpy")
    assert image.coverage.any()
    image.save(tmp_path / "a.png")
    with pytest.raises(pg.PlaygroundError, match="carries no setup"):
        pg.load(tmp_path / "a.png")


def test_framing_shows_everything():
    objects = tuple(
        pg.Object("sphere", transform=pg.Transform(translate=(x, 3, -x), size=2)) for x in (-5, 9)
    )
    setup = pg.Setup(pg.Scene(objects=objects)).framed((1, 0.5, 1))
    image = pg.render(setup, (64, 64), "numpy")
    edge = (*image.coverage[0], *image.coverage[-1], *image.coverage[:, 0], *image.coverage[:, -1])
    assert image.coverage.mean() > 0.005
    assert not any(edge)


def test_errors_have_four_parts():
    with pytest.raises(pg.PlaygroundError) as caught:
        pg.SpotLight(inner_angle=40, outer_angle=30)
    error = caught.value
    assert "inner_angle" in error.what
    assert "40 > 30" in str(error.got)
    assert "Swap" in error.fix
    with pytest.raises(pg.PlaygroundError, match="Did you mean 'teapot'"):
        pg.load("teapod")
    with pytest.raises(pg.PlaygroundError, match="divides by zero"):
        pg.PointLight(attenuate=True, constant=0, linear=0, quadratic=0)


WRONG_KINDS = {
    "scene": lambda s: s.with_(scene=5),
    "camera": lambda s: s.with_(camera=None),
    "settings": lambda s: s.with_(settings="flat"),
    "name": lambda s: s.with_(name=3),
    "lights": lambda s: s.with_(lights=5),
    "one light": lambda s: s.with_(lights=pg.PointLight()),
    "objects": lambda s: s.with_(objects=[pg.Scene()]),
    "material": lambda s: pg.Object(material=5),
    "transform": lambda s: pg.Object(transform=5),
    "arrays": lambda s: pg.Object(arrays=5),
    "load": lambda s: pg.load(None),
    "save": lambda s: pg.save(s, None),
    "null": lambda s: pg.Object("a\0.obj"),
    "endless": lambda s: s.with_(fov=10**5000),
    "array for a choice": lambda s: s.with_(shading=[1, 2]),
}


@pytest.mark.parametrize("case", WRONG_KINDS)
def test_a_value_of_the_wrong_kind_is_a_clear_error(case):
    with pytest.raises(pg.PlaygroundError) as caught:
        WRONG_KINDS[case](pg.load("sphere"))
    assert caught.value.got is not None


def test_a_single_light_is_told_to_stand_in_a_list():
    with pytest.raises(pg.PlaygroundError, match=r"Write lights=\[light\]"):
        pg.load("sphere").with_(lights=pg.PointLight())
