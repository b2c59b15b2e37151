"""One colour per patch becomes one per corner: exact where light is linear, never negative."""

from dataclasses import replace

import numpy as np
import pytest

import playground as pg
from playground.files import mesh_file
from playground.render.radiosity.patch.corner_light import corner_light
from playground.render.radiosity.patch.divide import divide

SLOPES = np.array([[0.7, -0.2, 0.1], [0.3, 0.5, -0.4], [-0.1, 0.2, 0.6]])


def patches_of(*objects, patches=300):
    scene = pg.Scene(objects=objects, lights=(pg.PointLight(),))
    return divide(pg.Setup(scene).with_(patches=patches))


def linear(points):
    return 5.0 + points @ SLOPES


@pytest.mark.parametrize("patches", [24, 300])
@pytest.mark.parametrize(
    "item",
    [
        pg.Object("quad", transform=pg.Transform(rotate=(30, 40, 50), scale=(1, 1, 3))),
        pg.Object("disc", tessellation=7, transform=pg.Transform(rotate=(30, 40, 50))),
        pg.Object("box", transform=pg.Transform(rotate=(30, 40, 50))),
        pg.Object("cornell_floor_and_back.obj", transform=pg.Transform(size=0.002)),
    ],
    ids=lambda item: item.mesh,
)
def test_linear_light_stays_linear_to_the_rim(item, patches):
    if item.mesh.endswith(".obj"):
        item = replace(item, mesh=str(mesh_file(item.mesh, None)))
    found = patches_of(item, patches=patches)
    at_points = corner_light(found, linear(found.centre))
    # Some hundred roundings of sums of size 10; float32 corners off their plane by 1e-7
    np.testing.assert_allclose(at_points, linear(found.points), atol=2e-6)


def test_even_light_stays_even_everywhere():
    found = patches_of(pg.Object("teapot", tessellation=2), pg.Object("cone", tessellation=9))
    light = np.tile([0.2, 3.0, 0.0], (len(found), 1))
    np.testing.assert_allclose(corner_light(found, light), light[:1].repeat(len(found.points), 0))


def test_the_inside_of_a_square_is_the_mean_of_four():
    found = patches_of(pg.Object("quad"), patches=9)
    light = np.arange(27.0).reshape(9, 3) ** 2
    at_points = corner_light(found, light)
    for point in np.flatnonzero(np.bincount(found.corners.ravel()) == 4):
        around = np.flatnonzero((found.corners == point).any(axis=1))
        np.testing.assert_allclose(at_points[point], light[around].mean(axis=0), rtol=1e-12)


def test_no_light_is_negative_and_none_runs_away(rng):
    for item in (pg.Object("sphere", tessellation=9), pg.Object("box"), pg.Object("disc")):
        found = patches_of(item, patches=200)
        light = rng.random((len(found), 3)) ** 8
        light[rng.random(len(found)) < 0.5] = 0.0
        at_points = corner_light(found, light)
        assert at_points.min() >= 0.0
        assert at_points.max() <= 2.0 * light.max()


def test_light_does_not_cross_a_crease():
    found = patches_of(pg.Object("box"), pg.Object("box"), patches=150)
    face = found.parent.astype(float)[:, None] * [1.0, 2.0, 3.0]
    at_points = corner_light(found, face)
    np.testing.assert_allclose(at_points[found.corners], face[:, None].repeat(4, 1), atol=1e-12)


def test_one_patch_alone_has_its_light_at_all_corners():
    found = patches_of(pg.Object("quad"), patches=1)
    np.testing.assert_array_equal(corner_light(found, np.array([[1.0, 2, 3]])), [[1.0, 2, 3]] * 4)


def test_a_strip_carries_light_along_itself():
    found = patches_of(pg.Object("quad", transform=pg.Transform(scale=(8, 1, 0.1))), patches=20)
    assert found.parents.grid.min() == 1
    light = 1.0 + np.abs(found.centre[:, :1] + 8.0) * [1.0, 0.5, 0.0]
    expected = 1.0 + np.abs(found.points[:, :1] + 8.0) * [1.0, 0.5, 0.0]
    np.testing.assert_allclose(corner_light(found, light), expected, atol=1e-9)
