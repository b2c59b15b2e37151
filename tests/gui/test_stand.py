"""Stepping aside: the arrows of a point, and ρ as an angle, from where they can be seen."""

from dataclasses import replace
from math import cos, radians, sin

import numpy as np
import pytest

from playground.explain.pixel import explain
from playground.gui.picture.canvas import segment
from playground.gui.picture.comparison import pictures
from playground.gui.picture.gizmo_math import seen
from playground.gui.picture.stand import (
    TURN,
    Stand,
    aside,
    standing,
    stepped,
    turned,
    unhidden,
    viewed,
)
from playground.gui.pixel.vector_pen import openness
from playground.gui.state import start
from playground.scene.library import load
from playground.shading.vector import unit

POINT = (380.0, 320.0)  # in the window, on the teapot
SIZE = (640, 480)


def point_of(setup, pixel=(270, 230)):
    corner = explain(setup, pixel, SIZE).corners[0]
    return corner, corner.lights[0]


def test_the_camera_turns_about_the_point_out_of_the_plane_of_r_and_v():
    setup = load("teapot")
    corner, light = point_of(setup)
    camera = aside(setup.camera, corner.position, corner.normal, light.reflection)
    offset = np.subtract(camera.eye, corner.position)
    before = np.subtract(setup.camera.eye, corner.position)
    # Sums and products of a few float64 numbers around 1.
    assert np.linalg.norm(offset) == pytest.approx(np.linalg.norm(before), rel=1e-12)
    towards = unit(offset)
    assert towards @ corner.to_eye == pytest.approx(cos(radians(TURN)), abs=1e-12)
    across = unit(np.cross(corner.to_eye, light.reflection))
    assert abs(towards @ across) == pytest.approx(sin(radians(TURN)), abs=1e-12)
    assert towards @ corner.normal > 0.0  # the point is still seen from its front
    assert camera.target == pytest.approx(tuple(corner.position))


def opened(setup, camera, corner, light):
    """How many pixels the plane of r and v is open, for arrows of length 1."""
    view = seen(setup.scene, camera, SIZE)
    ends = [corner.position + 0.3 * way for way in (light.reflection, corner.to_eye)]
    middle = corner.position + 0.3 * unit(light.reflection + corner.to_eye)
    places = [tuple(p) for p in view.window(np.array([ends[0], middle, ends[1]]), SIZE)[0]]
    start = tuple(view.window(corner.position, SIZE)[0])
    return openness(start, places)


def test_from_the_side_the_sector_of_rho_is_open_and_from_the_viewer_it_is_a_line():
    setup = load("teapot")
    corner, light = point_of(setup)
    camera = aside(setup.camera, corner.position, corner.normal, light.reflection)
    # The pixel's own place is rounded to its middle, the arrows are not.
    assert opened(setup, setup.camera, corner, light) < 1e-6
    assert opened(setup, camera, corner, light) > 3.0


@pytest.mark.parametrize("reflection", [None, "to_eye"])
def test_without_a_plane_of_r_and_v_there_is_a_side_all_the_same(reflection):
    setup = load("sphere").with_(eye=(0, 0, 4), target=(0, 0, 0))
    point, normal = np.array([0.0, 0.0, 1.0]), np.array([0.0, 0.0, 1.0])
    other = normal if reflection else None  # r, n and v are one
    camera = aside(setup.camera, point, normal, other)
    towards = unit(np.subtract(camera.eye, point))
    assert towards @ normal == pytest.approx(cos(radians(TURN)), abs=1e-12)


def test_looked_at_from_above_the_camera_stays_off_the_pole():
    setup = load("sphere").with_(eye=(0, 4, 1e-3), target=(0, 0, 0))
    corner, light = point_of(setup, (320, 240))
    camera = aside(setup.camera, corner.position, corner.normal, light.reflection)
    offset = unit(np.subtract(camera.eye, camera.target))
    assert abs(offset[1]) <= sin(radians(89.0)) + 1e-12
    assert seen(setup.scene, camera, SIZE).eye is not None


def picked(pixel=(0.42, 0.5)):
    return replace(start(load("teapot")), pixel=pixel)


def stepped_aside(state):
    state = stepped(state)
    assert state.stand.due and standing(state) is None
    corner, light = point_of(state.setup)
    return turned(state, corner.position, corner.normal, light.reflection)


def test_the_step_and_the_way_back():
    state = picked()
    there = stepped_aside(state)
    assert standing(there) == Stand(state.setup.camera, state.pixel)
    assert there.setup.scene is state.setup.scene
    back = stepped(there)
    assert back.setup == state.setup and back.stand is None


def test_nothing_is_picked_nothing_turns():
    state = start(load("teapot"))
    assert stepped(state).setup is state.setup and "click" in stepped(state).message


def test_the_viewer_stays_while_the_camera_goes_on_and_ends_with_the_pixel():
    there = stepped_aside(picked())
    moved = there.with_setup(there.setup.with_(eye=(3, 3, 3)))
    (picture,) = pictures(moved, *SIZE)
    assert viewed(moved, picture).setup.camera == picked().setup.camera
    assert viewed(moved, picture).setup.scene is picture.setup.scene
    again = replace(moved, pixel=(0.3, 0.3))  # a new click
    assert standing(again) is None and viewed(again, picture) is picture
    assert standing(moved.unpicked()) is None
    undone = moved.with_setup(picked().setup)
    assert standing(undone) is None


