"""Lamps are moved in all three directions: along the line of sight, and along the axes."""

from dataclasses import replace

import numpy as np
import pytest

from playground.gui.picture.gizmo_math import FURTHER, depth, plane_move, seen, sight_move
from playground.gui.picture.gizmos import dragged, lamp_place, light_handles
from playground.gui.picture.light_change import converted, exchanged
from playground.scene.library import load

SIZE = (920, 650)
KINDS = ["point", "spot", "rectangle"]


def setup_with(kind, place=(0.3, 0.5, 0.9)):
    base = load("teapot")
    light = converted(base.scene.lights[0], kind, base)
    light = (
        light.moved(tuple(np.subtract(place, light.centre)))
        if kind == "rectangle"
        else replace(light, position=place)
    )
    return exchanged(base, 0, light)


def pixel_of(view, point):
    return view.window(np.asarray(point, dtype=np.float64), SIZE)[0]


@pytest.mark.parametrize("moved", [(0.0, 0.0), (40.0, -25.0)])
@pytest.mark.parametrize("steps", [-8.0, 0.0, 2.5, 30.0])
def test_what_is_pushed_stays_under_the_mouse_and_goes_away_from_the_eye(moved, steps):
    setup = setup_with("point")
    view, point = seen(setup.scene, setup.camera, SIZE), np.array([0.3, 0.5, 0.9])
    new = point + sight_move(view, point, SIZE, moved, steps)
    assert pixel_of(view, new) == pytest.approx(pixel_of(view, point) + moved, abs=1e-9)
    assert depth(view, new) == pytest.approx(FURTHER**steps * depth(view, point), rel=1e-12)
    if not steps:
        np.testing.assert_allclose(new - point, plane_move(view, point, SIZE, moved), atol=1e-14)


def test_nothing_is_pushed_out_of_the_numbers():
    setup = setup_with("point")
    view, point = seen(setup.scene, setup.camera, SIZE), np.array([0.3, 0.5, 0.9])
    for steps in (1e9, -1e9):
        new = point + sight_move(view, point, SIZE, (0.0, 0.0), steps)
        assert np.isfinite(new).all() and depth(view, new) > 0.0


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("axis", "xyz")
def test_a_lamp_is_dragged_along_an_axis(kind, axis):
    setup = setup_with(kind)
    view = seen(setup.scene, setup.camera, SIZE)
    found = light_handles(setup, view, SIZE, 14, 70.0, 0)
    handle = next(h for h in found if h.shape == axis)
    assert handle.key == f"light 0 {axis}"
    new = dragged(setup, handle.key, view, SIZE, (30.0, 20.0))
    way = lamp_place(new.scene.lights[0]) - lamp_place(setup.scene.lights[0])
    # The place of a rectangle is the middle of its corners: a few roundings of numbers near 1.
    assert np.abs(np.delete(way, "xyz".index(axis))).max() < 1e-12 < abs(way["xyz".index(axis)])
    assert exchanged(new, 0, setup.scene.lights[0]) == setup


@pytest.mark.parametrize("kind", KINDS)
def test_a_lamp_is_pushed(kind):
    setup = setup_with(kind)
    view = seen(setup.scene, setup.camera, SIZE)
    new = dragged(setup, "light 0", view, SIZE, (0.0, 0.0), 5.0)
    places = [lamp_place(s.scene.lights[0]) for s in (setup, new)]
    assert depth(view, places[1]) > 1.2 * depth(view, places[0])
    # Five decimals of a number of the size of the scene: a hundredth of a pixel.
    assert pixel_of(view, places[1]) == pytest.approx(pixel_of(view, places[0]), abs=0.05)


def test_one_lamp_has_arrows_and_the_others_and_suns_have_none():
    setup = setup_with("point")
    lamp = setup.scene.lights[0]
    sun = load("teapot").scene.lights[0]
    lamps = (lamp, replace(lamp, position=(0, 0.4, 1)), sun)
    setup = setup.with_(lights=lamps)
    view = seen(setup.scene, setup.camera, SIZE)
    for number, expected in ((0, 3), (1, 3), (2, 0), (None, 0)):
        found = light_handles(setup, view, SIZE, 14, 70.0, number)
        arrows = [h for h in found if h.shape in "xyz"]
        assert len(arrows) == expected
        assert all(h.key.startswith(f"light {number} ") for h in arrows)


