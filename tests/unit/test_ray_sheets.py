"""The figures of ray tracing: what each depth adds, and the intersection tests per pixel."""

import numpy as np
import pytest

import playground as pg
from playground.cli import main
from playground.explain.panels import MARGIN
from playground.explain.ray_tests import ray_tests
from playground.explain.sheet import make_sheet
from playground.render.trace import walk
from playground.render.trace.traced_scene import prepare

SIZE = (40, 30)


def columns_of(sheet):
    return sheet.codes.shape[1] // (SIZE[0] + MARGIN)


def test_depths_are_shown_until_no_ray_goes_on():
    sheet = make_sheet(pg.load("sphere"), "depth", SIZE, "numpy")
    assert columns_of(sheet) == 1 and sheet.message == "after depth 0 no ray goes on"
    room = make_sheet(pg.load("whitted-room").with_(depth=2), "depth", SIZE, "numpy")
    assert columns_of(room) == 3 and "depth 3" not in room.message
    assert "after depth 2 rays not followed weigh" in room.message


def test_what_a_depth_adds_is_measured():
    setup = pg.load("whitted-room").with_(depth=1)
    first, second = (
        pg.render(setup.with_(depth=d), SIZE, "numpy", "ray-tracing").shown() for d in (0, 1)
    )
    sheet = make_sheet(setup, "depth", SIZE, "numpy")
    assert f"depth 1 adds at most {np.abs(second - first).max():.3f}" in sheet.message


def test_a_shape_with_a_formula_is_one_test():
    found = ray_tests(pg.load("sphere"), SIZE)
    covered = pg.render(pg.load("sphere"), SIZE, "numpy", "ray-tracing").coverage > 0.5
    assert (found.first[covered] == 1).all()
    assert found.first.max() == 1 and found.first[0, 0] == 0
    np.testing.assert_array_equal(found.first, found.every)  # nothing mirrors


def test_a_mesh_is_tested_as_its_tree_says():
    setup = pg.load("teapot")
    scene = prepare(setup, SIZE)
    (solid,) = scene.solids
    origin, direction, limit = scene.camera_rays(np.arange(SIZE[0] * SIZE[1]), (0.5, 0.5))
    inner = solid.inward(origin, direction)
    want = np.sum(walk.count_tests(solid.bvh, *inner, limit), axis=0)
    near = solid.near(origin, direction, limit)
    found = ray_tests(setup, SIZE).first.ravel()
    np.testing.assert_array_equal(found[near], want[near])
    assert found.sum() == want[near].sum() and want.max() > 10


def test_secondary_rays_are_counted_where_they_start():
    setup = pg.load("whitted-room")
    found = ray_tests(setup, SIZE)
    more = found.every > found.first
    assert 0.1 < more.mean() < 0.5
    np.testing.assert_array_equal(ray_tests(setup.with_(depth=0), SIZE).every, found.first)


@pytest.mark.parametrize("sheet", ["depth", "tests"])
def test_the_command_line_draws_them(tmp_path, capsys, sheet):
    file = tmp_path / "s.png"
    words = ["render", "whitted-room", "--sheet", sheet, "-o", str(file), "--size", "40x30"]
    assert main([*words, "--renderer", "numpy"]) == 0
    assert main([*words, "--renderer", "numpy", "--method", "ray-tracing", "--depth", "1"]) == 0
    assert file.stat().st_size > 1000
    assert main([*words[:3], "terms", *words[4:], "--method", "ray-tracing"]) == 2
    assert "raster" in capsys.readouterr().err
