"""The exact pictures against what is known of the surfaces, and against fine meshes."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

import playground as pg
from playground.errors import PlaygroundError
from playground.measure.analytic import (
    exact_picture,
    hit_sphere,
    hit_torus,
    pixel_rays,
    torus_distance,
)
from playground.measure.pictures import picture, picture_errors
from playground.render.surface import surfaces
from playground.render.view import view_of
from playground.scene.transform import Transform

SIZE = (80, 60)


def rays(rng, count=2000):
    origin = np.array([0.4, 2.0, 3.0])
    directions = rng.normal(size=(count, 3)) * 0.3 - origin
    return origin, directions * rng.uniform(0.1, 10.0, size=(count, 1))


def test_where_a_ray_meets_the_sphere(rng):
    origin, directions = rays(rng)
    distance = hit_sphere(origin, directions)
    hit = np.isfinite(distance)
    assert 500 < hit.sum() < 2000
    points = origin + distance[hit, None] * directions[hit]
    # A few roundings of coordinates of size 4: 4 · 8 · 2^-53.
    np.testing.assert_allclose(np.linalg.norm(points, axis=-1), 1.0, rtol=0, atol=4e-15)
    assert (np.sum(points * directions[hit], axis=-1) <= 1e-12).all()  # the near side
    unit = directions / np.linalg.norm(directions, axis=-1, keepdims=True)
    nearest = np.linalg.norm(np.cross(np.broadcast_to(origin, unit.shape), unit), axis=-1)
    assert (hit == (nearest <= 1.0)).all()
    assert np.isinf(hit_sphere(origin, -directions)).all()


def test_where_a_ray_meets_the_torus(rng):
    origin, directions = rays(rng)
    distance = hit_torus(origin, directions)
    hit = np.isfinite(distance)
    assert 300 < hit.sum() < 2000
    points = origin + distance[hit, None] * directions[hit]
    assert np.abs(torus_distance(points)).max() < 1e-9  # ten times where the march stops
    # Nothing of the torus lies before the hit, nor anywhere on a ray that misses.
    reach = np.where(hit, distance, 6.0 / np.linalg.norm(directions, axis=-1))
    for share in np.linspace(0.0, 0.999, 200):
        along = origin + (share * reach)[:, None] * directions
        assert torus_distance(along).min() > -1e-9


def test_rays_go_through_the_pixels_that_show_their_points():
    setup = pg.load("sphere")
    drawn = surfaces(setup.scene, setup.settings.weights)
    view = view_of(setup.camera, drawn, SIZE)
    pixels, _ = view.window(view.eye + 1.7 * pixel_rays(view, SIZE), SIZE)
    rows, columns = np.mgrid[0 : SIZE[1], 0 : SIZE[0]]
    np.testing.assert_allclose(pixels[..., 0], columns + 0.5, rtol=0, atol=1e-10)
    np.testing.assert_allclose(pixels[..., 1], rows + 0.5, rtol=0, atol=1e-10)


@pytest.mark.parametrize("shape", ["sphere", "torus"])
def test_finer_meshes_come_closer_as_the_square_of_the_tessellation(shape):
    setup = pg.load("sphere").with_(mesh=shape)
    exact = exact_picture(setup, SIZE)
    errors = [
        picture_errors(
            picture(setup.with_(tessellation=n), SIZE, "numpy"), exact.image, "", exact.covered
        )
        for n in (32, 64, 128)
    ]
    # Chords leave the surface by a share of 1/N²: halving them takes the error to a quarter; a
    # half would be the order below, an eighth the one above. The mean, because on the torus a
    # pixel beside an inner edge may see another part.
    for coarse, fine in pairwise(errors):
        assert 2.8 < coarse.mean / fine.mean < 5.7
    assert errors[-1].left_out <= errors[0].left_out


def test_a_transformed_object_is_met_where_it_stands():
    moved = Transform(translate=(0.3, -0.2, 0.1), rotate=(20.0, 30.0, 40.0), scale=(1.2, 0.7, 0.9))
    setup = pg.load("sphere").with_(tessellation=256)
    setup = setup.with_(objects=(pg.Object("sphere", tessellation=256, transform=moved),))
    exact = exact_picture(setup, SIZE)
    found = picture_errors(picture(setup, SIZE, "numpy"), exact.image, "", exact.covered)
    assert found.rmse < 2e-3
    assert found.left_out <= 4


def test_what_has_no_exact_picture_is_refused():
    with pytest.raises(
        PlaygroundError, match=r"no exact picture.*teapot.*sphere, icosphere, torus"
    ):
        exact_picture(pg.load("teapot"), SIZE)


def test_errors_are_taken_where_both_cover_and_of_what_a_screen_shows():
    setup = pg.load("sphere").with_(background=(0, 0, 0))
    want = picture(setup, SIZE, "numpy")
    covered = want.coverage > 0.5
    covered[:, ::2] = False  # as if the reference showed nothing there
    pixels = want.pixels.copy()
    inside = np.argwhere(covered)
    pixels[tuple(inside[0])] += 0.25
    pixels[tuple(inside[1])] = np.nan
    was = want.pixels[tuple(inside[1])]
    found = picture_errors(replace(want, pixels=pixels), want, "", covered)
    count = len(inside)
    assert found.max == pytest.approx(max(0.25, was.max()))
    assert found.rmse == pytest.approx(np.sqrt((3 * 0.25**2 + (was**2).sum()) / (3 * count)))
    assert found.off == pytest.approx(2 / count)
    assert found.left_out == int((want.coverage > 0.5).sum()) - count
    assert found.more == {"pixels not finite": 1.0}
    assert picture_errors(want, want, "").more == {}
