"""The explained point stays the same when its picture gets another size or another place."""

from dataclasses import replace

import numpy as np
import pytest

from playground.explain.pixel import explain
from playground.gui.picture.orbit import widened
from playground.gui.picture.same_point import moved
from playground.scene.library import load

SIZES = [(1280, 720), (900, 640), (640, 640), (300, 640), (64, 600)]
POINT = (380.0, 320.0)  # in the window, on the teapot


@pytest.mark.parametrize("after", SIZES)
@pytest.mark.parametrize("before", SIZES)
def test_a_pixel_moves_to_where_its_point_is_seen(before, after):
    setup = load("teapot")

    def seen(size):
        return replace(setup, camera=widened(setup.camera, size[0] / size[1]))

    x, y = before[0] // 2, before[1] // 2 + before[0] // 64
    share = ((x + 0.5) / before[0], (y + 0.5) / before[1])
    across, down = moved(share, setup.camera, before, after)
    pixel = int(across * after[0]), int(down * after[1])
    was = explain(seen(before), (x, y), before).corners[0].position
    now = explain(seen(after), pixel, after).corners[0].position
    # A pixel is off by half its size at most, along and across, and the surface is slanted.
    distance = float(np.linalg.norm(np.subtract(setup.camera.eye, was)))
    wide = 2.0 * distance * np.tan(np.radians(40.0)) / min(after)
    assert np.linalg.norm(np.subtract(was, now)) < 2.0 * wide


@pytest.mark.gl
def test_hiding_the_controls_and_comparing_keep_the_point(hands):
    hands.load("teapot")
    hands.click(*POINT)
    first = point(hands)
    assert first is not None
    for key in ("h", "h", "f4", "f4", *6 * ("tab",)):
        hands.key(key)
        hands.frames(2)
        # The point under the middle of a pixel, in pictures down to 200 pixels: 2 % of the teapot.
        assert np.linalg.norm(np.subtract(point(hands), first)) < 0.06, hands.state.layout
    assert hands.state.layout == "single"


@pytest.mark.gl
def test_term_by_term_the_sum_is_explained(hands):
    hands.load("teapot")
    hands.click(*POINT)
    for _ in range(3):
        hands.key("tab")
    assert hands.state.layout == "terms" and hands.state.clue.picture == 4
    hands.key("tab")
    assert hands.state.layout == "difference" and hands.state.clue.picture == 0


@pytest.mark.gl
def test_a_point_that_is_out_of_the_picture_is_forgotten(hands):
    hands.load("teapot")
    hands.key("h")
    hands.click(6.0, 300.0)
    assert hands.state.pixel is not None
    hands.key("h")
    assert hands.state.pixel is None


def point(hands):
    """Where the explained point is in the world."""
    from playground.gui.picture.comparison import pictures
    from playground.gui.pixel.explained import explained

    box = hands.window.view_box()
    shown = pictures(hands.state, box[2], box[3])
    why = explained(shown[hands.state.clue.picture], hands.state.pixel)
    return why.corners[0].position
