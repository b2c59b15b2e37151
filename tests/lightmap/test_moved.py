"""A folder with a setup, its lightmap and a picture of it can be moved: each finds the others."""

import numpy as np
import pytest

import playground as pg
from playground.render.lightmap.bake import bake

SIZE = (24, 18)


@pytest.fixture
def folder(tmp_path):
    """A folder with a setup, its picture, and one floor down their lightmap."""
    here = tmp_path / "here"
    (here / "baked").mkdir(parents=True)
    setup = pg.load("furnace").with_(patches=24)
    bake(pg.radiosity(setup, "numpy"), 32, 0).save(here / "baked" / "a.npz")
    lit = setup.with_(lightmap=str(here / "baked" / "a.npz"))
    pg.save(lit, here / "a.toml")
    pg.render(lit, SIZE, "numpy", "lightmap").save(here / "a.png")
    return here


def test_no_file_of_the_folder_names_the_place_it_was_made_at(folder):
    assert 'lightmap = "baked/a.npz"' in (folder / "a.toml").read_text(encoding="utf-8")
    assert str(folder).encode() not in (folder / "a.png").read_bytes()


@pytest.mark.parametrize("name", ["a.toml", "a.png"])
def test_moved_together_they_draw_the_same_picture(folder, name):
    before = pg.render(pg.load(folder / name), SIZE, "numpy", "lightmap")
    there = folder.rename(folder.parent / "there")
    setup = pg.load(there / name)
    assert setup.scene.lightmap == str(there / "baked" / "a.npz")
    after = pg.render(setup, SIZE, "numpy", "lightmap")
    np.testing.assert_array_equal(after.pixels, before.pixels)


def test_a_picture_elsewhere_finds_the_lightmap_where_it_is(folder):
    setup = pg.load(folder / "a.toml")
    elsewhere = folder.parent / "elsewhere"
    elsewhere.mkdir()
    pg.render(setup, SIZE, "numpy", "lightmap").save(elsewhere / "b.png")
    elsewhere.rename(folder.parent / "moved")
    found = pg.load(folder.parent / "moved" / "b.png")
    assert found.scene.lightmap == setup.scene.lightmap