def test_the_explained_values_do_not_change_from_the_side():
    state = picked()
    (before,) = pictures(state, *SIZE)
    there = stepped_aside(state)
    (after,) = pictures(there, *SIZE)
    a, b = (explain(p.setup, (270, 230), SIZE) for p in (before, viewed(there, after)))
    np.testing.assert_array_equal(a.colour, b.colour)
    np.testing.assert_array_equal(a.corners[0].to_eye, b.corners[0].to_eye)


def test_the_line_to_the_viewer_ends_where_it_leaves_the_space_before_the_camera():
    there = stepped_aside(picked())
    view = seen(there.setup.scene, there.setup.camera, SIZE)
    corner, _ = point_of(picked().setup)
    assert segment(view, corner.position, picked().setup.camera.eye, SIZE) is not None


@pytest.mark.gl
class TestInTheWindow:
    """Key, button, and what the arrows look like."""

    def settled(self, hands):
        for _ in range(10):
            hands.frames(1)

    @pytest.mark.parametrize("shading", ["flat", "per-vertex", "per-fragment"])
    @pytest.mark.parametrize("layout", ["single", "side by side", "wipe", "terms", "difference"])
    def test_the_key_steps_aside_and_back_as_steps_of_undo(self, hands, shading, layout):
        hands.load("teapot", shading=shading, tessellation=4)
        hands.window.state = replace(hands.state, layout=layout, pixel=(0.45, 0.5))
        self.settled(hands)
        before = hands.state.setup
        hands.key("o")
        self.settled(hands)
        assert standing(hands.state).camera == before.camera != hands.state.setup.camera
        assert not hands.state.failed
        hands.key("z", "ctrl")
        assert hands.state.setup == before
        hands.key("y", "ctrl")
        hands.key("o")
        assert hands.state.setup == before and standing(hands.state) is None

    def test_the_button_does_the_same_and_picks_nothing(self, hands):
        hands.click(*POINT)
        self.settled(hands)
        pixel, before = hands.state.pixel, hands.state.setup
        hands.do(lambda c: c.item_click("//View/###aside"))
        self.settled(hands)
        assert hands.state.pixel == pixel and standing(hands.state) is not None
        hands.do(lambda c: c.item_click("//View/###aside"))
        assert hands.state.setup == before

    def test_rho_answers_to_the_mouse_at_its_own_place(self, hands):
        hands.click(*POINT)
        hands.key("o")
        self.settled(hands)
        lit = set()
        for x in range(320, 600, 12):
            for y in range(250, 520, 10):
                hands.io.add_mouse_pos_event(float(x), float(y))
                hands.frames(1)
                lit.add(hands.state.clue.lit)
        assert {"n", "l", "r", "v", "ρ", ""} <= lit

    def test_orbiting_keeps_the_viewer_and_a_click_makes_a_new_one(self, hands):
        hands.click(*POINT)
        hands.key("o")
        self.settled(hands)
        viewer = standing(hands.state).camera
        hands.drag((700, 500), (740, 480))
        assert standing(hands.state).camera == viewer
        hands.click(460, 330)
        self.settled(hands)
        assert standing(hands.state) is None

    def test_the_background_has_no_side(self, hands):
        hands.click(30, 60)
        self.settled(hands)
        before = hands.state.setup
        hands.key("o")
        self.settled(hands)
        assert hands.state.setup == before and hands.state.stand is None


def test_a_step_aside_in_a_room_stays_in_the_room():
    setup = load("whitted-room")
    corner, light = point_of(setup, (210, 230))  # on the mirror ball
    camera = aside(setup.camera, corner.position, corner.normal, light.reflection)
    hidden = explain(replace(setup, camera=camera), (1, 1), (3, 3)).corners[0]
    assert hidden.position != pytest.approx(corner.position, abs=0.1)  # a wall
    nearer = unhidden(setup, camera)
    seen = explain(replace(setup, camera=nearer), (1, 1), (3, 3)).corners[0]
    # The middle of the picture is the target, to the rounding of the view's float64 matrices.
    assert seen.position == pytest.approx(tuple(corner.position), abs=1e-9)
    before, after = (np.subtract(c.eye, corner.position) for c in (camera, nearer))
    assert unit(before) @ unit(after) == pytest.approx(1.0, abs=1e-12)  # the same side
    assert np.linalg.norm(after) < np.linalg.norm(before) and nearer.fov > camera.fov


@pytest.mark.parametrize("shading", ["flat", "per-vertex", "per-fragment"])
@pytest.mark.parametrize("name", ["teapot", "missed-highlight"])
def test_where_nothing_hides_the_point_the_camera_stays(name, shading):
    setup = load(name).with_(shading=shading)
    corner, light = point_of(setup)
    camera = aside(setup.camera, corner.position, corner.normal, light.reflection)
    assert unhidden(setup, camera) is camera
