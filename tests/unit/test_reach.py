"""Area lights beyond the numbers of a shader: cut, shrunk or refused, and never seen to be."""

import numpy as np
import pytest

import playground as pg
from playground.errors import PlaygroundError
from playground.render.reach import FARTHEST_CORNER, WIDEST, within_reach
from playground.scene.light import PolygonLight, RectangleLight

UNSEEN = 1.0 / 255.0 / 16.0  # of a display's step: 8 times the two errors that reach.py tells
HUGE, LARGE = 1e9, 2e4  # side of a light: 10^8 and 2500 times the scene


def image(renderer, light):
    setup = pg.load("sphere").with_(lights=(light,))
    return pg.render(setup, (48, 36), renderer=renderer).pixels


def plate(side, edge=None, **facing):
    """A light ``side`` wide 2 above the sphere, around it, or from ``edge`` on to the right."""
    x = 0.0 if edge is None else edge + side / 2.0
    return RectangleLight(position=(x, 2.0, 0.0), width=side, height=side, visible=False, **facing)


@pytest.fixture(params=["numpy", pytest.param("gl", marks=pytest.mark.gl)])
def renderer(request):
    """Both renderers, the GPU's where there is one."""
    if request.param == "gl":
        request.getfixturevalue("gl")
    return request.param


@pytest.mark.parametrize(
    "how", [{}, {"edge": 0.5}, {"facing": (0.3, -1.0, 0.2)}], ids=["above", "half", "tilted"]
)
def test_a_light_both_huge_and_near_is_as_large_as_the_sky(renderer, how):
    """Beyond ``LARGE`` it fills 2 / (LARGE / 2) of the sky at most, which fades as its cosine."""
    got, want = image(renderer, plate(HUGE, **how)), image("numpy", plate(LARGE, **how))
    assert want.max() > 0.1
    np.testing.assert_allclose(got, want, rtol=0.0, atol=UNSEEN + 2.0 / (LARGE / 2.0))


def test_a_light_within_reach_is_left_alone():
    corners = np.array(plate(2.0).corners)
    np.testing.assert_array_equal(within_reach(corners), corners)
    far = corners + np.array([0.5 * FARTHEST_CORNER, 0.0, 0.0])
    np.testing.assert_allclose(within_reach(far), far, rtol=1e-15)


def test_a_light_too_far_for_float32_is_shrunk_towards_the_eye():
    corners = np.array(plate(2.0).corners) + np.array([1e15, 0.0, 0.0])
    got = within_reach(corners)
    np.testing.assert_allclose(got * (corners[0, 0] / got[0, 0]), corners, rtol=1e-15)
    assert np.abs(got).max() == FARTHEST_CORNER


def test_what_is_cut_stays_in_its_plane_and_keeps_its_near_edge():
    corners = np.array(plate(HUGE, edge=0.5, turn=0.0).corners)
    got = within_reach(corners)
    assert got.shape == (4, 3)
    np.testing.assert_allclose(got[:, 1], 2.0, rtol=1e-12)
    assert got[:, 0].min() == 0.5
    assert np.abs(got).max() <= 2.0 * WIDEST * np.hypot(0.5, 2.0)


def test_a_huge_polygon_is_refused_and_a_far_one_is_not(renderer):
    shape = np.array([(-1.0, 0.0, -1.0), (1.0, 0.0, -1.0), (0.0, 0.0, 1.0)])

    def light(scale, y):
        points = tuple(map(tuple, (shape * scale + (0.0, y, 0.0)).tolist()))
        return PolygonLight(vertices=points, visible=False)

    with pytest.raises(PlaygroundError, match="too large beside what the camera sees"):
        image(renderer, light(1e8, 2.0))
    assert np.isfinite(image(renderer, light(1e8, 1e8))).all()
