"""Hemicubes drawn by NumPy: against the closed form, and what they promise of odd scenes."""

from dataclasses import replace

import numpy as np
import pytest

import playground as pg
from playground.render.radiosity.factor.hemicube import Hemicubes, hemicube
from playground.render.radiosity.factor.hemicube_view import (
    NEAR,
    delta_form_factors,
    drawn_pieces,
    faces_of,
)
from playground.render.radiosity.patch.divide import divide
from playground.shading.area_light import form_factor
from tests.radiosity.plates import adjacent_plates, cube, patches_of, rectangle, room


def from_the_centre(patches, chosen):
    """The exact factors from the centres of patches, nothing in between, (K, N)."""
    centre, normal = patches.centre[chosen], patches.normal[chosen]
    return np.stack([form_factor(centre, normal, q, False) for q in patches.polygon], axis=1)


def border(items, patch):
    """Pixels of an item buffer beside which, in their face, lies one that differs in ``patch``."""
    found = []
    for face in faces_of(items == patch + 1):
        padded = np.pad(face, 1, mode="edge")
        windows = np.lib.stride_tricks.sliding_window_view(padded, (3, 3))
        found.append(windows.any(axis=(2, 3)) & ~windows.all(axis=(2, 3)))
    return np.concatenate(found)


def moved(patches, scale, by):
    """The same scene elsewhere and in another size."""
    corners = patches.parents.corners * scale + by
    parents = replace(patches.parents, corners=corners)
    return replace(patches, points=patches.points * scale + by, parents=parents)


def test_a_form_factor_is_off_by_no_more_than_its_border():
    """A pixel is wrong only where the border of a patch goes through it."""
    patches = cube(3)
    chosen = np.arange(0, len(patches), 5)
    cubes, deltas = Hemicubes(patches), delta_form_factors(64)
    error = np.abs(cubes.rows(chosen) - from_the_centre(patches, chosen))
    for i, row in zip(chosen, error, strict=True):
        items = cubes.item_buffer(i)
        limit = np.array([deltas[border(items, j)].sum() for j in range(len(patches))])
        assert (row <= limit).all()


@pytest.mark.parametrize("seed", [1, 2])
def test_the_error_falls_faster_than_the_resolution_grows(seed):
    """Along a border N pixels are wrong by half of 1/N² each way: N^-1.5 if their signs vary."""
    rng = np.random.default_rng(seed)
    count = 150
    start = rng.normal(size=(count, 3))
    start *= rng.uniform(1, 3, (count, 1)) / np.linalg.norm(start, axis=1, keepdims=True)
    start[:, 2] = np.abs(start[:, 2])
    u, v = 0.5 * rng.normal(size=(2, count, 3))
    away = np.einsum("ki,ki->k", np.cross(u, v), start) > 0
    u[away], v[away] = v[away], u[away]
    quads = np.stack([start, start + u, start + u + v, start + v], axis=1)
    below = rectangle((-0.1, -0.1, 0), (0.2, 0, 0), (0, 0.2, 0))
    patches = patches_of([below, *quads], [(1, 1)] * (count + 1))
    want = from_the_centre(patches, [0])
    sizes = np.array([16, 32, 64, 128, 256])
    errors = [np.sqrt(np.mean((hemicube(patches, [0], False, size) - want) ** 2)) for size in sizes]
    slope = np.polyfit(np.log(sizes), np.log(errors), 1)[0]
    assert -2.0 < slope < -1.3
    assert errors[2] < 5e-4


@pytest.mark.parametrize("plain", [False, True])
@pytest.mark.parametrize("patches", [cube(4), room(4, 2)], ids=["cube", "room"])
def test_rows_of_a_closed_scene_sum_to_1(patches, plain):
    rows = Hemicubes(patches, resolution=32, plain=plain).rows(np.arange(len(patches)))
    # No pixel is empty; what is left are the roundings of the sum of 3072 numbers.
    assert np.abs(rows.sum(axis=1) - 1.0).max() < 1e-12


def test_looking_patches_up_in_parents_costs_no_accuracy():
    patches = cube(6)
    chosen = np.arange(0, len(patches), 3)
    want = from_the_centre(patches, chosen)
    parents, plain = (Hemicubes(patches, plain=p).rows(chosen) for p in (False, True))
    errors = [np.abs(rows - want).sum() / want.sum() for rows in (parents, plain)]
    # Pixels differ where positions are rounded to 1/256: a share of 2/256 of those at a border,
    # each way.
    assert np.abs(parents - plain).sum() / want.sum() < 4 / 256 * errors[1] * 8
    assert errors[0] == pytest.approx(errors[1], rel=4 / 256)


def test_triangles_and_uneven_quads_are_looked_up_too():
    patches = divide(pg.load("cornell-box").with_(patches=400))
    pieces = drawn_pieces(patches)
    divided = (pieces.grid > 1).any(axis=1)
    corners = pieces.corners
    uneven = np.abs(corners[:, 0] - corners[:, 1] + corners[:, 2] - corners[:, 3]).max(axis=1)
    assert (divided & pieces.triangle).any()
    assert (divided & ~pieces.triangle & (uneven > 1e-6 * np.abs(corners).max())).any()
    parents, plain = (Hemicubes(patches, plain=p) for p in (False, True))
    differing = [
        np.mean(parents.item_buffer(i) != plain.item_buffer(i)) for i in range(0, len(patches), 7)
    ]
    assert max(differing) < 4 / 256  # of all pixels; borders go through fewer


