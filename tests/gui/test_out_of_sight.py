"""Panels out of sight are not built; the window must not show it."""

from dataclasses import replace

import numpy as np
import pytest

pytestmark = pytest.mark.gl
PANEL = (1100.0, 400.0)


def screen(hands):
    hands.io.add_mouse_pos_event(-1.0, -1.0)  # a tooltip would come after a while
    hands.frames(2)
    codes = np.frombuffer(hands.window.wnd.fbo.read(components=3, alignment=1), np.uint8)
    return codes.reshape(720, 1280, 3)[60:]  # without the status line, which tells times


@pytest.fixture
def all_open(hands):
    """Every panel unfolded, but the two that measure: what they tell never stands still."""
    from playground.gui.panels import PANELS

    hands.load("teapot")
    for name in PANELS.keys() - {"Popping scope", "Speed and error"}:
        hands.window.state = replace(hands.state, unfold=name)
        hands.until(lambda: hands.state.unfold == "")  # until then it is scrolled to
    hands.wheel(*PANEL, 200.0)
    hands.frames(12)  # until the scene's numbers are built into its program
    return hands


def test_scrolling_shows_the_same_as_when_everything_is_built(all_open, monkeypatch):
    from playground.gui.widget import out_of_sight

    for notches in (0.0, -4.0, -9.0, -30.0, 12.0, 200.0):
        all_open.wheel(*PANEL, notches)
        monkeypatch.setattr(out_of_sight, "MARGIN", 0.0)
        sparing = screen(all_open)
        monkeypatch.setattr(out_of_sight, "MARGIN", float("inf"))
        assert np.array_equal(sparing, screen(all_open))


def test_panels_out_of_sight_are_not_built(all_open, monkeypatch):
    from playground.gui import panels
    from playground.gui.widget import out_of_sight

    built = []
    for name, panel in panels.PANELS.items():

        def counted(state, ui, name=name, panel=panel):
            built.append(name)
            return panel(state, ui)

        monkeypatch.setitem(panels.PANELS, name, counted)
    monkeypatch.setattr(out_of_sight, "MARGIN", float("inf"))
    all_open.frames(1)
    every = list(built)
    assert {"View", "Material", "Snell bench", "What the scene needs"} <= set(every)
    built.clear()
    monkeypatch.setattr(out_of_sight, "MARGIN", 2.0)
    all_open.frames(1)
    assert "View" in built
    assert len(built) < len(every) / 2
