"""The tree of boxes: nothing is lost in it, and no ray finds less than by trying everything."""

import gc

import numpy as np
import pytest

from playground.render.trace import bvh as tree
from playground.render.trace import growth, walk
from playground.render.trace.bvh import build, bvh_of
from playground.scene.shapes import make
from playground.scene.shapes_curved import icosphere, torus
from playground.scene.shapes_flat import box

SHAPES = ["teapot", "torus", "box", "grid"]


def soup(rng, count, scale=1.0):
    """Small triangles anywhere in the unit cube."""
    corners = rng.uniform(0.0, 1.0, (count, 1, 3)) + rng.normal(0.0, 0.02, (count, 3, 3))
    return scale * corners.reshape(-1, 3), np.arange(3 * count).reshape(-1, 3)


def all_in_one_leaf(positions, faces, monkeypatch):
    """A tree of a single leaf: a walk through it tests every triangle."""
    with monkeypatch.context() as patched:
        patched.setattr(growth, "SMALLEST_LEAF", len(faces))
        single = build(positions, faces)
    assert single.nodes == 1
    return single


def shot(rng, count, mesh_centre=0.0, mesh_size=1.0):
    """Rays from around a mesh towards it, of any length."""
    origin = rng.normal(0.0, 1.5, (count, 3))
    direction = rng.uniform(-0.7, 0.7, (count, 3)) - origin
    direction *= rng.uniform(0.1, 10.0, (count, 1))
    return mesh_centre + mesh_size * origin, mesh_size * direction


def check_sound(bvh, positions, faces):
    """Every triangle in one leaf, every node around its triangles, to the bit."""
    assert np.array_equal(np.sort(bvh.order), np.arange(len(faces)))
    assert np.array_equal(bvh.corners, positions[faces][bvh.order])
    leaves = np.flatnonzero(bvh.child < 0)
    slots = [np.arange(bvh.first[n], bvh.first[n] + bvh.count[n]) for n in leaves]
    assert np.array_equal(np.sort(np.concatenate(slots)), np.arange(len(faces)))
    assert bvh.count[leaves].max() <= growth.LARGEST_LEAF
    inner = np.flatnonzero(bvh.child >= 0)
    left = bvh.child[inner]
    assert np.array_equal(np.sort(np.concatenate([left, left + 1])), np.arange(1, bvh.nodes))
    assert np.array_equal(bvh.first[left], bvh.first[inner])
    assert np.array_equal(bvh.first[left + 1], bvh.first[left] + bvh.count[left])
    assert np.array_equal(bvh.count[left] + bvh.count[left + 1], bvh.count[inner])
    for node in range(bvh.nodes):
        inside = bvh.corners[bvh.first[node] :][: bvh.count[node]].astype(np.float64)
        assert np.all(bvh.low[node] <= inside.min(axis=(0, 1)))
        assert np.all(bvh.high[node] >= inside.max(axis=(0, 1)))


@pytest.mark.parametrize("name", SHAPES)
def test_a_tree_holds_every_triangle_once(name):
    mesh = make(name)
    bvh = build(mesh.positions, mesh.faces)
    check_sound(bvh, mesh.positions, mesh.faces)
    again = build(mesh.positions, mesh.faces)
    assert np.array_equal(bvh.order, again.order)
    assert np.array_equal(bvh.child, again.child)


@pytest.mark.parametrize("count", [1, 2, 3, 9, 100])
def test_small_and_coincident(rng, count):
    positions, faces = soup(rng, count)
    check_sound(build(positions, faces), positions, faces)  # float64: boxes rounded outwards
    same = np.tile(faces[:1], (count, 1))
    check_sound(build(positions, same), positions, same)
    point = np.zeros_like(positions)
    check_sound(build(point, faces), point, faces)
    line = positions * [1.0, 0.0, 0.0]
    check_sound(build(line, faces), line, faces)


