"""The popping scope: the orbit is a circle, and per-vertex shading is what jumps."""

import numpy as np
import pytest

import playground as pg
from playground.measure.popping import Brightness, Step, largest_jump, orbit, scope
from playground.render.surface import surfaces
from playground.render.view import view_of


def test_the_orbit_is_a_circle_around_the_target():
    camera = pg.Camera(eye=(1, 2, 3), target=(0.5, 0.5, -1))
    start = np.subtract(camera.eye, camera.target)
    for angle in (0, 30, 90, 200):
        arm = np.subtract(orbit(camera, angle).eye, camera.target)
        assert np.linalg.norm(arm) == pytest.approx(np.linalg.norm(start))
        assert arm[1] == pytest.approx(start[1])
    flat = np.array([start[0], start[2]])
    turned = np.subtract(orbit(camera, 90).eye, camera.target)
    assert flat @ [turned[0], turned[2]] == pytest.approx(0, abs=1e-12)
    assert orbit(camera, 360).eye == pytest.approx(camera.eye)


def test_per_vertex_jumps_and_per_fragment_glides():
    setup = pg.load("popping").with_(tessellation=6)
    steps = list(scope(setup, range(0, 60, 4), size=(80, 60), renderer="numpy"))
    assert [step.angle for step in steps] == list(range(0, 60, 4))
    per_vertex = largest_jump(steps, "per-vertex").peak
    per_fragment = largest_jump(steps, "per-fragment").peak
    assert per_vertex > 0.1
    assert per_vertex > 3 * per_fragment


def test_the_reference_is_per_fragment_in_float64():
    steps = list(scope(pg.load("popping"), (0, 10), size=(60, 45), renderer="numpy"))
    for step in steps:
        assert step.modes["reference"] == step.modes["per-fragment"]


def test_largest_jump():
    steps = [Step(a, {"flat": Brightness(p, m)}) for a, p, m in [(0, 1, 5), (1, 3, 4), (2, 2, 4)]]
    assert largest_jump(steps, "flat") == Brightness(2, 1)
    assert largest_jump(steps[:1], "flat") == Brightness(0, 0)


def test_world_points_are_found_in_the_window():
    """A point on a surface appears at the pixel whose explanation names that point."""
    setup = pg.load("teapot")
    size = (160, 120)
    everything = surfaces(setup.scene, setup.settings.weights)
    view = view_of(setup.camera, everything, size)
    for pixel in [(70, 60), (90, 70), (50, 50)]:
        (point,) = pg.explain(setup, pixel, size).corners
        place, depth = view.window(point.position, size)
        np.testing.assert_allclose(place, np.add(pixel, 0.5), atol=1e-6)
        assert 0 < depth < 1
    behind, depth = view.window(2 * np.array(setup.camera.eye), size)
    assert np.isnan(behind).all()
    assert depth == np.inf
