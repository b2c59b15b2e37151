"""`playground measure needs`, as a person or a script runs it, and a mistake in each place."""

import csv
import json

import numpy as np
import pytest
from test_cli import ok, refused

import playground as pg
from playground.cli import main
from playground.measure import advisor, needs_command
from playground.measure.advisor import Progress
from playground.scene.light import PointLight

BLACK = (0.0, 0.0, 0.0)
TINY = ("--size", "24x18", "--renderer", "numpy")
DARK = "point position=1,3,4 diffuse=0,0,0 specular=0,0,0 ambient=0,0,0"
BRIGHT = "point position=2,3,4"


@pytest.fixture
def lights(monkeypatch):
    """The price of a picture is the number of its lights: no clock decides a test."""

    class Costs:
        def __init__(self, *_):
            pass

        def __call__(self, setup):
            return float(len(setup.scene.lights))

        def close(self):
            """Nothing is held."""

    monkeypatch.setattr(advisor, "Stopwatch", Costs)


def needs(*words):
    return main(["measure", "needs", "sphere", "--light", BRIGHT, "--light", DARK, *TINY, *words])


def test_the_table_marks_what_is_proposed(lights, capsys):
    assert needs() == 0
    said = capsys.readouterr().out.splitlines()
    marked = [line for line in said if line.startswith("*")]
    assert [line[2:17] for line in marked] == ["light 1 (point)"]
    assert said[-1] == (
        "Dropping light 1 (point) saves 1 of 2 ms a picture, 50 % (RMSE 0, budget 0.01)."
    )


def test_json_is_one_document(lights, capsys):
    assert needs("--json", "--metric", "max", "--budget", "0.5") == 0
    document = json.loads(capsys.readouterr().out)
    assert (document["metric"], document["budget"]) == ("max", 0.5)
    assert document["size"] == [24, 18] and document["renderer"] == "numpy"
    assert document["proposal"]["drop"] == ["light 1 (point)"]
    assert document["proposal"]["errors"]["max"] == 0.0
    assert document["proposal"]["saving"]["saved"] == 1.0
    one = document["findings"][1]
    assert one["name"] == "light 1 (point)" and one["proposed"] is True
    assert one["errors"] == {"rmse": 0.0, "max": 0.0, "flip": 0.0, "off": 0.0}


def test_the_proposal_is_a_setup_file(lights, tmp_path):
    file = tmp_path / "thinner.toml"
    assert needs("-o", str(file)) == 0
    assert pg.load(file).scene.lights == (PointLight(position=(2, 3, 4)),)


def test_a_folder_takes_everything(lights, tmp_path):
    folder = tmp_path / "a" / "report"
    assert needs("-o", str(folder)) == 0
    thinner = pg.load(folder / "proposed.toml")
    assert len(thinner.scene.lights) == 1
    rows = list(csv.DictReader((folder / "needs.csv").read_text().splitlines()))
    document = json.loads((folder / "needs.json").read_text())
    assert [row["name"] for row in rows] == [row["name"] for row in document["findings"]]
    assert [row["name"] for row in rows if row["proposed"] == "True"] == ["light 1 (point)"]
    full, less = (pg.load(folder / f"{name}.png") for name in ("full", "proposed"))
    assert (len(full.scene.lights), len(less.scene.lights)) == (2, 1)
    assert np.array_equal(*(pg.render(s, (24, 18), "numpy").pixels for s in (full, less)))


def test_with_the_real_clock(tmp_path):
    done = ok("measure", "needs", "sphere", "--size", "8x6", "--renderer", "numpy", "--json")
    document = json.loads(done.stdout)
    assert {row["kind"] for row in document["findings"]} == {
        "light", "term", "tessellation", "shading",
    }  # fmt: skip
    assert all(row["saving"]["full"] > 0.0 for row in document["findings"])
    assert done.stderr == ""  # no bar where nobody looks


def test_nothing_to_drop_is_no_mistake(tmp_path, capsys):
    (tmp_path / "bare.toml").write_text(
        'light = []\n[[object]]\nmesh = "box"\n[settings]\nterms = []\nshading = "flat"\n'
    )
    assert main(["measure", "needs", str(tmp_path / "bare.toml"), *TINY]) == 0
    assert capsys.readouterr().out == "bare has nothing that could be dropped.\n"


BAD = {
    "unknown setup": (("spere",), "Did you mean 'sphere'?"),
    "no setup": ((), "SETUP"),
    "budget zero": (("sphere", "--budget", "0"), "'0' is no error budget"),
    "budget below zero": (("sphere", "--budget=-1"), "'-1' is no error budget"),
    "budget nan": (("sphere", "--budget", "nan"), "'nan' is no error budget"),
    "budget text": (("sphere", "--budget", "much"), "'much' is no error budget"),
    "metric": (("sphere", "--metric", "ssim"), "flip, max, rmse"),
    "renderer": (("sphere", "--renderer", "cuda"), "auto, embree, gl, numpy"),
    "stored light": (("sphere", "--method", "radiosity"), "drawn anew for every picture"),
    "kind of file": (("sphere", "-o", "a.png"), ".toml"),
    "no folder": (("sphere", "-o", "none/a.toml"), "Make the folder none"),
}


@pytest.mark.parametrize(("words", "said"), BAD.values(), ids=BAD)
def test_a_mistake_is_one_message(words, said, tmp_path):
    assert said in refused("measure", "needs", *words, cwd=tmp_path)


def test_a_bad_place_is_told_before_anything_is_measured(monkeypatch, tmp_path):
    monkeypatch.setattr(needs_command, "advise", lambda *_, **__: pytest.fail("it was measured"))
    (tmp_path / "taken").write_text("")
    assert needs("-o", str(tmp_path / "taken")) == 2


def test_the_experiments_are_still_there(tmp_path):
    assert "Did you mean" in refused("measure", "framess", cwd=tmp_path)


def test_the_bar_fits_a_line():
    for share in (0.0, 0.5, 1.0):
        text = needs_command.bar(
            Progress(share, "tessellation of object 12 (icosphere): 256 → 128"), 9.0
        )
        assert len(text) <= needs_command.LINE
        assert f"{100 * share:3.0f} %" in text
    assert "9 s left" in needs_command.bar(Progress(0.5, "light 0 (point)"), 9.0)