def test_no_triangle_at_all():
    bvh = build(np.zeros((3, 3)), np.zeros((0, 3), int))
    assert (bvh.nodes, bvh.depth, bvh.cost) == (0, 0, 0.0)
    t, triangle, weights = walk.closest(bvh, np.zeros((4, 3)), np.ones((4, 3)), np.inf)
    assert np.array_equal(t, [-1.0] * 4)
    assert np.array_equal(triangle, [-1] * 4)
    assert weights.shape == (4, 3)
    assert not walk.blocked(bvh, np.zeros((4, 3)), np.ones((4, 3)), np.inf).any()


def test_no_ray_at_all():
    bvh = bvh_of(make("box"))
    t, triangle, weights = walk.closest(bvh, np.zeros((0, 3)), np.zeros((0, 3)), np.inf)
    assert t.shape == triangle.shape == (0,)
    assert weights.shape == (0, 3)


def test_no_mesh_makes_a_list_of_the_tree():
    # Each triangle half as far from 0 as the one before: a cut always separates only the largest.
    size = 0.5 ** np.arange(120)
    triangle = np.array([[1.0, 0.0, 0.0], [1.1, 0.1, 0.0], [1.0, 0.1, 0.1]])
    positions = (size[:, None, None] * triangle).reshape(-1, 3)
    faces = np.arange(360).reshape(-1, 3)
    bvh = build(positions, faces)
    check_sound(bvh, positions, faces)
    # From DEEPEST on, halving 120 triangles takes at most 7 more levels.
    assert bvh.depth <= growth.DEEPEST + 7


def test_cost_by_hand():
    # Two groups of three equal triangles, one at each end of a box of 10 x 1 x 0: half its surface
    # is 10, of each group's box 1 * 1. A random ray pays for the root and in each child with
    # a chance of 1/10 for three triangles.
    one = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    positions = np.concatenate([one, one + np.array([9.0, 0.0, 0.0])])
    bvh = build(positions, [[0, 1, 2]] * 3 + [[3, 4, 5]] * 3)
    assert bvh.nodes == 3
    expected = growth.BOX_COST + 0.1 * 3 + 0.1 * 3
    assert bvh.cost == pytest.approx(expected, rel=1e-12)  # float64 on exact float32 sides


@pytest.mark.parametrize("name", ["teapot", "torus"])
def test_cuts_cost_less_than_halves(name, monkeypatch):
    mesh = make(name)
    cut = build(mesh.positions, mesh.faces).cost
    monkeypatch.setattr(growth, "DEEPEST", 0)
    assert cut < build(mesh.positions, mesh.faces).cost


def test_levels_go_from_the_root_to_the_leaves():
    bvh = bvh_of(make("teapot"))
    boxes = [bvh.level(depth) for depth in range(bvh.depth)]
    assert sum(len(low) for low, _ in boxes) == bvh.nodes
    assert np.array_equal(boxes[0][0][0], make("teapot").positions.min(axis=0))
    assert len(boxes[1][0]) == 2


def test_a_tree_lives_as_long_as_its_mesh():
    gc.collect()
    before = len(tree._built)
    mesh = torus(8)
    assert bvh_of(mesh) is bvh_of(mesh)
    assert len(tree._built) == before + 1
    del mesh
    gc.collect()
    assert len(tree._built) == before


@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.parametrize(("place", "size"), [(0.0, 1.0), (4096.0, 2.0**-20), (0.0, 2.0**40)])
def test_walk_finds_what_trying_all_triangles_finds(rng, monkeypatch, name, place, size):
    mesh = make(name, 12)
    positions = place + size * mesh.positions.astype(np.float64)
    origin, direction = shot(rng, 400, place, size)
    direction[:40, 0] = 0.0
    direction[40:60, 1:] = 0.0
    limit = np.where(rng.random(400) < 0.5, np.inf, rng.uniform(0.0, 1.0, 400))
    bvh = build(positions, mesh.faces)
    single = all_in_one_leaf(positions, mesh.faces, monkeypatch)
    t, triangle, weights = walk.closest(bvh, origin, direction, limit)
    want, wanted, _ = walk.closest(single, origin, direction, limit)
    assert np.array_equal(t, want)
    assert 0 < np.sum(triangle >= 0) < 400
    # On an edge either neighbour may be named, at the same t; then one weight is 0.
    other = triangle != wanted
    assert np.all(weights[other].min(axis=1) == 0.0)
    assert np.array_equal(walk.blocked(bvh, origin, direction, limit), wanted >= 0)


