"""The experiments of radiosity: their sentences follow from rows, their references are right."""

from contextlib import ExitStack
from dataclasses import replace

import numpy as np
import pytest
from synthetic import row

from playground.measure.blocks_box import DIVISIONS, blocks_box, empty_box
from playground.measure.experiments import find
from playground.measure.experiments.hemicube import PARENTS, PLAIN, STRAIGHT
from playground.measure.experiments.lightmap import BAKING, DRAWN, FRAMES, LIGHTMAP
from playground.measure.experiments.radiosity import CONVERGED, FIRST, MEGABYTES, RATE, WHOLE
from playground.measure.experiments.solvers import STEPS
from playground.measure.experiments.subdivision import PATCHES
from playground.measure.matrix_errors import (
    SUM_OFF,
    converged_rows,
    exact_rows,
    row_errors,
    some_rows,
)
from playground.measure.row_methods import row_maker
from playground.measure.textured_floor import TexturedFloor
from playground.render.radiosity.factor.closed_form import closed_form
from playground.render.radiosity.patch.inspect import inspect
from playground.scene.camera import Camera


def finding(name, *rows):
    return find(name).finding(list(rows))


def test_form_factors():
    rows = [
        row("hemicube, GL", 0.1, 0.2, resolution=16),
        row("hemicube, GL", 0.4, 0.05, resolution=64),
        row("closed form, GL", 0.3, 0.012, points=1),
        row("closed form, GL", 0.5, 0.0001, points=2),
        row("closed form, NumPy", 2.0, 0.0001, points=2),
        row("point to point", 0.1, 0.3),
    ]
    assert finding("form-factors", *rows) == (
        "1 % is reached first by closed form, GL, points 2 (0.5 ms a row); not by hemicube, GL: "
        "5 % off at best; by closed form, NumPy, points 2 in 4 times that; not by point to point: "
        "30 % off at best; errors go as resolution^-1.0 (hemicube, GL), points^-6.9 "
        "(closed form, GL)."
    )
    assert finding("form-factors", rows[0]).startswith("No method comes within 1 %; not by hemi")
    swapped = finding("form-factors", row("hemicube, GL", 0.1, 0.009, resolution=512), *rows[3:])
    assert swapped.startswith("1 % is reached first by hemicube, GL, resolution 512")
    assert "by closed form, GL, points 2 in 5 times that" in swapped


def test_hemicube():
    def cube(method, time, error, resolution):
        return row(method, time, error, more={SUM_OFF: 2e-4}, resolution=resolution)

    rows = [
        cube(PARENTS, 1.0, 0.1, 16),
        cube(PARENTS, 4.0, 0.0125, 128),
        cube(STRAIGHT, 1.0, 0.2, 16),
        cube(STRAIGHT, 4.0, 0.05, 128),
        cube(PLAIN, 3.0, 0.1, 16),
    ]
    assert finding("hemicube", *rows) == (
        "From 16 to 128 pixels the error goes from 10 % to 1.25 %, as the resolution to the power "
        "-1.0, in 4 times the time; row sums are off by 0.0002 at most; hemicubes that are not "
        "turned have 2 to 4 times the error and take 1 times the time; drawing patches has "
        "1 times the error and takes 3 times the time."
    )
    other = finding("hemicube", rows[0], cube(PLAIN, 0.5, 0.05, 16))
    assert other.endswith("drawing patches has 0.5 times the error and takes 0.5 times the time.")


def test_solvers():
    def solver(name, time, steps, left=1e-4):
        return row(name, time, 1e-5, "white", more={STEPS: steps}, left=left)

    rows = [solver("jacobi", 4.0, 30.0), solver("direct", 2.0, 1.0), solver("jacobi", 1.0, 9.0, 1)]
    assert finding("solvers", *rows) == (
        "White: direct is the fastest to leave 0.01 % of the light (2 ms, 1 step); "
        "of its time the others take: jacobi 2 times, 30 steps."
    )
    other = finding("solvers", solver("jacobi", 1.0, 30.0), rows[1])
    assert "jacobi is the fastest" in other and "direct 2 times, 1 step." in other


def test_subdivision():
    def divided(method, time, error, first, patches, **knobs):
        return row(method, time, error, more={PATCHES: patches}, **{"at first": first}, **knobs)

    rows = [
        divided("even", 100.0, 0.2, 100, 98.0),
        divided("even", 900.0, 0.05, 400, 402.0),
        divided("refined", 450.0, 0.04, 100, 300.0, rounds=1),
    ]
    assert finding("subdivision", *rows) == (
        "100 even patches are off by 20 %, 400 by 5 %: as their number to the power -1.00; "
        "5 % takes 402 even patches (0.9 s); 5 % takes 300 refined patches (0.45 s), "
        "0.5 times the time."
    )
    worse = finding("subdivision", *rows[:2], replace(rows[2], error=0.1))
    assert worse.endswith("no refined patches come within 5 %.")


def test_lightmap():
    rows = [
        row(DRAWN, 1.0, 0.15, BAKING),
        row("from the patches", 100.0, 0.08, BAKING, texels=32),
        row("from the patches", 400.0, 0.02, BAKING, texels=128),
        row(LIGHTMAP, 1.0, None, FRAMES, ratio=1.1),
    ]
    assert finding("lightmap", *rows) == (
        "5 % takes 128 texels a side, from the patches (0.4 s to bake); drawn by its patches the "
        "same solution is off by 15 %; errors go as texels to the power -1.0 (from the patches); "
        "a frame takes 1.1 times the time of an unlit textured one."
    )
    assert finding("lightmap", rows[1]) == "No lightmap comes within 5 %."
    assert "2 times the time of an unlit" in finding("lightmap", replace(rows[3], ratio=2.0))


