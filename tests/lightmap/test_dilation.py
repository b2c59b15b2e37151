"""Dilation and bleeding, by hand: twins are compared in tests/parity, cases in tests/stability."""

import numpy as np
import pytest

from playground.shading.lightmap import bleed, dilated

HALF = 0.5


def image(values, covered):
    values = np.asarray(values, dtype=np.float64)
    return np.dstack([values, values, values, np.asarray(covered, dtype=np.float64)])


def everywhere(texels):
    rows, columns = np.indices(texels.shape[:2])
    return np.stack([columns, rows], axis=-1)


def test_one_texel_grows_by_one_all_around():
    covered = np.zeros((7, 7))
    covered[3, 3] = 1.0
    new = dilated(image(5.0 * covered, covered), everywhere(image(covered, covered)))
    assert np.array_equal(new[2:5, 2:5], np.full((3, 3, 4), (5.0, 5.0, 5.0, 1.0)))
    assert new.sum() == 9 * 16.0


def test_covered_texels_stay(rng):
    values = rng.uniform(0.0, 1.0, (9, 11))
    texels = image(values, rng.uniform(0.0, 1.0, (9, 11)) < 0.5)
    new = dilated(texels, everywhere(texels))
    assert np.array_equal(new[texels[..., 3] > 0.0], texels[texels[..., 3] > 0.0])


def test_reads_the_image_before_the_pass():
    """In place, and from left to right, the third texel would already hold the first's light."""
    texels = image([[1.0, 0.0, 0.0, 0.0]], [[1, 0, 0, 0]])
    new = dilated(texels, everywhere(texels))
    assert new[0, :, 3].tolist() == [1.0, 1.0, 0.0, 0.0]
    turned = dilated(texels[:, ::-1], everywhere(texels))[:, ::-1]
    assert np.array_equal(new, turned)


def test_nothing_comes_across_the_border():
    texels = image([[0.0, 0.0, 0.0, 3.0]], [[0, 0, 0, 1]])
    assert dilated(texels, np.array([0, 0])).tolist() == [0.0, 0.0, 0.0, 0.0]


def test_colour_that_nothing_covers_does_not_count():
    texels = image([[7.0, 0.0, 1.0]], [[0, 0, 1]])
    assert dilated(texels, np.array([1, 0])).tolist() == [1.0, 1.0, 1.0, 1.0]


@pytest.mark.parametrize(("u", "share"), [(2 / 8, 0.5), (2.5 / 8, 0.0), (1.875 / 8, 0.625)])
def test_bleeding_at_the_edge_of_a_chart(u, share):
    """A chart covers texels 2 to 5 of 8: half of a lookup at its edge comes from outside."""
    covered = np.zeros((8, 8))
    covered[:, 2:6] = 1.0
    texels = image(covered, covered)
    assert bleed(texels, np.array([u, HALF])) == pytest.approx(share, abs=1e-15)
    assert bleed(dilated(texels, everywhere(texels)), np.array([u, HALF])) == 0.0