def test_blocks_do_not_change_the_answer(rng, monkeypatch):
    bvh = bvh_of(make("teapot"))
    rays = shot(rng, 100)
    want = walk.closest(bvh, *rays, np.inf)
    monkeypatch.setattr(walk, "BLOCK", 7)
    for got, expected in zip(walk.closest(bvh, *rays, np.inf), want, strict=True):
        assert np.array_equal(got, expected)


@pytest.mark.parametrize("place", [0.0, 1e3, 1e6])
def test_nothing_slips_through_a_closed_mesh(rng, place):
    # From inside towards points on edges and vertices: rays within a rounding of two triangles.
    mesh = icosphere(12)
    positions = mesh.positions.astype(np.float64) + place
    bvh = build(positions, mesh.faces)
    a, b = positions[mesh.faces[:, 0]], positions[mesh.faces[:, 1]]
    share = rng.uniform(0.0, 1.0, (len(a), 1)).round(1)
    origin = place + rng.uniform(-0.5, 0.5, (len(a), 3))
    direction = a + share * (b - a) - origin
    triangle = walk.closest(bvh, origin, direction, np.inf)[1]
    assert np.all(triangle >= 0)
    assert walk.blocked(bvh, origin, direction, 1.5).all()


def test_a_ray_in_the_face_of_a_box_of_the_tree():
    # A flat mesh has flat boxes; rays straight onto their corners and edges count as hits.
    mesh = make("grid", 8)
    corner = mesh.positions.astype(np.float64)
    up = np.array([[0.0, 1.0, 0.0]]) if np.ptp(corner[:, 1]) == 0.0 else np.array([[0.0, 0.0, 1.0]])
    origin = corner + 2.0 * up
    t, triangle, _ = walk.closest(bvh_of(mesh), origin, np.repeat(-up, len(origin), 0), np.inf)
    assert np.array_equal(t, np.full(len(origin), 2.0))
    assert np.all(triangle >= 0)


def test_limit_is_where_a_ray_ends():
    bvh = bvh_of(box())
    origin, direction = np.array([[0.1, 0.2, 5.0]]), np.array([[0.0, 0.0, -1.0]])
    t, _, _ = walk.closest(bvh, origin, direction, np.inf)
    assert not walk.blocked(bvh, origin, direction, t)[0]
    assert walk.blocked(bvh, origin, direction, np.nextafter(t, np.inf))[0]
    assert not walk.blocked(bvh, origin, -direction, np.inf)[0]


def test_counts_of_tests(rng, monkeypatch):
    mesh = make("teapot")
    bvh = bvh_of(mesh)
    past = walk.count_tests(bvh, [[9.0, 9.0, 9.0]], [[1.0, 0.0, 0.0]], np.inf)
    assert (past[0][0], past[1][0]) == (1, 0)
    origin, direction = shot(rng, 200)
    boxes, triangles = walk.count_tests(bvh, origin, direction, np.inf)
    first, fewer = walk.count_tests(bvh, origin, direction, np.inf, any_hit=True)
    assert np.all(boxes % 2 == 1)  # the root, then two children at a time
    assert boxes.sum() + triangles.sum() > first.sum() + fewer.sum()
    single = all_in_one_leaf(mesh.positions, mesh.faces, monkeypatch)
    alone, every = walk.count_tests(single, origin, direction, np.inf)
    assert np.all(alone == 1)
    assert set(every) <= {0, len(mesh.faces)}
    assert triangles.sum() < 0.05 * every.sum()
