"""The triangle under a pixel, mixed from its vertices and shaded at every point."""

import numpy as np
import pytest

import playground as pg
from playground.explain.triangle_inside import mixed_inside, shaded_inside

SIZE = (80, 60)
# The same formula on the same float64 numbers, in another order: a highlight raises a few roundings
# of its cosine to the shininess, here 80 at most.
SAME = 80 * 10 * 2.0**-53
SETUPS = {
    "sphere": pg.load("sphere").with_(tessellation=8),
    "textured": pg.load("textured").with_(tessellation=6),
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
        np.testing.assert_allclose(mixed_inside(why, why.weights), why.colour, rtol=SAME)
        inside = shaded_inside(why, why.weights)
        np.testing.assert_allclose(inside, other.colour, rtol=SAME)
        count, apart = count + 1, max(apart, np.abs(inside - why.colour).max())
        assert why.front == (name != "from behind")
    assert count > 5 and apart > 1e-3


def test_at_the_vertices_both_are_the_same():
    for why in seen(SETUPS["sphere"].with_(shading="per-vertex")):
        np.testing.assert_allclose(
            mixed_inside(why, np.eye(3)), shaded_inside(why, np.eye(3)), rtol=SAME
        )


@pytest.mark.parametrize("shading", ["flat", "per-vertex"])
@pytest.mark.parametrize("name", SETUPS)
def test_other_pixels_of_the_triangle_are_told_right(name, shading):
    """Its texture, too: each is what is drawn there."""
    setup = SETUPS[name].with_(shading=shading)
    found = list(seen(setup))
    pairs = [
        (why, other)
        for why in found
        for other in found
        if other is not why and (other.object, other.triangle) == (why.object, why.triangle)
    ]
    weights = [
        pg.explain(setup.with_(shading="per-vertex"), b.pixel, SIZE).weights for _, b in pairs
    ]
    for (why, other), mix in zip(pairs, weights, strict=True):
        np.testing.assert_allclose(mixed_inside(why, mix), other.colour, rtol=SAME)
    assert pairs or name == "stretched"  # its triangles are smaller than nine pixels


def test_a_flat_triangle_has_one_colour():
    why = next(seen(SETUPS["sphere"].with_(shading="flat")))
    mix = np.random.default_rng(3).dirichlet((1, 1, 1), (4, 5))
    np.testing.assert_allclose(mixed_inside(why, mix), np.broadcast_to(why.colour, (4, 5, 3)), SAME)
    assert shaded_inside(why, mix).shape == (4, 5, 3)


def test_the_background_has_no_triangle():
    why = pg.explain(pg.load("sphere"), (0, 0), SIZE)
    for inside in (mixed_inside, shaded_inside):
        with pytest.raises(ValueError, match="no triangle"):
            inside(why, np.eye(3))
