"""What stands between patches: exact where it can be, and never a patch's own plane."""

import numpy as np
import pytest
from plates import BELOW, adjacent_plates, cube, patches_of, rectangle, room

import playground as pg
from playground.render.radiosity.factor.closed_form import closed_form
from playground.render.radiosity.factor.form_factors import point_to_point
from playground.render.radiosity.factor.pairs import (
    _share,
    _touched,
    by_size,
    exact,
    looks,
    segments,
    visible,
)
from playground.render.radiosity.factor.visibility import between, can_hide, facing, lift_of
from playground.render.radiosity.patch.divide import divide

ABOVE = rectangle((0, 0, 1), (0, 1, 0), (1, 0, 0))  # faces −z
FIRST, SECOND = np.array([0]), np.array([1])


def everything(patches):
    return np.arange(len(patches))


def turned(corners, offset=0.0):
    """Corners turned by odd angles, so that nothing is parallel to an axis, and moved."""
    a, b = 0.7, 0.4
    x = np.array([[1, 0, 0], [0, np.cos(a), -np.sin(a)], [0, np.sin(a), np.cos(a)]])
    y = np.array([[np.cos(b), 0, np.sin(b)], [0, 1, 0], [-np.sin(b), 0, np.cos(b)]])
    return np.asarray(corners) @ (x @ y).T + offset


def test_walls_of_a_room_hide_nothing_blocks_in_it_do():
    assert not can_hide(cube(2)).any()
    assert between(cube(2)).tree.nodes == 0, "no ray is tested against a wall"
    assert can_hide(room(2, 1)).tolist() == [False] * 6 + [True] * 12


def test_what_stands_out_of_a_plane_by_the_rounding_of_float32_hides_nothing():
    """In the Cornell box the blocks are put onto the floor, and its walls are not upright."""
    patches = divide(pg.load("cornell-box").with_(patches=100))
    hiding = patches.parents.corners[can_hide(patches)]
    assert len(hiding) == 10  # five faces of each block
    assert hiding[..., 1].max() == pytest.approx(330.0, abs=1e-3)  # the height of the tall one


def test_no_segment_is_sent_past_the_box_around_what_can_hide():
    patches = divide(pg.load("cornell-box").with_(patches=300))
    i, j = np.triu_indices(len(patches), 1)
    seen = facing(patches, i, j)
    i, j = i[seen], j[seen]
    past = ~_touched(patches, i, j)
    assert 0.2 < past.mean() < 0.5
    assert (_share(patches, i[past], j[past], segments(3)) == 1.0).all()
    assert (visible(patches, i[past], j[past], 3) == 1.0).all()


def test_patches_face_each_other_if_a_part_of_each_is_before_the_other():
    patches = patches_of([BELOW, ABOVE, BELOW + np.array([2, 0, 0]), BELOW[::-1]], [(1, 1)] * 4)
    pairs = [(0, 1), (0, 2), (0, 3), (1, 3), (1, 2)]
    found = [facing(patches, np.array([i]), np.array([j])).item() for i, j in pairs]
    assert found == [True, False, False, False, True]


@pytest.mark.parametrize("rays", [2, 3, 4])
def test_a_wall_between_patches_hides_exactly_what_is_beyond(rays):
    # It stands upright on the edge between patches: a pair sees all of each other, or nothing.
    wall = rectangle((0.5, -1, -1), (0, 3, 0), (0, 0, 3))
    with_wall = patches_of([BELOW, ABOVE, wall], [(2, 2), (2, 2), (1, 1)])
    without = patches_of([BELOW, ABOVE], [(2, 2)] * 2)
    left = without.centre[:, 0] < 0.5
    expected = closed_form(without, everything(without)) * (left[:, None] == left)
    found = closed_form(with_wall, everything(with_wall), rays=rays)[:8, :8]
    np.testing.assert_array_equal(found, expected)


@pytest.mark.parametrize("upside_down", [False, True], ids=["front", "back"])
@pytest.mark.parametrize("rays", [2, 4])
def test_screens_over_either_half_of_a_plate_share_what_arrives(rays, upside_down):
    # The screen all but touches the plate: each segment ends under the one half or the other.
    shares = []
    for start in (-0.5, 0.5):
        screen = rectangle((start, -0.5, 1e-6), (1, 0, 0), (0, 2, 0))
        screen = screen[::-1] if upside_down else screen
        patches = patches_of([BELOW, ABOVE, screen], [(1, 1)] * 3)
        shares.append(visible(patches, FIRST, SECOND, rays).item())
    assert sum(shares) == pytest.approx(1.0, rel=1e-12)


TRIANGLE = np.array([(0.0, 0.1, 1.0), (0.3, 1.0, 1.0), (1.0, 0.0, 1.0)])
SCREEN = rectangle((-1, -1, 0.4), (1.45, 0, 0), (0, 2.3, 0))


