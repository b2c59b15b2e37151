"""Lightmaps as files: what was written comes back, what is none is refused, no half files."""

import os
from dataclasses import replace

import numpy as np
import pytest

import playground as pg
from playground.render.lightmap.atlas import unwrap
from playground.render.lightmap.lightmap import (
    Lightmap,
    geometry_checksum,
    lighting_checksum,
)
from playground.render.lightmap.lightmap_file import load_lightmap
from playground.scene.scene import Object
from playground.scene.transform import Transform

SIZE = 32
BOX = Object(mesh="box")
NOTHING = Object(mesh="box", transform=Transform(scale=(0.0, 0.0, 0.0)))
SETUP = pg.load("teapot").with_(objects=(NOTHING, BOX))


@pytest.fixture
def lightmap(rng):
    direct, indirect = rng.uniform(0.0, 4.0, (2, SIZE, SIZE, 3)).astype(np.float32)
    chart = rng.integers(-1, 6, (SIZE, SIZE)).astype(np.int32)
    parts = unwrap(SETUP.scene, SIZE).parts
    checksums = geometry_checksum(SETUP.scene), lighting_checksum(SETUP)
    return Lightmap(SIZE, direct, indirect, chart >= 0, chart, parts, *checksums)


def test_comes_back_to_the_bit(lightmap, tmp_path):
    lightmap.save(tmp_path / "a.npz")
    back = load_lightmap(tmp_path / "a.npz")
    for name in ("direct", "indirect", "coverage", "chart"):
        assert np.array_equal(getattr(back, name), getattr(lightmap, name))
        assert getattr(back, name).dtype == getattr(lightmap, name).dtype
    assert (back.size, back.geometry, back.lighting) == (
        SIZE,
        lightmap.geometry,
        lightmap.lighting,
    )
    assert back.parts[0] is None
    for name in ("vertices", "faces", "texcoords", "charts"):
        assert np.array_equal(getattr(back.parts[1], name), getattr(lightmap.parts[1], name))


def test_a_file_that_changed_is_read_anew(lightmap, tmp_path):
    file = tmp_path / "a.npz"
    lightmap.save(file)
    assert load_lightmap(file) is load_lightmap(file)
    replace(lightmap, direct=2.0 * lightmap.direct).save(file)
    assert np.array_equal(load_lightmap(file).direct, 2.0 * lightmap.direct)


def test_direct_and_indirect_are_the_whole(lightmap):
    assert np.array_equal(lightmap.texels(), lightmap.direct + lightmap.indirect)
    assert lightmap.texels("direct") is lightmap.direct
    assert lightmap.texels("indirect") is lightmap.indirect


def test_as_a_picture(lightmap):
    """Row 0 of a picture is its top; of a lightmap it is v = 0, the bottom."""
    assert np.array_equal(lightmap.image("direct").pixels[0], lightmap.direct[-1])
    grey = lightmap.image(charts=True).pixels[::-1][~lightmap.coverage]
    assert (grey == grey[0]).all() and 0.2 < grey[0, 0] < 0.22  # the middle of the sRGB codes


def test_other_geometry_is_refused(lightmap):
    lightmap.check_fits(SETUP.scene)
    others = [
        replace(BOX, transform=Transform(translate=(1.0, 0.0, 0.0))),
        replace(BOX, mesh="sphere"),
        replace(BOX, normals="smooth", mesh="cylinder"),
    ]
    for other in others:
        with pytest.raises(pg.PlaygroundError, match="other geometry"):
            lightmap.check_fits(replace(SETUP.scene, objects=(NOTHING, other)))
    with pytest.raises(pg.PlaygroundError, match="other geometry"):
        lightmap.check_fits(replace(SETUP.scene, objects=(BOX,)))
    with pytest.raises(pg.PlaygroundError, match="Bake it again"):
        lightmap.check_fits(replace(SETUP.scene, objects=(BOX, NOTHING)))


def test_what_light_depends_on():
    same = SETUP.with_(shininess=3.0, eye=(1, 2, 3), exposure=2.0, terms=("diffuse", "emissive"))
    assert lighting_checksum(same) == lighting_checksum(SETUP)
    assert lighting_checksum(SETUP.with_(diffuse=(0.1, 0.2, 0.3))) != lighting_checksum(SETUP)
    assert lighting_checksum(SETUP.with_(lights=())) != lighting_checksum(SETUP)
    assert lighting_checksum(SETUP.with_(terms=("specular",))) != lighting_checksum(SETUP)


