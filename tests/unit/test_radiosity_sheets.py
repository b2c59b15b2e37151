"""The figures of radiosity: what each reflection adds, and one scene drawn by five methods."""

import re

import numpy as np
import pytest

import playground as pg
from playground.cli import main
from playground.explain import radiosity_sheet
from playground.explain.panels import MARGIN
from playground.explain.radiosity_sheet import arriving_by_bounce
from playground.explain.sheet import make_sheet

SIZE = (32, 24)
SMALL = {"patches": 60}
GREY = (0.5, 0.5, 0.5)


def panels_of(sheet):
    return sheet.codes.shape[1] // (SIZE[0] + MARGIN)


def percents(message):
    return [float(x) for x in re.findall(r"([\d.]+) %", message)]


@pytest.fixture
def few(monkeypatch):
    """A figure that is made in a moment."""
    monkeypatch.setattr(radiosity_sheet, "PATHS", 1)
    monkeypatch.setattr(radiosity_sheet, "TEXELS", 64)
    monkeypatch.setattr(radiosity_sheet, "RAYS", 0)


def test_light_in_a_furnace_grows_as_its_closed_form_says():
    setup = pg.load("furnace").with_(diffuse=GREY, **SMALL)
    result = pg.radiosity(setup, "numpy")
    light = arriving_by_bounce(result, 3)
    emitted = result.patches.emission
    for k, arriving in enumerate(light):
        # H_k = E (1 + rho + ... + rho^(k-1)); rows that sum to 1 in float64 keep it so
        np.testing.assert_allclose(arriving, emitted * (1.0 - 0.5**k) / 0.5, atol=1e-12)


def test_the_shares_of_the_reflections_are_told():
    setup = pg.load("furnace").with_(diffuse=GREY, convergence=1e-9, **SMALL)
    told = []
    sheet = make_sheet(setup, "bounces", SIZE, "numpy", told.append)
    assert told == sorted(told) and 0.9 < told[-1] <= 1.0
    assert panels_of(sheet) == 5
    assert percents(sheet.message) == [50.0, 25.0, 12.5, 12.5]


def test_pictures_of_reflections_are_those_of_radiosity():
    setup = pg.load("facing-plates").with_(solver="gauss-seidel", specular_weight=0.0, **SMALL)
    sheet = make_sheet(setup, "bounces", SIZE, "numpy")
    whole = pg.render(setup, SIZE, "numpy", "radiosity").codes()
    height, width = whole.shape[:2]
    left = MARGIN + 4 * (width + MARGIN)
    top = next(
        y
        for y in range(sheet.codes.shape[0] - height)
        if np.array_equal(sheet.codes[y : y + height, left : left + width], whole)
    )
    first = sheet.codes[top : top + height, MARGIN : MARGIN + width]
    assert first.max() <= whole.max() and first.sum() < whole.sum()


@pytest.mark.gl
def test_the_gpu_draws_each_light_anew(gl_context):
    setup = pg.load("facing-plates").with_(**SMALL)
    on_gpu, by_numpy = (make_sheet(setup, "bounces", SIZE, name) for name in ("gl", "numpy"))
    assert on_gpu.codes.shape == by_numpy.codes.shape
    differs = np.abs(on_gpu.codes.astype(int) - by_numpy.codes.astype(int)).max(axis=-1)
    # Silhouettes differ by a pixel, of 10 small pictures; a light drawn twice would differ inside.
    assert np.mean(differs > 1) < 0.01


def test_five_answers_to_one_scene(few):
    setup = pg.load("indirect-room").with_(**SMALL)
    told = []
    sheet = make_sheet(setup, "answers", SIZE, "numpy", told.append)
    assert panels_of(sheet) == 5
    assert told == sorted(told) and len(set(told)) > 10 and 0.9 < told[-1] <= 1.0
    for name in ("local Phong", "lightmap", "ray tracing", "radiosity"):
        assert re.search(rf"{name} 0\.\d+", sheet.message), name


def test_a_lightmap_that_is_there_is_taken(few, tmp_path, monkeypatch):
    setup = pg.load("facing-plates").with_(**SMALL)
    file = tmp_path / "plates.npz"
    pg.radiosity(setup, "numpy").bake(32).save(file)
    monkeypatch.setattr(radiosity_sheet, "TEXELS", -1)  # baking would fail
    sheet = make_sheet(setup.with_(lightmap=str(file)), "answers", SIZE, "numpy")
    assert "lightmap" in sheet.message


@pytest.mark.parametrize("sheet", ["bounces", "answers"])
def test_the_command_line_draws_them(few, tmp_path, sheet):
    file = tmp_path / "s.png"
    words = ["render", "facing-plates", "--sheet", sheet, "-o", str(file), "--size", "40x30"]
    words += ["--set", "patches=40", "--renderer", "numpy"]
    assert main(words) == 0
    assert main([*words, "--method", "radiosity"]) == 0
    assert file.stat().st_size > 1000
