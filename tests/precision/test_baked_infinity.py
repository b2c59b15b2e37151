"""A scene that stands still gets its numbers built in, also those beyond float16."""

import numpy as np
import pytest

import playground as pg

pytestmark = pytest.mark.gl


def test_an_exponent_beyond_float16_is_drawn_still_after_still(gl):
    setup = pg.load("sphere").with_(precision="float16", shininess=70_000)
    with pg.open_renderer((32, 32), "gl") as renderer:
        pictures = [renderer.render(setup).pixels for _ in range(12)]
    assert np.array_equal(pictures[0], pictures[-1])
