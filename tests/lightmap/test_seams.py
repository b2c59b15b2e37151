"""Seams: found where a smooth surface is cut, and closed without a change to constant light."""

import numpy as np
import pytest

from playground.render.lightmap.atlas import unwrap
from playground.render.lightmap.seams import find_seams, sewn
from playground.render.lightmap.texels import lay_out
from playground.scene.scene import Object, Scene
from playground.scene.transform import Transform


def laid_out(*objects, size=128):
    scene = Scene(objects=objects)
    atlas = unwrap(scene, size)
    return lay_out(scene, atlas, np.zeros(3)), find_seams(scene, atlas)


@pytest.fixture(scope="module", params=["sphere", "torus", "teapot"])
def smooth(request):
    return laid_out(Object(mesh=request.param))


def light(position):
    """Some light that varies smoothly over the world."""
    x, y, z = position.T
    return 1.2 + np.stack([np.sin(3.0 * x), np.cos(2.0 * y), np.sin(x + y + z)], axis=1)


def test_every_lookup_at_a_seam_reads_covered_texels(smooth):
    texels, seams = smooth
    assert len(seams.texel) > 0
    assert np.abs(seams.weight.sum(axis=2) - 1.0).max() < 1e-12
    uncovered = ~texels.coverage.ravel()[seams.texel]
    # Places in the atlas are float32: off by 2⁻²⁵ of 128 texels, and so are the weights.
    assert seams.weight[uncovered].max(initial=0.0) < 2 * 128 * 2.0**-25


def test_both_sides_of_a_seam_are_one_place(smooth):
    """Positions looked up at either side agree to a texel: the edge's own points, not others."""
    texels, seams = smooth
    apart = np.linalg.norm(seams.jump(texels.image(texels.position)), axis=1)
    # Each lookup is a mean of points at most a texel's diagonal away, on either side.
    assert apart.max() < 2.0 * np.sqrt(2.0) * texels.spacing * 1.5  # charts are stretched a little


def test_seams_are_closed(smooth):
    """The jump falls tenfold at least, and no texel changes by more than the largest jump."""
    texels, seams = smooth
    before = texels.image(light(texels.position))
    after = sewn(before, seams)
    old, new = seams.jump(before), seams.jump(after)
    assert np.sqrt((new**2).mean()) < 0.1 * np.sqrt((old**2).mean())
    assert np.abs(new).max() < 0.25 * np.abs(old).max()
    assert np.abs(after - before).max() <= np.abs(old).max()
    touched = np.zeros(texels.coverage.size, dtype=bool)
    touched[seams.texel] = True
    same = (after == before).all(axis=2).ravel()
    assert same[~touched].all()


def test_constant_light_stays(smooth):
    texels, seams = smooth
    image = texels.image(np.full((len(texels), 3), 0.37))
    # The weights of a lookup sum to 1 but for a few roundings: that is all the jump there is.
    assert np.abs(sewn(image, seams) - image).max() < 100 * np.finfo(float).eps


def test_light_stays_positive(smooth):
    texels, seams = smooth
    bright = np.where(texels.position[:, :1] > 0.0, 1.0, 0.0) * np.ones(3)
    assert sewn(texels.image(bright), seams).min() >= 0.0


def test_creases_are_no_seams():
    """The faces of a box may differ in light along their common edges."""
    assert len(laid_out(Object(mesh="box"))[1].texel) == 0


def test_seams_between_objects():
    """Two squares that lie side by side are one floor."""
    left = Object(mesh="quad", transform=Transform(translate=(-1.0, 0.0, 0.0)))
    right = Object(mesh="quad", transform=Transform(translate=(1.0, 0.0, 0.0)))
    across = laid_out(left, right, size=64)[1]
    assert len(across.texel) > 0
    apart = Object(mesh="quad", transform=Transform(translate=(1.1, 0.0, 0.0)))
    assert len(laid_out(left, apart, size=64)[1].texel) == 0