def test_radiosity_precision():
    told = finding(
        "radiosity-precision",
        row("all in float64", 2.0, None, "dark"),
        row("all in float32", 1.0, 1e-7, "dark"),
        row("all in float32", 1.0, 0.02, "white"),
        row("float32 rows (GL)", 1.0, 1e-8, "white"),
    )
    assert told == (
        "Dark: off by 1e-05 % with all in float32; "
        "white: off by 1e-06 % with float32 rows (GL) and 2 % with all in float32."
    )


def test_radiosity():
    def rate(method, per_second, error):
        return row(method, 1.0, error, "box", more={RATE: per_second})

    rows = [
        rate("hemicube 64x64", 6000.0, 0.1),
        rate("closed form", 1000.0, 0.006),
        row(f"{FIRST}, hemicube", 50.0, 0.08, "room"),
        row(f"{CONVERGED}, hemicube", 400.0, 0.0001, "room"),
        row(f"{WHOLE}, hemicube", 20000.0, None, "large", more={MEGABYTES: 500.0}),
    ]
    assert finding("radiosity", *rows) == (
        "Box: hemicube 64x64 6000 patches per second off by 10 % and closed form 1000 patches per "
        "second off by 0.6 %; room: first picture, hemicube after 0.05 s, off by 8 % and "
        "converged to 1e-4, hemicube after 0.4 s, off by 0.01 %; "
        "large: converged, own process, hemicube after 20 s, 500 MB."
    )
    peer = finding("radiosity", rate("pyviewfactor", 100.0, 0.02), rows[0])
    assert peer.endswith("off by 10 % and pyviewfactor 100 patches per second off by 2 %.")


@pytest.mark.parametrize("patches", DIVISIONS)
def test_the_box_with_blocks_is_sound(patches):
    box = blocks_box(patches)
    assert len(box) == patches
    report = inspect(box)
    assert report.sound and report.closed
    # Six walls of 2 x 2, blocks of 0.6 x 0.6 that are 1.2 and 0.6 high.
    assert box.area.sum() == pytest.approx(24.0 + 2 * 0.72 + 2.4 * (1.2 + 0.6))
    numbers = box.parents.patch_at(box.parent, *places_on(box).T)
    np.testing.assert_array_equal(numbers, np.arange(patches))


def places_on(box):
    """Where on its parent the centre of each patch lies, (N, 2)."""
    a, b, _, d = np.moveaxis(box.parents.corners[box.parent], 1, 0)
    away = box.centre - a
    along = [np.sum(away * edge, axis=1) / np.sum(edge * edge, axis=1) for edge in (b - a, d - a)]
    return np.stack(along, axis=1)


def test_exact_rows_of_the_empty_box_sum_to_1():
    box = empty_box(3)
    rows = exact_rows(box, some_rows(box, 9))
    np.testing.assert_allclose(rows.sum(axis=1), 1.0, rtol=0.0, atol=1e-12)


def test_row_errors_are_shares_of_the_form_factors():
    want = np.array([[0.0, 0.5, 0.5]])
    found = row_errors(np.array([[0.0, 0.6, 0.5]]), want, "made up")
    assert (found.mean, found.max) == pytest.approx((0.1, 0.1))
    assert found.rmse == pytest.approx(0.1 / np.sqrt(0.5))
    assert found.more[SUM_OFF] == pytest.approx(0.1)


@pytest.mark.gl
def test_the_converged_rows_are_nearer_to_themselves_than_any_method_to_them(gl):
    """Other segments, and more, change them by an eighth of the least error that is measured."""
    from playground.render.gl.radiosity.pairs import GpuPairs
    from playground.render.radiosity.factor.closed_form import ClosedForm

    box = blocks_box(594)
    chosen = some_rows(box, 6)
    want = converged_rows(box, chosen)
    pairs = GpuPairs(gl, box, points=4, rays=31, look=False)
    finer = ClosedForm(box, gpu=pairs)(chosen)
    pairs.release()
    own = row_errors(finer, want, "").mean
    assert 0.0 < own < 0.25 * row_errors(closed_form(box, chosen), want, "").mean


@pytest.mark.gl
def test_row_makers_do_the_work_again_at_every_call(gl):
    box = empty_box(2)
    everybody = np.arange(len(box))
    with ExitStack() as stack:
        for method in ("closed-form", "hemicube"):
            found = [
                stack.enter_context(row_maker(method, renderer, box))(everybody)
                for renderer in ("gl", "numpy")
            ]
            np.testing.assert_allclose(*found, rtol=0.0, atol=2e-3)


@pytest.mark.gl
def test_the_textured_floor_shows_the_texture(gl):
    corners = np.array([[-9.0, -9.0, 0.0], [9.0, -9.0, 0.0], [9.0, 9.0, 0.0], [-9.0, 9.0, 0.0]])
    faces = np.array([[0, 1, 2], [0, 2, 3]], dtype=np.int32)
    places = np.full((4, 2), 0.75, dtype=np.float32)
    texels = np.zeros((2, 2, 3), dtype=np.float32)
    texels[1, 1] = 0.2, 0.4, 0.6
    floor = TexturedFloor((8, 8), [(corners, faces, places)], texels)
    codes = floor.frame(Camera(eye=(0.0, 0.0, 5.0)), 0.1, 10.0).copy()
    floor.close()
    assert (codes == [51, 102, 153, 255]).all()
