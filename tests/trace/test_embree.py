"""Embree finds the same triangles as our own walk, and the same pictures follow."""

import sys

import numpy as np
import pytest

import playground as pg
from playground.errors import PlaygroundError
from playground.measure.ray_kinds import bumpy_ball, ray_kinds
from playground.render.trace import walk
from playground.render.trace.bvh import bvh_of
from playground.scene.shapes_curved import icosphere

embree = pytest.importorskip("playground.render.trace.embree")
pytest.importorskip("embreex")


@pytest.mark.parametrize("number", [0, 1, 2], ids=["primary", "shadow", "diffuse"])
def test_same_hits_as_the_walk(number: int) -> None:
    bvh = bvh_of(bumpy_ball())
    rays = ray_kinds(bvh, (192, 144))[number]
    given = bvh, rays.origin, rays.direction, rays.limit
    t, triangle, weights = embree.closest(*given)
    want_t, want_triangle, want_weights = walk.closest(*given)
    # A ray whose distance from an edge is within float32 of 0 may meet the neighbour, or miss
    # at a silhouette: at most as many as the edges' share of the area at that width.
    other = triangle != want_triangle
    assert other.mean() < 1e-3
    same = ~other & (triangle >= 0)
    assert same.sum() > 50
    # Both are float64: a few roundings of numbers up to 6, over the cosine of grazing angles.
    assert np.abs(t - want_t)[same].max(initial=0.0) < 1e-12
    assert np.abs(weights - want_weights)[same].max(initial=0.0) < 1e-10
    assert np.array_equal(embree.blocked(*given), triangle >= 0)


def test_a_ray_does_not_meet_the_surface_that_it_leaves() -> None:
    bvh = bvh_of(icosphere(8))
    rng = np.random.default_rng(3)
    corners = bvh.corners.astype(np.float64)
    at = corners.mean(axis=1)
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    random = rng.normal(size=at.shape)
    along = random - np.sum(random * normal, axis=1, keepdims=True) * normal
    along += normal * rng.uniform(1e-7, 1e-2, (len(at), 1))  # from a ball, outwards: free
    start = at + 1e-14 * normal
    assert not embree.blocked(bvh, start, along, np.inf).any()


def test_an_empty_list_of_rays() -> None:
    t, triangle, weights = embree.closest(
        bvh_of(icosphere(2)), np.zeros((0, 3)), np.zeros((0, 3)), np.inf
    )
    assert t.shape == (0,) and triangle.shape == (0,) and weights.shape == (0, 3)


def test_same_picture_of_a_mesh_in_glass() -> None:
    setup = pg.load("glass-ring").with_(surfaces="triangles")
    own = pg.render(setup, (80, 60), "numpy", "ray-tracing")
    theirs = pg.render(setup, (80, 60), "embree", "ray-tracing")
    assert theirs.renderer == "embree"
    off = np.abs(own.pixels - theirs.pixels).max(axis=-1) > 1e-6
    # Rays that graze an edge of one of its triangles may go another way, here for good.
    assert off.mean() < 0.01


def test_it_only_traces_rays() -> None:
    with pytest.raises(PlaygroundError, match="only traces rays"):
        pg.render(pg.load("sphere"), (8, 8), "embree")


def test_a_missing_package_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "embreex", None)
    with pytest.raises(PlaygroundError, match="pip install embreex"):
        pg.render(pg.load("sphere"), (8, 8), "embree", "ray-tracing")
