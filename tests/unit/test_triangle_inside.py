"""The triangle under a pixel, mixed from its vertices and shaded at every point."""

import numpy as np
import pytest

import playground as pg
from playground.explain.triangle_inside import mixed_inside, shaded_inside

SIZE = (80, 60)
SETUPS = {
    "sphere": pg.load("sphere").with_(tessellation=8),
    "textured": pg.load("textured"),
    "stretched": pg.load("stretched"),
    "from behind": pg.load("facing-plates").with_(
        eye=(1.4, 0.55, 0.3),
        target=(0.5, 0.0, 0.0),
        lights=(pg.PointLight(position=(1.0, 0.1, 0.1)),),
    ),
}


def seen(setup):
    """Every ninth pixel that sees an object, as explained where it is shaded per vertex."""
    for y in range(4, SIZE[1], 9):
        for x in range(4, SIZE[0], 9):
            why = pg.explain(setup, (x, y), SIZE)
            if why.object is not None:
                yield why


@pytest.mark.parametrize("name", SETUPS)
def test_at_the_pixel_both_are_what_the_two_shadings_draw(name):
    setup = SETUPS[name].with_(shading="per-vertex")
    fragment = setup.with_(shading="per-fragment")
    count, apart = 0, 0.0
    for why in seen(setup):
        other = pg.explain(fragment, why.pixel, SIZE)
        np.testing.assert_allclose(mixed_inside(why, why.weights), why.colour, rtol=1e-12)
        inside = shaded_inside(why, why.weights)
        np.testing.assert_allclose(inside, other.colour, rtol=1e-9, atol=1e-12)
        count, apart = count + 1, max(apart, np.abs(inside - why.colour).max())
        assert why.front == (name != "from behind")
    assert count > 5 and apart > 1e-3


def test_at_the_vertices_both_are_the_same():
    for why in seen(SETUPS["sphere"].with_(shading="per-vertex")):
        np.testing.assert_allclose(
            mixed_inside(why, np.eye(3)), shaded_inside(why, np.eye(3)), rtol=1e-9
        )


def test_a_flat_triangle_has_one_colour():
    why = next(seen(SETUPS["sphere"].with_(shading="flat")))
    mix = np.random.default_rng(3).dirichlet((1, 1, 1), (4, 5))
    assert (mixed_inside(why, mix) == why.colour).all()
    assert shaded_inside(why, mix).shape == (4, 5, 3)


def test_the_background_has_no_triangle():
    why = pg.explain(pg.load("sphere"), (0, 0), SIZE)
    with pytest.raises(ValueError, match="no triangle"):
        shaded_inside(why, np.eye(3))
