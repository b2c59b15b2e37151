"""The setups on radiosity: made by their scripts, sound, and closed where they say so."""

import runpy

import numpy as np
import pytest

import playground as pg
from playground import locate
from playground.render.radiosity.patch.divide import divide
from playground.render.radiosity.patch.inspect import inspect

NAMES = ("cornell-box", "furnace", "facing-plates", "two-rooms", "indirect-room")


@pytest.mark.parametrize("script", ["cornell_box.py", "rooms.py"])
def test_meshes_are_what_their_script_makes(script):
    folder = locate.asset("meshes")
    made = runpy.run_path(str(folder / script))["meshes"]()
    assert made
    for name, text in made.items():
        assert (folder / name).read_text() == text


def test_the_colours_of_the_cornell_box_are_those_of_its_spectra():
    script = runpy.run_path(str(locate.asset("meshes/cornell_box.py")))
    colours = script["colours"]()
    scene = pg.load("cornell-box").scene
    paints = ("white", "white", "red", "green", "white", "white")
    for item, paint in zip(scene.objects, paints, strict=True):
        np.testing.assert_allclose(item.material.diffuse, colours[paint], atol=5e-5)
        assert item.material.ambient == item.material.diffuse
    np.testing.assert_allclose(scene.lights[0].diffuse, colours["lamp"], atol=5e-5)
    # The fit is good to a percent or so of the whole: white of constant spectrum is (1.2, .95, .91)
    flat = script["colour"](np.ones(76))
    np.testing.assert_allclose(flat, [1.2048, 0.9484, 0.9087], atol=0.02)


@pytest.mark.parametrize("patches", [1, 600])
@pytest.mark.parametrize("name", NAMES)
def test_setups_are_sound(name, patches):
    found = divide(pg.load(name).with_(patches=patches))
    assert patches == 1 or abs(len(found) - 600) < 30
    report = inspect(found)
    assert report.sound, str(report)
    assert report.closed == (name in ("furnace", "two-rooms", "indirect-room"))


def test_the_cornell_box_is_open_in_front_only():
    report = inspect(divide(pg.load("cornell-box").with_(patches=600)))
    middle = report.patches.centre[report.leaks] + report.patches.origin
    assert middle[:, 2].max() < 60.0, "the rim of the missing wall, at z = 0"
    fronts = report.patches.normal[report.facing_nothing]
    assert fronts[:, 2].max() < 0.0


def test_the_areas_of_the_cornell_box():
    found = divide(pg.load("cornell-box").with_(patches=600))
    area = np.bincount(found.owner, found.area)
    floor, back = 0.5 * (552.8 + 549.6) * 559.2, 0.5 * (549.6 + 556.0) * 548.8
    ceiling, lamp = 556.0 * 559.2 - 130.0 * 105.0, 130.0 * 105.0
    expected = {0: floor + back, 1: ceiling, 3: 548.8 * 559.2, 6: lamp}
    for owner, size in expected.items():
        assert area[owner] == pytest.approx(size, rel=1e-6)


def test_meshes_of_the_project_are_found_by_name(tmp_path):
    setup = pg.load("furnace")
    file = tmp_path / "mine.toml"
    pg.save(setup, file)
    assert 'mesh = "room.obj"' in file.read_text()
    assert pg.load(file).scene.objects == setup.scene.objects
    (tmp_path / "room.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    mesh = pg.load(file).scene.objects[0].geometry().mesh
    assert len(mesh.faces) == 1, "one that lies beside the setup comes first"
