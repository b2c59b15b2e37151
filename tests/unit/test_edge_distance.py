"""The distance to edges, by which comparisons of rasterisers choose their pixels, is right."""

import numpy as np
import pytest
from edge_distance import edge_distance

from playground.render.raster.coverage import to_window

ONE = np.array([[0, 1, 2]])
SIZE = (24, 18)


def slow_distance(clip, faces, reach):
    """All pairs of pixels and edges; for triangles that need no clipping."""
    xy, _ = to_window(clip, SIZE)
    a, b = xy[faces].reshape(-1, 2), np.roll(xy[faces], -1, axis=1).reshape(-1, 2)
    centre = np.stack(np.meshgrid(*(np.arange(n) + 0.5 for n in SIZE)), axis=-1)[:, :, None]
    along = b - a
    share = ((centre - a) * along).sum(-1) / np.maximum((along**2).sum(-1), 1e-30)
    foot = a + np.clip(share, 0, 1)[..., None] * along
    distance = np.sqrt(((centre - foot) ** 2).sum(-1)).min(axis=-1)
    return np.where(distance <= reach, distance, np.inf)


@pytest.mark.parametrize("reach", [0.01, 0.05, 0.25])
def test_edge_distance_agrees_with_all_pairs(reach):
    rng = np.random.default_rng(6)
    xy = np.round(rng.uniform(-1.3, 1.3, (60, 2)) * 40) / 40
    clip = np.column_stack([xy, np.zeros(60), np.ones(60)])
    faces = np.concatenate([np.arange(60).reshape(-1, 3), [[0, 0, 1], [2, 2, 2]]])
    got, expected = edge_distance(clip, faces, SIZE, reach=reach), slow_distance(clip, faces, reach)
    np.testing.assert_allclose(got, expected, atol=1e-12)
    assert np.isfinite(got).any()


def test_edge_distance_sees_the_cut_of_the_near_plane():
    # The near plane cuts this triangle at ndc x = 0, between the pixel columns 11 and 12.
    clip = np.array([[-0.5, -0.5, -1.5, 1], [0.5, -0.5, -0.5, 1], [0.5, 0.5, -0.5, 1.0]])
    clip[:, 0] += 1 / 24  # now through the centres of column 12
    distance = edge_distance(clip, ONE, SIZE)
    assert (distance[12, 12] < 1e-9).all()
    assert np.isinf(distance[12, 15])