@pytest.mark.parametrize("above", [ABOVE, TRIANGLE], ids=["square", "triangle"])
def test_the_corner_that_is_listed_first_changes_nothing(above):
    found = []
    for turn in range(len(above)):
        corners = np.roll(above, turn, axis=0)
        if len(corners) == 3:
            corners = corners[[0, 1, 2, 2]]
        patches = patches_of([np.roll(BELOW, turn, axis=0), corners, SCREEN], [(1, 1)] * 3)
        share = visible(patches, FIRST, SECOND, 5).item()
        assert 0.1 < share < 0.9
        found.append((share, *closed_form(patches, everything(patches))[0]))
    # Hundreds of roundings of numbers below 1, of areas that are summed from other corners
    np.testing.assert_allclose(found, found[:1] * len(found), rtol=0, atol=1e-13)


def test_patches_of_one_size_are_told_apart_by_where_they_are():
    row = [BELOW + np.array([2.0 * k, 0, 0]) for k in range(3)]
    ranks = [
        patches_of(np.array(row)[order], [(1, 1)] * 3).rank for order in ([0, 1, 2], [2, 0, 1])
    ]
    assert ranks[0].tolist() == [0, 1, 2] and ranks[1].tolist() == [2, 0, 1]
    sizes = patches_of([2.0 * BELOW, BELOW], [(1, 1)] * 2)
    assert sizes.rank.tolist() == [1, 0]


@pytest.mark.parametrize("rays", [3, 5, 7, 11, 17])
def test_any_two_numbers_of_a_segment_take_every_pair_of_values(rays):
    places = np.rint(segments(rays) * rays - 0.5).astype(int)
    for one in range(4):
        for other in range(one):
            assert len(set(zip(places[:, one], places[:, other], strict=True))) == rays * rays


def test_more_segments_are_sent_only_where_the_first_disagree():
    patches = patches_of([BELOW, ABOVE, SCREEN], [(3, 3), (3, 3), (1, 1)])
    i, j = (x.ravel() for x in np.meshgrid(np.arange(9), np.arange(9, 18)))
    corners, whole = (_share(patches, i, j, x) for x in (looks(), segments(5)))
    some = (corners > 0.0) & (corners < 1.0)
    assert 0 < some.sum() < len(some)
    np.testing.assert_array_equal(visible(patches, i, j, 5), np.where(some, whole, corners))
    np.testing.assert_array_equal(visible(patches, i, j, 5, look=False), whole)


def test_half_shadows_of_coarse_patches_are_right_within_a_percent():
    # 17² segments in all four numbers are the reference: they differ by 0.1 % from 31². Of these
    # rows, 2 × 2 segments are off by 1.5 %, 2 × 2 and then 5 × 5 by 0.6 %.
    patches = room(8, 3)
    i, j = (x.ravel() for x in np.meshgrid(np.arange(0, 384, 29), np.arange(len(patches))))
    meet = facing(patches, i, j)
    i, j = by_size(patches, i[meet], j[meet])
    power = exact(patches, i, j)
    right = power * visible(patches, i, j, 17, look=False)
    off = [
        np.abs(power * visible(patches, i, j, rays, look) - right).sum() / right.sum()
        for rays, look in ((5, True), (2, False))
    ]
    assert off[0] < 0.01 < off[1]


@pytest.mark.parametrize("offset", [0.0, 1000.0])
def test_neither_a_patch_nor_its_coplanar_neighbours_stand_in_its_way(offset):
    # A floor of two triangles and a wall on it; something is on the other side of each, so that
    # all of them may hide something.
    floor = [BELOW[[0, 1, 2, 2]], BELOW[[0, 2, 3, 3]]]
    wall = [rectangle((0, 0, 0), (0, 1, 0), (0, 0, 1))]
    beyond = [rectangle((-1, -1, -1), (3, 0, 0), (0, 3, 0))]
    parents = turned([*floor, *wall, *beyond], offset)
    patches = patches_of(parents, [(4, 4)] * 4)
    assert can_hide(patches)[:3].all()
    shown = np.flatnonzero(patches.parent < 3)
    seen = closed_form(patches, shown)[:, shown]
    np.testing.assert_array_equal(seen, closed_form(patches, shown, occlusion=False)[:, shown])
    assert seen.any()


def test_bent_quads_do_not_stand_in_their_own_way():
    # Two triangles in float32 make a quad that is flat but for rounding: lifted by more than that
    patches = patches_of(turned([BELOW, ABOVE, BELOW - [0, 0, 1]]), [(3, 3)] * 3)
    corners = patches.parents.corners.astype(np.float32).astype(np.float64)
    bent = patches_of(corners, [(3, 3)] * 3)
    assert lift_of(patches) < 1e-13 < lift_of(bent) < 1e-6
    # Seen from points of the quad, which is bilinear between its corners
    i, j = (x.ravel() for x in np.meshgrid(np.arange(9), np.arange(9, 18)))
    np.testing.assert_array_equal(visible(bent, i, j, 4), 1.0)


def test_the_back_of_a_patch_hides_what_is_behind():
    screen = rectangle((-1, -1, 0.5), (3, 0, 0), (0, 3, 0))
    for corners in (screen, screen[::-1]):
        patches = patches_of([BELOW, ABOVE, corners], [(1, 1)] * 3)
        assert point_to_point(patches, [0])[0, 1] == 0.0
        assert closed_form(patches, [0])[0, 1] == 0.0


def test_a_common_edge_hides_nothing():
    patches = adjacent_plates(3)
    seen = closed_form(patches, everything(patches))
    np.testing.assert_array_equal(seen, closed_form(patches, everything(patches), False))
