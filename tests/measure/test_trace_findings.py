"""The experiments of ray tracing: their sentences follow from rows, their candidates are right."""

import numpy as np
import pytest
from synthetic import row

from playground.measure.experiments import find
from playground.measure.experiments.bvh import flat
from playground.measure.experiments.offset import METHODS, OURS, judged, leaving
from playground.measure.experiments.rays import FLOOR, PICTURE, RATE, hit_errors
from playground.measure.ray_kinds import ray_kinds
from playground.measure.room_floor import RoomFloor, room_setup, swayed
from playground.render.renderer import render
from playground.render.trace import walk
from playground.render.trace.bvh import bvh_of
from playground.scene.shapes import make


def finding(name, *rows):
    return find(name).finding(list(rows))


def test_depth():
    whole, cut = "every ray", "no ray that weighs < 0.004"
    rows = [
        row(whole, 1.0, 0.1, "room", depth=1),
        row(whole, 4.0, 0.0, "room", depth=5),
        row(cut, 2.0, 0.004, "room", depth=5),
    ]
    told = finding("depth", *rows)
    assert told.startswith("Room: depth 5 (2 ms) is off by 0.4 %")
    assert "at depth 5 the threshold takes 0.5 times the time" in told
    assert "and changes the error from 0 % to 0.4 %" in told
    assert finding("depth", rows[0]) == "Room: no depth comes within 1 %."


def test_shadow_samples():
    few, many = row("s", 1.0, 0.04, "c", count=1), row("s", 8.0, 0.005, "c", count=16)
    told = finding("shadow-samples", many, few)
    assert "16 shadow rays take 8 times the time of 1" in told
    assert "from 4 % to 0.5 %" in told and "power -0.75; 1 % takes 16 (8 ms)" in told
    worse = row("s", 8.0, 0.02, "c", count=16)
    assert "none of these numbers comes within 1 %" in finding("shadow-samples", few, worse)


def test_bvh():
    rows = [
        row("tree", 1.0, 0.0, triangles=20),
        row("every triangle", 0.5, 0.0, triangles=20),
        row("tree", 2.0, 0.0, triangles=320),
        row("every triangle", 20.0, 0.0, triangles=320),
        row("tree", 3.0, triangles=2000),
    ]
    told = finding("bvh", *rows)
    assert "longer than the tree: 0.5 times at 20 and 10 times at 320 triangles" in told
    assert "100 times the triangles make the tree's rays take 3 times as long" in told


def test_rays():
    def rate(method, millions, case):
        return row(method, 1.0, 0.0, case, more={RATE: millions})

    rows = [
        rate("GL", 4.0, "primary rays"),
        rate("GL", 3.0, "shadow rays"),
        rate("NumPy", 0.25, "primary rays"),
        rate("Mitsuba", 20.0, "shadow rays"),
        row("GL", 1.0, 0.0, "room, small", ratio=1.5, more={PICTURE: 18.0}),
        row("NumPy", 9.0, 0.0, "room, small", more={PICTURE: 900.0}),
    ]
    assert finding("rays", *rows) == (
        "GL: 4 primary rays and 3 shadow rays per second, in millions; "
        "NumPy: 0.25 primary rays per second, in millions; "
        "Mitsuba: 20 shadow rays per second, in millions; "
        "room, small: GL takes 18 ms, 1.5 times the time of the shader written by hand; "
        "NumPy 900 ms."
    )
    assert find("rays").ratio_to == FLOOR


def test_trace_precision():
    rows = [row("GL", 1.0, 0.02, "a"), row("NumPy", 30.0, 0.0, "a")]
    told = finding("trace-precision", *rows)
    assert told == "A: float32 is off by 2 %, 2 % at worst; NumPy takes 30 times the time."


def test_offset():
    rows = [
        row("none", 1.0, 0.5, "near"),
        row("none", 1.0, 0.9, "far"),
        row("error bound", 1.0, 0.0, "near"),
    ]
    assert finding("offset", *rows) == (
        "None starts rays wrongly in 2 of 2 scenes, at worst 90 % (far); error bound in none of 1."
    )


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
def test_the_error_bound_is_enough_at_every_size(size):
    rays = leaving(size, 0.0, 5000)
    assert judged(METHODS[OURS], rays, size).mean == 0.0
    assert judged(METHODS["none"], rays, size).mean > 0.3
    assert judged(METHODS["fixed epsilon"], leaving(1e-3, 0.0, 5000), 1e-3).mean == 1.0


def test_wächter_and_binders_offset_moves_256_units_of_the_last_place():
    rays = leaving(1.0, 100.0, 1000)
    moved = np.abs(METHODS["Wächter-Binder"](rays) - rays.point) / np.spacing(np.abs(rays.point))
    far = np.abs(rays.point) > 1.0
    # The step is cut to a whole number; it doubles or halves where it crosses a power of two.
    assert (moved[far] <= 2.0 * 256.0 * np.abs(rays.normal[far])).all()
    assert (moved[far] >= 0.5 * (256.0 * np.abs(rays.normal[far]) - 1.0)).all()


def test_one_leaf_tests_every_triangle():
    tree = bvh_of(make("torus"))
    rays = ray_kinds(tree, (12, 9))[0]
    asked = rays.origin, rays.direction, rays.limit
    boxes, triangles = walk.count_tests(flat(tree), *asked)
    assert set(triangles) <= {0, len(tree.order)} and boxes.max() == 1
    t, number, _ = walk.closest(flat(tree), *asked)
    want, other, _ = walk.closest(tree, *asked)
    np.testing.assert_array_equal(t, want)
    assert (number == other).mean() > 0.99  # an edge belongs to two


def test_hits_of_one_backend_only_are_counted():
    found = hit_errors(np.array([1.0, 2.5, -1.0, 4.0]), np.array([1.0, 2.0, 3.0, -1.0]))
    assert (found.max, found.left_out) == (0.5, 2)
    assert hit_errors(np.array([-1.0]), np.array([-1.0])).rmse == 0.0


@pytest.mark.gl
def test_the_floor_is_the_same_room(gl):
    size, step = (160, 120), 3
    floor = RoomFloor(size, "f4")
    drawn = floor.frame(step)[::-1, :, :3].astype(np.float64)
    floor.close()
    image = render(swayed(room_setup(), step), size, "numpy", "ray-tracing")
    off = np.abs(drawn - image.pixels).max(axis=-1)
    # Its epsilon of 1e-3 moves what is seen at rims and edges; walls are exact to float32.
    assert np.median(off) < 1e-6
    assert (off > 0.01).mean() < 0.01