@pytest.mark.gl
class TestInTheWindow:
    """Shift, the wheel, the arrows and the status line."""

    @pytest.fixture
    def lamp(self, hands):
        setup = setup_with("point", tuple(load("teapot").bounds()[0]))
        hands.load("teapot", lights=setup.scene.lights)
        overlays = replace(hands.state.overlays, move_lights=True)
        hands.window.state = replace(hands.state, overlays=overlays)
        hands.frames(3)
        return hands

    def place(self, hands, shape="lamp"):
        x, y, width, height = hands.window.view_box()
        setup, size = hands.state.setup, (width, height)
        view = seen(setup.scene, setup.camera, size)
        found = light_handles(setup, view, size, 14, 70, hands.state.lamp)
        at = next(h.place for h in found if h.shape == shape)
        return at[0] + x, at[1] + y

    def depth(self, hands):
        setup = hands.state.setup
        view = seen(setup.scene, setup.camera, SIZE)
        return depth(view, lamp_place(setup.scene.lights[0]))

    @pytest.mark.parametrize("down", [-60.0, 40.0])
    def test_shift_pushes_and_it_is_one_step(self, lamp, down):
        before, start, far = lamp.state.setup, self.place(lamp), self.depth(lamp)
        lamp.io.add_mouse_pos_event(*start)
        lamp.frames()
        lamp.io.add_mouse_button_event(0, True)
        lamp.frames()
        lamp.io.add_mouse_pos_event(start[0] + 30, start[1])
        lamp.frames()
        lamp.io.add_key_event(lamp.imgui.Key.mod_shift, True)
        lamp.frames()
        lamp.io.add_mouse_pos_event(start[0] + 30, start[1] + down)
        lamp.frames()
        lamp.io.add_key_event(lamp.imgui.Key.mod_shift, False)
        lamp.io.add_mouse_button_event(0, False)
        lamp.frames(3)
        assert self.depth(lamp) == pytest.approx(far * FURTHER ** (-down / 4.0), rel=1e-4)
        assert self.place(lamp) == pytest.approx((start[0] + 30, start[1]), abs=0.5)
        assert lamp.state.setup.camera == before.camera and lamp.state.pixel is None
        assert len(lamp.state.history.past) == 1 and lamp.state.grip is None
        lamp.key("z", "ctrl")
        assert lamp.state.setup == before

    def test_the_wheel_pushes_what_is_held_and_not_the_camera(self, lamp):
        before, start, far = lamp.state.setup, self.place(lamp), self.depth(lamp)
        lamp.io.add_mouse_pos_event(*start)
        lamp.frames()
        lamp.io.add_mouse_button_event(0, True)
        lamp.frames()
        for _ in range(3):
            lamp.io.add_mouse_wheel_event(0.0, 1.0)
            lamp.frames()
        lamp.io.add_mouse_button_event(0, False)
        lamp.frames(3)
        assert self.depth(lamp) == pytest.approx(far * FURTHER**3, rel=1e-4)
        assert lamp.state.setup.camera == before.camera
        assert len(lamp.state.history.past) == 1

    def test_an_arrow_moves_the_lamp_along_its_axis(self, lamp):
        before, start = lamp.state.setup.scene.lights[0], self.place(lamp, "x")
        lamp.drag(start, (start[0] + 50, start[1]))
        way = np.subtract(lamp.state.setup.scene.lights[0].position, before.position)
        assert way[0] != 0.0 and not way[1:].any()

    def test_the_status_line_says_what_can_be_done_while_the_mouse_is_there(self, lamp):
        lamp.io.add_mouse_pos_event(*self.place(lamp))
        lamp.frames(3)
        assert "light 0" in lamp.state.hint and "Shift or the wheel" in lamp.state.hint
        lamp.io.add_mouse_pos_event(*self.place(lamp, "y"))
        lamp.frames(3)
        assert "along y" in lamp.state.hint
        lamp.io.add_mouse_pos_event(-1.0, -1.0)
        lamp.frames(3)
        assert lamp.state.hint == ""
