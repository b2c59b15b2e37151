"""Balls and mirrors on the GPU, where its formulas are not those of NumPy, in float32 and float64.

Shadow rays ask of a ball no more than whether it stands in the way; a ray that is reflected is not
made unit again; a ray starts off its surface without rounding away. The tolerances are those of
test_gl_tracer.py.
"""

from dataclasses import replace

import numpy as np
import pytest
from test_gl_tracer import SIZE, assert_one_picture, reference, traced

import playground as pg
from playground.render.gl.trace.tracer import GLTracer
from playground.scene.light import DirectionalLight, PointLight
from playground.scene.material import Material
from playground.scene.scene import Object
from playground.scene.transform import Transform

pytestmark = pytest.mark.gl
MATT = Material(diffuse=(0.6, 0.5, 0.4), ambient=(0.1, 0.1, 0.1), specular=(0.0, 0.0, 0.0))
LAMP = (0.6, 0.9, 0.8)


def ball(at, size, **more):
    return Object("sphere", material=replace(MATT, **more), transform=Transform(at, size=size))


FLOOR = Object("quad", material=MATT, transform=Transform((0.0, -0.5, 0.0), size=3.0))


def scene(*objects, light=None, **settings):
    setup = pg.load("whitted-room").with_(eye=(0.0, 0.5, 4.0), target=(0.0, 0.0, 0.0), **settings)
    lights = (light or PointLight(position=LAMP),)
    return replace(setup, scene=replace(setup.scene, objects=objects, lights=lights))


@pytest.mark.parametrize(
    "balls",
    [
        pytest.param((ball((0.3, 0.2, 0.3), 0.3),), id="before the lamp"),
        pytest.param((ball((1.2, 1.8, 1.6), 0.6),), id="behind the lamp"),
        pytest.param((ball(LAMP, 0.3),), id="around the lamp"),
        pytest.param((ball((0.0, 0.0, 0.0), 9.0),), id="around everything"),
        pytest.param((ball((0.0, 0.5, 4.0), 0.5), ball((0.0, 0.0, 0.0), 0.4)), id="around the eye"),
        pytest.param((ball((0.0, -1000.5, 0.0), 1000.0), ball((0, 0, 0), 0.4)), id="a large floor"),
        pytest.param((ball((0.0, 0.3, 0.3), 1e-2), ball((0.2, 0.3, 0.3), 3e-3)), id="small ones"),
    ],
)
@pytest.mark.parametrize("light", [PointLight(position=LAMP), DirectionalLight()])
def test_what_a_ball_hides_from_a_lamp(gl, balls, light):
    setup = scene(FLOOR, *balls, light=light)
    assert_one_picture(traced(setup), reference(setup), 4, 0)


@pytest.mark.parametrize("depth", [8, 9, 100])
def test_rays_keep_their_way_between_many_mirrors(gl, depth):
    """A ball between two mirrors that face each other, each image smaller than the one before."""
    share = {"reflectance": (0.98, 0.98, 0.98), "diffuse": (0.0, 0.0, 0.0)}
    mirror = replace(MATT, ambient=(0.0, 0.0, 0.0), **share)
    place = Transform((0.0, 0.0, -1.0), rotate=(90.0, 0.0, 0.0), size=1.5)
    other = Transform((0.3, 0.0, 5.0), rotate=(-88.0, 0.0, 2.0), size=1.5)
    walls = (Object("quad", material=mirror, transform=where) for where in (place, other))
    setup = scene(*walls, ball((0.2, 0.0, 0.0), 0.3), depth=depth, threshold=0.0)
    drawn, expected = traced(setup), reference(setup)
    assert_one_picture(drawn, expected, 96, 10)
    assert np.abs(drawn.left_out.mean - expected.left_out.mean) <= 0.03 * expected.left_out.mean


def test_one_tracer_keeps_what_is_left_out_of_grey_and_of_coloured_scenes(gl):
    grey = scene(FLOOR, ball((0, 0, 0), 0.4, reflectance=(0.9, 0.9, 0.9)), depth=0)
    coloured = scene(FLOOR, ball((0, 0, 0), 0.4, reflectance=(0.9, 0.5, 0.1)), depth=0)
    with GLTracer(SIZE) as tracer:
        for setup, share in (
            (grey, (0.9, 0.9, 0.9)),
            (coloured, (0.9, 0.5, 0.1)),
            (grey, (0.9, 0.9, 0.9)),
        ):
            lost = tracer.render(setup).left_out.weights
            assert lost.shape == (SIZE[1], SIZE[0], 3)
            assert np.array_equal(np.unique(lost[lost.any(axis=-1)], axis=0), [np.float32(share)])


@pytest.mark.parametrize("depth", [1, 8, 9])
def test_rays_that_wait_find_their_place_again(gl, depth):
    """Up to a depth of 8 each depth has a place of its own, beyond they are a stack."""
    setup = pg.load("whitted-room").with_(depth=depth, threshold=0.0)
    assert_one_picture(traced(setup), reference(setup), 96, 10)
