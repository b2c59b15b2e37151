"""The numbers beside the legend of marks are those of the picture, counted when it rests."""

import numpy as np
import pytest
from test_controls import opened

from playground.gui.picture.mark_count import REST
from playground.scene.settings import MARKS
from playground.shading.marks import COLOURS, KINDS

pytestmark = pytest.mark.gl
CLAMPED = COLOURS[KINDS.index("clamped")]


def rested(hands):
    """Frames until the pixels have been counted."""
    hands.until(lambda: hands.state.mark_log.wanted == hands.state.mark_log.counted)


def test_the_count_is_that_of_the_picture(hands):
    hands.load("teapot", marks=("clamped",))
    hands.do(lambda c: opened(c, "Display"))
    rested(hands)
    painted = (hands.pixels() == CLAMPED).all(axis=-1).sum()
    assert hands.state.mark_log.count("clamped") == painted > 0
    assert hands.state.mark_log.count("nan") == 0
    hands.window.state = hands.state.with_setup(hands.state.setup.with_(exposure=3.0))
    hands.frames(1)
    assert hands.state.mark_log.count("clamped") is None  # never that of another picture
    rested(hands)
    assert hands.state.mark_log.count("clamped") == (hands.pixels() == CLAMPED).all(-1).sum()


def test_nothing_is_counted_while_the_picture_changes_or_the_panel_is_closed(hands, monkeypatch):
    hands.do(lambda c: c.item_close("//Controls/Display"))
    hands.load("teapot", marks=MARKS)
    assert hands.state.mark_log.wanted is None
    hands.do(lambda c: opened(c, "Display"))
    drawn = []
    count = hands.window.measuring._marks
    monkeypatch.setattr(count, "_counts", lambda *of: drawn.append(of) or (0,) * len(MARKS))
    clock = "playground.gui.picture.mark_count.perf_counter"
    monkeypatch.setattr(clock, lambda: len(steps) * REST / 2)
    steps = []
    for exposure in np.linspace(1.0, 2.0, 6).tolist():  # half a rest each
        steps.append(exposure)
        hands.window.state = hands.state.with_setup(hands.state.setup.with_(exposure=exposure))
        hands.frames(1)
    assert drawn == []
    steps += [0.0] * 2
    hands.frames(3)
    assert len(drawn) == 1 and drawn[0][0].settings.exposure == 2.0
