"""How many intersection tests the rays of each pixel take: what the heat map shows.

A test is one shape with a formula, one box of a tree, or one triangle that a ray is held against.
Rays that pass an object by so far that they miss the ball around it take none there.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from playground.render.trace import walk
from playground.render.trace.traced_scene import TracedScene, prepare
from playground.render.trace.whitted import BATCH, primary, waves
from playground.scene.setup import Setup
from playground.shading.floats import Array

CENTRE = (0.5, 0.5)  # of a pixel

Counts = NDArray[np.int64]


class RayTests(NamedTuple):
    """Tests per pixel, (H, W) each: of the primary rays, and of all rays but the shadow rays."""

    first: Counts
    every: Counts


def ray_tests(setup: Setup, size: tuple[int, int]) -> RayTests:
    """Count what the ray tracer asks for a picture of ``size``, one sample per pixel."""
    scene = prepare(setup, size)
    pixels = size[0] * size[1]
    first, every = np.zeros(pixels, dtype=np.int64), np.zeros(pixels, dtype=np.int64)
    for start in range(0, pixels, BATCH):
        pixel = np.arange(start, min(start + BATCH, pixels))
        origin, direction, limit = scene.camera_rays(pixel, CENTRE)
        rays = primary(scene, origin, direction, pixel)
        for wave in waves(scene, rays, limit):
            until = limit if wave.depth == 0 else np.full(len(wave.t), np.inf)
            found = tests_of(scene, wave.rays.origin, wave.rays.direction, until)
            np.add.at(every, wave.rays.pixel, found)
            if wave.depth == 0:
                first[wave.rays.pixel] = found
    shape = size[1], size[0]
    return RayTests(first.reshape(shape), every.reshape(shape))


def tests_of(scene: TracedScene, origin: Array, direction: Array, limit: Array) -> Counts:
    """Tests (N,) of rays that look for what they meet first, in the order of the tracer."""
    until = np.array(limit)
    found = np.zeros(len(origin), dtype=np.int64)
    for solid in scene.solids:
        at = solid.near(origin, direction, until)
        inner = solid.inward(origin[at], direction[at])
        if solid.bvh is None:
            found[at] += 1
        else:
            boxes, triangles = walk.count_tests(solid.bvh, *inner, until[at])
            found[at] += boxes + triangles
        t = solid.meet(origin[at], direction[at], until[at])[0]
        until[at] = np.where((t > 0.0) & (t < until[at]), t, until[at])
    return found
