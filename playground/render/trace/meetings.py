"""The points at which rays met the scene, with everything that light needs to know there."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from playground.render.trace.hits import Hits
from playground.render.trace.solids import Solid
from playground.shading.floats import Array
from playground.shading.vector import dot, turned_to_eye


class Meetings(NamedTuple):
    """N points, seen along rays: (N, 3) unless said otherwise.

    ``normal`` is the interpolated one, as the rasteriser shades it; ``side`` the geometric
    one, turned to where the ray came from; both are unit vectors. ``front`` (N,) says that the ray
    came from outside. ``error`` (N,) bounds how far a position is from its surface, ``solid`` (N,)
    is the number of that.
    """

    position: Array
    normal: Array
    side: Array
    to_eye: Array
    texel: Array
    error: Array
    solid: Array
    front: Array


def meetings(solids: Sequence[Solid], origin: Array, direction: Array, hits: Hits) -> Meetings:
    """The points that N rays met, of which none missed."""
    count = len(origin)
    position, normal, outward = (np.empty((count, 3)) for _ in range(3))
    texel, error = np.ones((count, 3)), np.empty(count)
    for number, solid in enumerate(solids):
        at = np.flatnonzero(hits.solid == number)
        if len(at):
            rays = origin[at], direction[at], hits.t[at], hits.triangle[at], hits.weights[at]
            position[at], normal[at], outward[at], texel[at], error[at] = solid.points(*rays)
    to_eye = -direction
    front = dot(outward, to_eye) > 0.0
    there = front[:, None]
    side = np.where(there, outward, -outward)
    normal = np.where(there, normal, turned_to_eye(normal, to_eye))
    return Meetings(position, normal, side, to_eye, texel, error, hits.solid, front)
