"""Precision and marks in the window: the picture of the renderer, and a reference that stays."""

import numpy as np
import pytest

from playground.scene.library import load
from playground.scene.settings import MARKS
from playground.shading.marks import COLOURS, KINDS

pytestmark = pytest.mark.gl


def test_the_window_shows_float16_and_marks(hands):
    hands.load("shininess", precision="float16", marks=MARKS)
    shown = hands.pixels()
    assert np.array_equal(shown, hands.expected(hands.window.view_box()[2:]))
    clamped = (shown == COLOURS[KINDS.index("clamped")]).all(axis=-1)
    assert clamped.sum() > 100


def test_the_reference_stays_float64(hands):
    from playground.gui.picture.reference import coded

    def codes(setup):
        return [piece.item for piece in coded(setup, (80, 60))][-1]

    setup = load("sphere")
    assert np.array_equal(codes(setup), codes(setup.with_(precision="float16")))
    marked = codes(setup.with_(marks=MARKS, exposure=3.0))
    assert (marked[..., :3] == COLOURS[KINDS.index("clamped")]).all(axis=-1).any()
