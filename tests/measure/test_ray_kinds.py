"""The rays that are measured are those that the table names."""

import numpy as np

from playground.measure.ray_kinds import bumpy_ball, ray_kinds
from playground.render.trace import walk
from playground.render.trace.bvh import bvh_of


def test_kinds_of_rays():
    mesh = bumpy_ball()
    assert len(mesh.faces) == 69_620
    bvh = bvh_of(mesh)
    primary, shadow, diffuse = ray_kinds(bvh, (48, 36))
    assert len(primary.origin) == 48 * 36
    hits = np.sum(walk.closest(bvh, primary.origin, primary.direction, primary.limit)[1] >= 0)
    assert len(shadow.origin) == len(diffuse.origin) == hits
    assert 0.4 < hits / (48 * 36) < 0.8  # the ball fills the height and not the width
    dark = walk.blocked(bvh, shadow.origin, shadow.direction, shadow.limit)
    assert 0.0 < np.mean(dark) < 0.7
    # Leaving the surface outwards, few diffuse rays of a nearly round ball meet it again.
    assert np.mean(walk.blocked(bvh, diffuse.origin, diffuse.direction, diffuse.limit)) < 0.3
