"""The plane through 5 × 5 texels: exact for linear light, stopped by walls and by true steps."""

import numpy as np
import pytest
from lit_scenes import GREY, box, lamp, setup

from playground.render.lightmap.atlas import unwrap
from playground.render.lightmap.gather import PATTERNS, Points
from playground.render.lightmap.smooth import count_split, smoothed
from playground.render.lightmap.surroundings import Surroundings
from playground.render.lightmap.texels import lay_out
from playground.render.radiosity.patch.divide import divide
from playground.scene.scene import Object

ANY = 1  # rays whose noise lets every step pass for noise


def floor_with(*others, size=64):
    floor = Object(mesh="quad", material=GREY)
    scene = setup([floor, *others], [lamp((0.0, 3.0, 0.0), 1.0)], patches=60)
    patches = divide(scene)
    texels = lay_out(scene.scene, unwrap(scene.scene, size), patches.origin)
    at = Points(texels.position, texels.normal, texels.side)
    return texels, at, np.zeros(len(texels), dtype=bool), Surroundings(patches)


def test_linear_light_stays_up_to_the_edges():
    texels, at, wrong, around = floor_with()
    column, row = texels.column.astype(float), texels.row.astype(float)
    values = np.stack([2.0 + 0.01 * column, 3.0 - 0.02 * row, 1.0 + 0.001 * (column + row)], axis=1)
    got = smoothed(values, ANY, texels, at, wrong, around)
    # A ridge of 1e-9 bends the plane by that share of it; the rest is the solution of 3 equations.
    assert np.abs(got - values).max() < 1e-8


def test_the_pattern_of_the_rays_goes():
    """What depends only on the place in a block of 4 × 4 becomes its mean, away from edges."""
    texels, at, wrong, around = floor_with()
    error = np.random.default_rng(6).normal(0.0, 0.01, PATTERNS)
    values = 1.0 + error[texels.column % 4 + 4 * (texels.row % 4)][:, None]
    got = smoothed(values, ANY, texels, at, wrong, around)
    low, high = texels.column.min() + 2, texels.column.max() - 2
    inner = (texels.column >= low) & (texels.column <= high)
    inner &= (texels.row >= texels.row.min() + 2) & (texels.row <= texels.row.max() - 2)
    assert np.abs(got[inner] - 1.0 - error.mean()).max() < 1e-9


def test_a_wall_stops_it():
    """Bright on one side of a wall, dark on the other: so it stays, to the bit on the dark side."""
    texels, at, wrong, around = floor_with(box((0.02, 0.3, 0.0), (0.005, 0.3, 1.0)))
    floor = texels.item == 0
    beyond = texels.position[:, 0] - 0.02
    assert (np.abs(beyond[floor]) > 0.005).all()  # it stands between texels
    dark = floor & (beyond > 0.0)
    values = np.where(dark[:, None], 0.0, 1.0) * np.ones(3)
    got = smoothed(values, ANY, texels, at, wrong, around)
    assert not got[dark].any()
    assert np.abs(got[floor & ~dark] - 1.0).max() < 1e-8
    # As many pairs of neighbours as the wall has texels of length lie on two sides of it.
    long = max(len(np.unique(line[dark])) for line in (texels.column, texels.row))
    assert count_split(texels, at, wrong, around) == pytest.approx(long, abs=4)


def test_without_walls_nothing_is_split():
    assert count_split(*floor_with()) == 0


def test_a_step_beyond_the_noise_stays():
    texels, at, wrong, around = floor_with()
    values = np.where(texels.position[:, :1] > 0.013, 0.2, 1.0) * np.ones(3)
    got = smoothed(values, 256, texels, at, wrong, around)
    assert np.abs(got - values).max() < 1e-8
