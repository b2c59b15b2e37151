"""The arrows of an explained point in the picture: whole, and clear of the triangle."""

from dataclasses import replace

import numpy as np
import pytest

from playground.gui.picture.formulas import formula
from playground.gui.pixel import vector_pen as pen

POINT = (380.0, 340.0)  # in the window, on the teapot


def test_the_rectangle_around_places_holds_them_and_no_more():
    places = [(3.0, 9.0), (1.0, 4.0), (2.0, 7.0)]
    assert pen.around(places, 0.0) == (1.0, 4.0, 2.0, 5.0)
    assert pen.around(places, 0.5) == (0.5, 3.5, 3.0, 6.0)


def test_the_formula_of_the_specular_term_follows_the_highlight():
    assert formula("specular", "phong").startswith("max(r·v")
    assert formula("specular", "blinn").startswith("max(n·h")
    assert formula("diffuse", "blinn") == formula("diffuse", "phong")


@pytest.mark.gl
def test_arrows_are_not_cut_at_the_divider(hands):
    hands.load("teapot")
    hands.window.state = replace(hands.state, layout="wipe", other="per-fragment", wipe=0.9)
    hands.click(*POINT)
    hands.io.add_mouse_pos_event(-1.0, -1.0)
    whole = hands.pixels()
    left = POINT[0] / whole.shape[1]
    hands.window.state = replace(hands.state, wipe=left - 0.04)
    hands.frames(2)
    # Both halves show the same, and only the divider, its grip and the captions have moved.
    cut = hands.pixels()
    divider = round((left - 0.04) * whole.shape[1])
    same = np.ones(whole.shape[:2], dtype=bool)
    same[:, divider - 12 : divider + 12] = False
    same[:, round(0.9 * whole.shape[1]) - 12 :] = False
    same[:40] = False
    assert (cut == whole).all(axis=-1)[same].all()
    shown = whole[300:360, divider - 60 : divider - 20]
    hands.key("escape")
    assert (
        hands.pixels()[300:360, divider - 60 : divider - 20] != shown
    ).any()  # an arrow is there


@pytest.mark.gl
def test_no_plate_covers_the_triangle(hands, monkeypatch):
    from playground.gui.pixel import arrows

    hands.load("teapot", shading="per-vertex")
    drawn, tips = [], pen.tips

    def kept(found, lit, taken, rho=None):
        triangle = taken[0]
        made = tips(found, lit, taken, rho)
        drawn.append((triangle, made))
        return made

    monkeypatch.setattr(arrows.pen, "tips", kept)
    hands.click(*POINT)
    inside = [(t, made) for t, made in drawn if len(made) >= 4]
    assert inside
    (left, top, wide, high), made = inside[-1]
    for x, y, width, height in made.values():
        beside = x + width <= left or left + wide <= x
        assert beside or y + height <= top or top + high <= y + 1.0
