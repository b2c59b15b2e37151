"""The room with two spheres as Mitsuba 3 traced it: `tests/data/mitsuba_room.py` says how.

Same direct light, same delta materials, same tree; every intersection, shadow, direction and
Fresnel share is computed by the other renderer, in float32. With u = 6e-8, half a unit of its last
place:

- A pixel that sees a wall takes a few roundings: most pixels agree to a few u.
- A point on a sphere is off by about 4 u = 2.4e-7. A sphere bends or mirrors it further away: by
  about 10 at most angles (twice the way of 4 units through the room, over the radius of 0.85). At
  depth 3 it has done so three times: 2.4e-7 · 10³ = 2.4e-4, times the slope of what is seen there.
- Where a ray grazes a sphere or the edge of a shadow no bound holds: one pixel in a thousand.

The GPU rounds as much as the other renderer: twice the bounds, and twice as many such pixels.
"""

from pathlib import Path

import numpy as np
import pytest

import playground as pg

DATA = Path(__file__).parents[1] / "data"
UNIT = 2.0**-24
PER_POINT, MAGNIFIED, DEEP = 4.0 * UNIT, 10.0, 3
DARK = 0.05  # below it, errors count as shares of this


def differences(renderer):
    """How far the pixels are off, as shares of their own brightness, the worst first."""
    want = np.load(DATA / "mitsuba_room.npy")
    setup = pg.load(str(DATA / "mitsuba_room.toml"))
    size = want.shape[1], want.shape[0]
    got = pg.render(setup, size, renderer, method="ray-tracing").pixels
    assert want.mean() > 0.1 and want.max() > 1.0  # there is something to be seen
    off = np.abs(got.astype(np.float64) - want).max(axis=-1)
    return np.sort((off / np.maximum(want.max(axis=-1), DARK)).ravel())[::-1]


def test_numpy_agrees_with_another_renderer():
    off = differences("numpy")
    assert np.median(off) <= PER_POINT
    assert off[len(off) // 1000] <= PER_POINT * MAGNIFIED**DEEP


@pytest.mark.gl
def test_the_gpu_agrees_with_another_renderer(gl):
    off = differences("gl")
    assert np.median(off) <= 2.0 * PER_POINT
    assert off[2 * len(off) // 1000] <= 2.0 * PER_POINT * MAGNIFIED**DEEP