def archive(path, **changes):
    """A sound file with some of its arrays changed; None takes one away."""
    with np.load(path) as found:
        arrays = {name: found[name] for name in found.files}
    arrays |= changes
    np.savez(path, **{name: x for name, x in arrays.items() if x is not None})


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"format": None}, "no lightmap"),
        ({"format": np.array("something else")}, "no lightmap"),
        ({"version": np.array(2)}, "another version"),
        ({"direct": None}, "no 'direct'"),
        ({"direct": np.zeros((SIZE, SIZE, 3))}, "float64"),
        ({"direct": np.zeros((SIZE, SIZE, 2), np.float32)}, "light of shape"),
        ({"indirect": np.zeros((SIZE, 8, 3), np.float32)}, "light of shape"),
        ({"indirect": np.full((SIZE, SIZE, 3), np.nan, np.float32)}, "not finite"),
        ({"chart": np.zeros((4, 4), np.int32)}, "charts of shape"),
        ({"objects": np.array(2.0)}, "objects"),
        ({"texcoords_1": None}, "no 'texcoords_1'"),
        ({"faces_1": np.full((12, 3), 99, np.int32)}, "hold together"),
        ({"vertices_1": np.zeros(3, np.int32)}, "hold together"),
        ({"geometry": None}, "no 'geometry'"),
    ],
)
def test_wrong_files(lightmap, tmp_path, changes, said):
    file = tmp_path / "a.npz"
    lightmap.save(file)
    archive(file, **changes)
    with pytest.raises(pg.PlaygroundError, match=said):
        load_lightmap(file)


def test_damaged_files(lightmap, tmp_path):
    file = tmp_path / "a.npz"
    lightmap.save(file)
    sound = file.read_bytes()
    for damaged in (
        b"",
        b"nothing",
        sound[: len(sound) // 2],
        sound[:200] + b"x" * 9 + sound[209:],
    ):
        file.write_bytes(damaged)
        with pytest.raises(pg.PlaygroundError, match="no lightmap, or a damaged one"):
            load_lightmap(file)
    np.save(tmp_path / "b.npy", np.zeros(3))
    os.rename(tmp_path / "b.npy", file)
    with pytest.raises(pg.PlaygroundError, match="no lightmap, or a damaged one"):
        load_lightmap(file)
    with pytest.raises(pg.PlaygroundError, match="there is no file"):
        load_lightmap(tmp_path / "none.npz")


def test_objects_in_a_file_are_not_run(lightmap, tmp_path):
    file = tmp_path / "a.npz"
    lightmap.save(file)
    archive(file, direct=np.array([{"a": 1}], dtype=object))
    with pytest.raises(pg.PlaygroundError, match="no lightmap"):
        load_lightmap(file)


def test_an_interrupted_write_leaves_the_old_file(lightmap, tmp_path, monkeypatch):
    file = tmp_path / "a.npz"
    lightmap.save(file)
    before = file.read_bytes()

    def stop(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(os, "replace", stop)
    with pytest.raises(KeyboardInterrupt):
        replace(lightmap, direct=lightmap.indirect).save(file)
    assert file.read_bytes() == before
    assert os.listdir(tmp_path) == ["a.npz"]


def test_only_npz(lightmap, tmp_path):
    with pytest.raises(pg.PlaygroundError, match=r"Call it a\.npz"):
        lightmap.save(tmp_path / "a.exr")


def test_the_setup_finds_its_lightmap_from_anywhere(tmp_path, monkeypatch):
    """Written relative to the setup file, absolute when read; elsewhere it stays absolute."""
    setup = SETUP.with_(lightmap=str(tmp_path / "deep" / "a.lightmap.npz"))
    (tmp_path / "deep").mkdir()
    pg.save(setup, tmp_path / "deep" / "a.toml")
    assert 'lightmap = "a.lightmap.npz"' in (tmp_path / "deep" / "a.toml").read_text()
    monkeypatch.chdir(tmp_path)
    assert pg.load("deep/a.toml").scene.lightmap == setup.scene.lightmap
    pg.save(setup, tmp_path / "b.toml")
    assert 'lightmap = "deep/a.lightmap.npz"' in (tmp_path / "b.toml").read_text()
    assert pg.load("b.toml").scene.lightmap == setup.scene.lightmap