def test_patches_of_irregular_parents_are_drawn_themselves():
    patches = cube(4)
    regular = np.array([True, False, True, False, False, True])
    mixed = replace(patches, parents=replace(patches.parents, regular=regular))
    assert len(drawn_pieces(mixed).first) == 3 + 3 * 16
    some, whole = Hemicubes(mixed).item_buffer(5), Hemicubes(patches).item_buffer(5)
    assert np.mean(some != whole) < 4 / 256  # of all pixels; borders go through fewer


def test_turning_hemicubes_breaks_aliasing():
    """In a box the rows of pixels run along the borders of patches, unless they are turned."""
    patches = cube(6)
    chosen = np.arange(0, len(patches), 3)
    want = from_the_centre(patches, chosen)
    turned, straight = (
        np.abs(Hemicubes(patches, rotate=r).rows(chosen) - want).sum() for r in (True, False)
    )
    assert turned < 0.75 * straight


def test_the_turn_belongs_to_the_patch():
    patches = cube(2)
    rows = Hemicubes(patches, resolution=16).rows([5, 3, 5])
    assert np.array_equal(rows[0], rows[2])
    assert np.array_equal(rows[1], Hemicubes(patches, resolution=16).rows([3])[0])


def test_touching_patches_do_not_vanish():
    patches = adjacent_plates(4)
    chosen = np.arange(16)
    wall = hemicube(patches, chosen)[:, 16:].sum(axis=1)
    want = from_the_centre(patches, chosen)[:, 16:].sum(axis=1)
    # The outline of the wall is at most 4 x 64 pixels long, of 4/(π 64²) each at most; half of
    # each may be wrong.
    assert np.abs(wall - want).max() < 128 * 4 / (np.pi * 64**2)
    beside = np.argmin(np.abs(patches.centre[chosen, 0]))
    assert wall[beside] > 0.25


def test_in_a_sharp_corner_the_near_plane_takes_nothing_away():
    angle = np.radians(10.0)  # sin = 0.17: the plate comes as near as that share of the way
    roof = rectangle((0, 0, 0), (0, 1, 0), (np.cos(angle), 0, np.sin(angle)))
    floor = rectangle((0, 0, 0), (1, 0, 0), (0, 1, 0))
    patches = patches_of([floor, roof], [(1, 1), (1, 1)])
    got, want = hemicube(patches, [0], True, 256)[0, 1], from_the_centre(patches, [0])[0, 1]
    assert got == pytest.approx(want, abs=512 * 4 / (np.pi * 256**2))
    assert want > 0.9


@pytest.mark.parametrize(("times", "seen"), [(0.9, False), (4.0, True)])
def test_what_lies_in_a_small_cube_around_the_centre_is_not_seen(times, seen):
    """A lid over the centre, in the size of that cube and at half its height."""
    near = 0.5 * NEAR * times
    floor = rectangle((-0.5, -0.5, 0), (1, 0, 0), (0, 1, 0))
    lid = rectangle((-near, -near, 0.5 * near), (0, 2 * near, 0), (2 * near, 0, 0))
    patches = patches_of([floor, lid], [(1, 1), (1, 1)])
    got, want = hemicube(patches, [0])[0, 1], from_the_centre(patches, [0])[0, 1]
    if seen:
        assert got == pytest.approx(want, abs=256 * 4 / (np.pi * 64**2))
    else:
        assert got == 0.0
    assert want > 0.7


def test_a_back_blocks_and_is_no_patch():
    below = rectangle((-1, -1, 0), (2, 0, 0), (0, 2, 0))
    above = rectangle((-1, -1, 2), (0, 2, 0), (2, 0, 0))
    between = rectangle((-5, -5, 1), (10, 0, 0), (0, 10, 0))  # faces up, away from the lower plate
    patches = patches_of([below, above, between], [(2, 2), (2, 2), (1, 1)])
    rows = hemicube(patches, np.arange(9))
    assert not rows[:4].any()
    assert (rows[4:8, 8] > 0.8).all() and not rows[4:8, :8].any()
    unblocked = hemicube(patches, np.arange(9), occlusion=False)
    assert (unblocked[:4, 4:8] > 0.0).all() and not unblocked[:4, 8].any()


def test_without_occlusion_every_patch_counts_by_itself():
    patches = room(3, 2)
    chosen = np.arange(0, len(patches), 4)
    got, want = hemicube(patches, chosen, False, 128), from_the_centre(patches, chosen)
    assert got.sum(axis=1).max() > 1.5
    # By a pixel all along a border of at most 4 x 128 of them, at most.
    assert np.abs(got - want).max() < 512 * 4 / (np.pi * 128**2)


@pytest.mark.parametrize("scale", [2.0**-60, 2.0**70])
def test_tiny_and_huge_scenes_have_the_same_rows(scale):
    patches, other = room(3, 2), moved(room(3, 2), scale, 0.0)
    chosen = np.arange(0, len(patches), 9)
    assert np.array_equal(hemicube(patches, chosen), hemicube(other, chosen))


def test_far_from_the_origin_only_rounding_differs():
    patches, other = room(3, 2), moved(room(3, 2), 1.0, [1e6, -2e6, 5e5])
    near, far = Hemicubes(patches), Hemicubes(other)
    differing = [
        np.count_nonzero(near.item_buffer(i) != far.item_buffer(i))
        for i in range(0, len(patches), 9)
    ]
    # Coordinates are off by 2e-10, far below 1/256 pixel: what differs are pixels whose centre
    # lies exactly on a border. That is a line of them at most, and none as a rule.
    assert max(differing) <= 64
    assert np.median(differing) == 0
