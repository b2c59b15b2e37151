"""Rays of three kinds through the tree of one mesh, whose speed is measured.

They are primary rays, which go side by side; shadow rays from what those hit to a
point light, which only ask whether anything is in the way; diffuse rays, which leave the
same points in all directions.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from playground.render.trace import walk
from playground.render.trace.bvh import Bvh
from playground.scene.mesh import Mesh
from playground.scene.shapes_curved import icosphere

Floats = NDArray[np.float64]

EYE = np.array([0.4, 0.5, 2.9])
LIGHT = np.array([3.0, 4.0, 5.0])
HALF_HEIGHT = np.tan(np.radians(20.0))  # of the picture at distance 1
ABOVE = 1e-3  # how far from the unit-sized mesh the second rays start
BUMPS = 59  # edges of the icosahedron in so many parts: 69 620 triangles


@dataclass(frozen=True)
class Rays:
    """Rays of one kind: origins and directions (N, 3), limits (N,), and what is asked."""

    kind: str
    origin: Floats
    direction: Floats
    limit: Floats
    any_hit: bool


def bumpy_ball() -> Mesh:
    """A ball of radius about 1 with waves, so that it shadows itself."""
    ball = icosphere(BUMPS)
    x, y, z = ball.positions.astype(np.float64).T
    radius = 1.0 + 0.06 * np.sin(9.0 * x) * np.sin(8.0 * y + 1.0) * np.sin(10.0 * z + 2.0)
    return Mesh.create(ball.positions * radius[:, None], ball.faces, name="bumpy ball")


def ray_kinds(bvh: Bvh, size: tuple[int, int]) -> list[Rays]:
    """Primary, shadow and diffuse rays for a picture of the given size of a unit-sized mesh."""
    width, height = size
    rows, columns = np.mgrid[0:height, 0:width]
    forward = -EYE / np.linalg.norm(EYE)
    right = np.cross(forward, [0.0, 1.0, 0.0])
    right /= np.linalg.norm(right)
    up = np.cross(right, forward)
    across = (2.0 * columns + 1.0 - width) / height * HALF_HEIGHT
    upwards = (height - 1.0 - 2.0 * rows) / height * HALF_HEIGHT
    seen = forward + across[..., None] * right + upwards[..., None] * up
    seen = (seen / np.linalg.norm(seen, axis=-1, keepdims=True)).reshape(-1, 3)
    eye = np.broadcast_to(EYE, seen.shape)

    # Where they hit, on the side they come from.
    t, triangle, _ = walk.closest(bvh, eye, seen, np.inf)
    hit = np.flatnonzero(triangle >= 0)
    a, b, c = np.moveaxis(bvh.corners[np.argsort(bvh.order)[triangle[hit]]], 1, 0)
    normal = np.cross(b - a, c - a).astype(np.float64)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    normal *= np.where(np.sum(normal * seen[hit], axis=1) > 0.0, -1.0, 1.0)[:, None]
    point = eye[hit] + t[hit, None] * seen[hit] + ABOVE * normal

    to_light = LIGHT - point
    ball = np.random.default_rng(1).normal(size=point.shape)
    ball /= np.linalg.norm(ball, axis=1, keepdims=True)
    return [
        Rays("primary", eye, seen, np.full(len(seen), np.inf), False),
        Rays("shadow", point, to_light, np.ones(len(point)), True),
        Rays("diffuse", point, normal + ball, np.full(len(point), np.inf), False),
    ]
