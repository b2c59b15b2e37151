"""A picture made with a known mistake is told to be made with it."""

import json

import numpy as np
import pytest
from PIL import Image as Pillow

import playground as pg
from playground import cli
from playground.measure.mistakes import ORDERS, likely_mistakes, ways
from playground.render.gl.bugs import zoo
from playground.render.image import Image
from playground.render.renderer import open_renderer
from playground.scene.assign import assign

SIZE = (120, 90)
LAMPS = (pg.DirectionalLight(to_light=(-1, 1, 1)), pg.PointLight(position=(2, 2, 3)))


def shown(setup, renderer):
    """The picture of a setup as a PNG holds it: 8-bit codes, and no word of how it was made."""
    with open_renderer(SIZE, renderer) as opened:
        codes = opened.render(setup, np.empty((SIZE[1], SIZE[0], 4), np.uint8))
    return Image(np.asarray(codes[..., :3] / 255.0, np.float32), renderer="file")


@pytest.mark.gl
@pytest.mark.parametrize("name", zoo())
def test_each_bug_of_the_zoo_is_found(gl, name):
    """The name comes first where the bug shows best, and nothing else makes the same picture."""
    bug = zoo()[name]
    setup = pg.load(bug.look)
    for change in bug.set:
        setup = assign(setup, change)
    likely = likely_mistakes(shown(setup.with_(bugs=(name,)), "gl"), setup, "gl")
    assert likely.nearest[0].name == name
    assert likely.nearest[0].rmse == 0.0 < likely.right
    assert all(other.rmse > 0.0 for other in likely.nearest[1:])
    assert bug.title in str(likely) and bug.breaks in str(likely)


@pytest.mark.parametrize("name", ["per-vertex", "highlight", "no-specular", "no-light-1", "curve"])
def test_settings_and_missing_parts(name):
    setup = pg.load("sphere").with_(lights=LAMPS, shininess=12)
    made = next(way.setup for way in ways(setup, zoo=False) if way.name == name)
    likely = likely_mistakes(shown(made, "numpy"), setup, "numpy")
    assert likely.nearest[0].name == name and likely.nearest[0].rmse == 0.0
    assert likely.explained


@pytest.mark.parametrize("name", ORDERS)
def test_orders_of_pixels(name):
    setup = pg.load("red-on-blue").with_(eye=(1.0, 2.0, 4.0), lights=LAMPS)
    right = shown(setup, "numpy")
    codes = np.ascontiguousarray(ORDERS[name][1](right.codes()))
    picture = Image(np.asarray(codes / 255.0, np.float32), renderer="file")
    likely = likely_mistakes(picture, setup, "numpy")
    assert likely.nearest[0].name == name and likely.nearest[0].rmse == 0.0


def test_what_is_right_or_no_known_mistake():
    setup = pg.load("sphere")
    right = shown(setup, "numpy")
    steps = []
    likely = likely_mistakes(right, setup, "numpy", steps.append)
    assert likely.off == 0.0 and not likely.nearest and "is right" in str(likely) and not steps
    off = Image(np.clip(right.pixels + np.float32(0.2), 0, 1), renderer="file")
    likely = likely_mistakes(off, setup, "numpy", steps.append)
    assert not likely.explained and "no classic mistake" in str(likely)
    assert likely.off == 1.0 and "100 % of the pixels differ" in str(likely)
    assert "bug zoo were not tried" in str(likely)  # NumPy has none
    assert steps == sorted(steps) and steps[-1] == 1.0
    assert json.loads(json.dumps(likely.to_dict()))["explained"] is False


def test_the_command(tmp_path, capsys, monkeypatch):
    mine = str(tmp_path / "mine.png")
    drawn = "--renderer", "numpy", "--set", "curve=srgb"
    assert cli.main(["render", "sphere", "--size", "90x70", "--set", "highlight=blinn", "-o", mine,
                     *drawn]) == 0  # fmt: skip
    capsys.readouterr()
    assert cli.main(["compare", "sphere", mine, "--mistakes", *drawn]) == 0  # as large as mine.png
    assert (
        "most like: n·h (Blinn) instead of r·v (Phong) (RMSE 0, to the right one"
        in capsys.readouterr().out
    )
    assert cli.main(["compare", "sphere", mine, "--mistakes", "--json", *drawn]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["mistakes"]["nearest"][0]["name"] == "highlight" and told["rmse"] > 0
    monkeypatch.setattr("playground.commands._pictures", lambda *_: pytest.fail("drawn in vain"))
    for wrong in (["sphere", "teapot"], [mine, mine], ["sphere", mine, "--method", "ray-tracing"]):
        assert cli.main(["compare", *wrong, "--mistakes", *drawn]) == 2
        assert "--mistakes compares one picture with one setup" in capsys.readouterr().err


def test_a_file_without_a_word_is_read_like_the_other(tmp_path, capsys):
    one, other = tmp_path / "one.png", tmp_path / "other.png"
    image = pg.render(pg.load("sphere").with_(curve="srgb", exposure=1.5), SIZE, "numpy")
    image.save(one)
    Pillow.fromarray(image.codes()).save(other)
    for names in ((one, other), (other, one)):
        assert cli.main(["compare", *map(str, names), "--json"]) == 0
        assert json.loads(capsys.readouterr().out)["max"] == 0.0
