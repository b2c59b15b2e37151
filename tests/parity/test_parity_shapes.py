"""shaders/trace/analytic.glsl against its twin, playground/render/trace/analytic.py.

Rays start within 3 of the origin and hit or miss by more than 1e-3, so that float32 cannot tell it
otherwise; t is then below 6, and loses less than 2⁻²⁴ times 6 · 4 (four operations) divided by the
slope of the ray to the surface, at least 0.02: 7·10⁻⁵.
"""

import numpy as np
import pytest

from playground.render.gl.probe import call
from playground.render.trace import analytic

pytestmark = pytest.mark.gl
LIBRARY = "../trace/analytic"
SOLIDS = ("sphere", "box", "cylinder")
BOUND = 7e-5


def rays(rng, count=4000):
    origin = rng.uniform(-3.0, 3.0, (count, 3))
    target = rng.uniform(-1.5, 1.5, (count, 3))
    origin, direction = (x.astype(np.float32).astype(np.float64) for x in (origin, target - origin))
    return origin, direction


def clear(shape, origin, direction):
    """Rays that meet the shape at no glancing angle, and still would if moved a little."""
    t = analytic.meeting(shape, origin, direction)
    hit = t > 0.0
    point = analytic.on_surface(shape, origin, direction, np.where(hit, t, 1.0))
    slope = np.abs(np.einsum("ni,ni->n", analytic.normal(shape, point), direction))
    good = ~hit | (slope > 0.02 * np.linalg.norm(direction, axis=1))
    for shift in 1e-3 * np.concatenate([np.eye(3), -np.eye(3)]):
        other = analytic.meeting(shape, origin + shift, direction)
        good &= ((other > 0.0) == hit) & (np.abs(other - t) < 0.1)
    return good, t


@pytest.mark.parametrize("shape", SOLIDS)
def test_where_rays_meet_shapes(gl, rng, shape):
    origin, direction = rays(rng)
    good, t = clear(shape, origin, direction)
    assert good.mean() > 0.5 and (t[good] > 0.0).any() and (t[good] < 0.0).any()
    found = call(LIBRARY, f"meet_{shape}", origin[good], direction[good])
    assert np.abs(found - t[good]).max() <= BOUND


@pytest.mark.parametrize("shape", SOLIDS)
def test_points_normals_and_texture_coordinates(gl, rng, shape):
    origin, direction = rays(rng)
    good, t = clear(shape, origin, direction)
    origin, direction, t = (x[good & (t > 0.0)] for x in (origin, direction, t))
    point = analytic.on_surface(shape, origin, direction, t)
    inner = np.sort(np.abs(point), axis=1)  # away from edges, where a face may be the other
    away = np.ones(len(point), bool) if shape == "sphere" else inner[:, 1] < 0.99
    if shape == "cylinder":
        around = np.hypot(point[:, 0], point[:, 2])
        away = np.minimum(1.0 - np.abs(point[:, 1]), np.abs(around - 1.0)) < 1e-9
        away &= np.maximum(1.0 - np.abs(point[:, 1]), 1.0 - around) > 0.01
    point = point[away]
    found = call(LIBRARY, f"on_{shape}", point + 1e-4 * rng.uniform(-1.0, 1.0, point.shape))
    assert np.abs(found[:, :3] - point).max() <= 1e-4 * 3.0**0.5 * 1.01
    assert np.abs(found[:, 3:] - analytic.normal(shape, point)).max() <= 2.1e-4

    # Angles of up to π from atan, told in turns; near the cut they may be 0 or 1. GLSL says nothing
    # of atan, Vulkan allows 4096 units in the last place.
    exact = analytic.texcoord(shape, point)
    uncut = np.abs(point[:, 2]) > 1e-3
    found = call(LIBRARY, f"{shape}_texcoord", point)
    assert np.abs(found - exact)[uncut].max() <= 4096 * 2.0**-23 / 2.0
