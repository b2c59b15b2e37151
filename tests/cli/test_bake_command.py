"""`playground bake`: both files or none, a setup that draws, refusals before the work."""

import os
import signal
import subprocess
import sys

import numpy as np
import pytest
from test_cli import ok, refused, run

import playground as pg

FEW = ("--set", "patches=60", "--texels", "48", "--rays", "4", "--renderer", "numpy")


def test_bakes_a_setup_that_draws(tmp_path):
    said = ok("bake", "furnace", "-o", "a.toml", *FEW, cwd=tmp_path).stderr
    assert "48x48 texels, 6 charts cover" in said and "a.lightmap.npz" in said
    assert sorted(os.listdir(tmp_path)) == ["a.lightmap.npz", "a.toml"]
    setup = pg.load(tmp_path / "a.toml")
    assert setup.scene.lightmap == str(tmp_path / "a.lightmap.npz")
    assert setup.settings.patches == 60
    drawn = ("render", "a.toml", "--method", "lightmap", "-o", "a.npy", "--size", "16x12")
    ok(*drawn, "--renderer", "numpy", cwd=tmp_path)
    # The solver stops at 1e-4 of the light, which it guesses at: ten times that for a margin.
    assert np.abs(np.load(tmp_path / "a.npy") - 0.5).max() < 0.02


def test_a_second_bake_replaces_the_first(tmp_path):
    ok("bake", "furnace", "-o", "a.toml", *FEW, cwd=tmp_path)
    first = (tmp_path / "a.lightmap.npz").read_bytes()
    (tmp_path / "a.toml").write_text("# mine\n" + (tmp_path / "a.toml").read_text())
    ok("bake", "a.toml", "-o", "a.toml", "--texels", "64", "--rays", "4", cwd=tmp_path)
    assert (tmp_path / "a.lightmap.npz").read_bytes() != first
    assert (tmp_path / "a.toml").read_text().startswith("# mine")
    assert sorted(os.listdir(tmp_path)) == ["a.lightmap.npz", "a.toml"]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("furnace", "-o", "a.png"), "Call it a.toml"),
        (("furnace", "-o", "none/a.toml"), "Make the folder none first"),
        (("furnace", "-o", "a.toml", "--texels", "5"), "size of a lightmap"),
        (("furnace", "-o", "a.toml", "--texels", "many"), "invalid int value"),
        (("furnace", "-o", "a.toml", "--rays", "-1"), "rays per texel"),
        (("teapot", "-o", "a.toml", "--texels", "16"), "do not fit"),
        (("nothing-of-that-name", "-o", "a.toml"), "nothing-of-that-name"),
        (("furnace", "-o", "a.toml", "--set", "emissive=0,0,0"), "sends out light"),
        (("furnace", "-o", "a.toml", "--set", "diffuse=1,1,1"), "reflects all"),
        (("furnace",), "-o"),
    ],
)
def test_mistakes_leave_nothing_behind(tmp_path, arguments, said):
    assert said in refused("bake", *arguments, cwd=tmp_path)
    assert os.listdir(tmp_path) == []


@pytest.mark.parametrize("name", ["a.toml", "a.lightmap.npz"])
def test_a_place_that_takes_no_file_is_told_before_the_work(tmp_path, monkeypatch, name):
    from playground.render.lightmap import command

    def never(*_):
        raise AssertionError

    monkeypatch.setattr(command, "_with_bar", never)
    (tmp_path / name).mkdir()
    with pytest.raises(pg.PlaygroundError, match="is a folder"):
        command.run_bake(pg.load("furnace"), tmp_path / "a.toml", 32, 1, "numpy")
    assert os.listdir(tmp_path) == [name]


@pytest.mark.skipif(os.name == "nt", reason="Windows has no such signal for one process")
def test_stopped_it_leaves_the_old_files(tmp_path):
    ok("bake", "furnace", "-o", "a.toml", *FEW, cwd=tmp_path)
    before = {name: (tmp_path / name).read_bytes() for name in os.listdir(tmp_path)}
    path = str(pg.__path__[0] + "/..")
    running = subprocess.Popen(
        [sys.executable, "-X", "importtime", "-m", "playground", "bake", "furnace", "-o", "a.toml",
         "--texels", "512", "--rays", "4096"],
        cwd=tmp_path, env={**os.environ, "PYTHONPATH": path},
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    for line in running.stderr:  # until it has loaded what bakes, for minutes from there
        if line.rstrip().endswith("playground.render.lightmap.bake"):
            break
    assert running.poll() is None
    running.send_signal(signal.SIGINT)
    _, said = running.communicate(timeout=300)
    assert running.returncode == 130 and "stopped" in said and "Traceback" not in said
    assert {name: (tmp_path / name).read_bytes() for name in os.listdir(tmp_path)} == before


@pytest.mark.parametrize(
    ("patches", "texels", "fix"), [(5000, 64, "--set patches="), (60, 1024, "--texels")]
)
def test_what_ran_out_of_memory_is_named(tmp_path, monkeypatch, patches, texels, fix):
    from playground.render.lightmap import command
    from playground.render.radiosity.patch import memory

    def never_enough(*_):
        raise MemoryError

    monkeypatch.setattr(command, "_with_bar", never_enough)
    monkeypatch.setattr(memory, "available", lambda: 8 * 1000**2)
    setup = pg.load("furnace").with_(patches=patches)
    with pytest.raises(pg.PlaygroundError, match=fix) as refused:
        command.run_bake(setup, tmp_path / "a.toml", texels, 1, "numpy")
    assert f"{patches} patches" in str(refused.value)
    assert "about 1000 patches or 89 texels" in str(refused.value)
    assert os.listdir(tmp_path) == []


def test_if_the_setup_cannot_be_written_the_lightmap_is_not_either(tmp_path, monkeypatch):
    from playground.render.lightmap import command

    setup = pg.load("furnace").with_(patches=60)

    def full(*_):
        raise pg.PlaygroundError("cannot write", got="the disk is full")

    monkeypatch.setattr(command, "save", full)
    file = tmp_path / "a.lightmap.npz"
    for before in (None, b"an old one"):
        if before is not None:
            file.write_bytes(before)
        with pytest.raises(pg.PlaygroundError, match="full"):
            command.run_bake(setup, tmp_path / "a.toml", 32, 1, "numpy")
        assert os.listdir(tmp_path) == ([] if before is None else [file.name])
    assert file.read_bytes() == b"an old one"


def test_help_names_it():
    assert "bake" in run("-h").stdout
