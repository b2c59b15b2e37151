"""Rays leave a large triangle where its corners' roundings, not those of the point, decide."""

import numpy as np
import pytest

import playground as pg
from playground.render.trace.hits import Hits, closest
from playground.render.trace.meetings import meetings
from playground.render.trace.traced_scene import prepare
from playground.shading.ray import offset_ray


@pytest.mark.parametrize("size", [1.0, 100.0, 1e4])
def test_no_ray_meets_the_triangle_that_it_leaves(size):
    rng = np.random.default_rng(0)
    left = 0
    for _ in range(10):
        # A tilted triangle around the origin of its object, and an eye right above that.
        axes, _ = np.linalg.qr(rng.normal(size=(3, 3)))
        flat = rng.normal(size=(3, 2))
        corners = np.c_[flat - flat.mean(axis=0), np.zeros(3)] @ axes.T * size
        mesh = pg.Mesh.create(corners.astype(np.float32), np.array([[0, 1, 2]]))
        setup = pg.Setup(
            scene=pg.Scene(objects=(pg.Object(arrays=mesh),)),
            camera=pg.Camera(eye=tuple(0.05 * axes[:, 2]), target=(0, 0, 0), up=tuple(axes[:, 0])),
        )
        scene = prepare(setup, (16, 16))
        origin, direction, limit = scene.camera_rays(np.arange(256), (0.5, 0.5))
        hits = closest(scene.solids, origin, direction, limit)
        hit = hits.solid >= 0
        met = meetings(
            scene.solids, origin[hit], direction[hit], Hits(*(column[hit] for column in hits))
        )
        start = offset_ray(met.position, met.side, met.error)
        away = rng.normal(size=start.shape)
        away /= np.linalg.norm(away, axis=1, keepdims=True)
        away *= np.sign(np.sum(away * met.side, axis=1))[:, None]
        again = closest(scene.solids, start, away, np.full(len(start), np.inf))
        assert (again.solid < 0).all()
        left += len(start)
    assert left > 1000
