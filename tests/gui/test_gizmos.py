"""Handles in the picture: what is dragged stays under the mouse, and nothing else moves."""

from dataclasses import replace

import numpy as np
import pytest

from playground.gui.picture.gizmo_math import (
    axis_move,
    depth,
    facing,
    neat,
    placed,
    plane_move,
    ray,
    seen,
    turned_on_ball,
)
from playground.gui.picture.gizmos import (
    dragged,
    light_handles,
    object_handles,
    ring_radius,
    spot_end,
)
from playground.gui.picture.light_change import converted, exchanged
from playground.scene.library import load
from playground.shading.vector import unit

SIZES = [(920, 650), (400, 900)]
MOVES = [(0.0, 0.0), (37.5, -12.0), (-140.0, 90.0)]


def setups():
    base = load("teapot")
    light = replace(converted(base.scene.lights[0], "point", base), position=(0.6, 1.1, 0.4))
    near = exchanged(base, 0, light)
    yield "teapot", near
    shift = np.array([1e6, -2e5, 3e4])
    camera = replace(
        near.camera,
        eye=tuple(np.add(near.camera.eye, shift)),
        target=tuple(np.add(near.camera.target, shift)),
    )
    items = tuple(
        replace(item, transform=replace(item.transform, translate=tuple(shift)))
        for item in near.scene.objects
    )
    far = near.with_(camera=camera, objects=items)
    yield "far away", exchanged(far, 0, replace(light, position=tuple(shift + light.position)))


SETUPS = dict(setups())


@pytest.fixture(params=SETUPS)
def setup(request):
    return SETUPS[request.param]


def pixel_of(view, point, size):
    return view.window(np.asarray(point, dtype=np.float64), size)[0]


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("moved", MOVES)
def test_what_is_moved_parallel_to_the_screen_follows_the_mouse(setup, size, moved):
    view = seen(setup.scene, setup.camera, size)
    point = np.asarray(setup.scene.lights[0].position)
    new = point + plane_move(view, point, size, moved)
    # 1e6 units away, float64 world coordinates have steps of 1e-10: far below a pixel.
    assert pixel_of(view, new, size) == pytest.approx(pixel_of(view, point, size) + moved, abs=1e-5)
    assert depth(view, new) == pytest.approx(depth(view, point), abs=1e-8)


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("way", [-0.3, 0.0, 0.45])
@pytest.mark.parametrize("axis", np.eye(3))
def test_along_an_axis_the_drag_is_the_way_that_was_seen(setup, size, way, axis):
    view = seen(setup.scene, setup.camera, size)
    point = setup.bounds()[0]
    moved = pixel_of(view, point + way * axis, size) - pixel_of(view, point, size)
    assert axis_move(view, point, axis, size, tuple(moved)) == pytest.approx(way, abs=1e-7)


def test_an_axis_towards_the_eye_is_no_handle():
    setup = load("teapot").with_(eye=(0, 0, 6), target=(0, 0, 0))
    view = seen(setup.scene, setup.camera, (900, 600))
    assert axis_move(view, np.zeros(3), np.array([0.0, 0.0, 1.0]), (900, 600), (5, 5)) is None
    assert axis_move(view, np.array([0, 0, 9.0]), np.eye(3)[0], (900, 600), (5, 5)) is None
    shapes = {h.shape for h in object_handles(setup, 0, view, (900, 600), 14, 70)}
    assert shapes == {"object", "x", "y"}


def test_a_ray_goes_through_its_pixel(setup):
    view = seen(setup.scene, setup.camera, (920, 650))
    for pixel in ((0.0, 0.0), (460.0, 325.0), (913.5, 12.25)):
        direction = ray(view, (920, 650), pixel)
        assert np.linalg.norm(direction) == pytest.approx(1.0)
        there = view.eye + 5.0 * direction
        # As above: 1e-10 of rounding at 5 units and 900 pixels.
        assert pixel_of(view, there, (920, 650)) == pytest.approx(pixel, abs=1e-5)


@pytest.mark.parametrize("near_side", [True, False])
@pytest.mark.parametrize("moved", MOVES)
def test_a_sun_follows_the_mouse_on_its_side_of_the_ring(setup, near_side, moved):
    size = (920, 650)
    view = seen(setup.scene, setup.camera, size)
    centre, _ = setup.bounds()
    radius = ring_radius(setup, view, size)
    side, up, back = view.camera_from_world
    towards = unit((back if near_side else -back) + 0.2 * side + 0.1 * up)
    assert facing(view, centre, towards, radius) == near_side
    new = turned_on_ball(view, centre, radius, towards, size, moved)
    assert np.linalg.norm(new) == pytest.approx(1.0)
    assert facing(view, centre, new, radius) == near_side
    wanted = pixel_of(view, centre + radius * towards, size) + moved
    assert pixel_of(view, centre + radius * new, size) == pytest.approx(wanted, abs=1e-4)


def test_beyond_the_rim_a_sun_goes_behind_without_a_jump():
    setup, size = load("teapot"), (920, 650)
    view = seen(setup.scene, setup.camera, size)
    centre, _ = setup.bounds()
    radius = ring_radius(setup, view, size)
    towards = unit(view.eye - centre)
    path = [
        turned_on_ball(view, centre, radius, towards, size, (float(x), 0.0)) for x in range(900)
    ]
    steps = np.linalg.norm(np.diff(path, axis=0), axis=1)
    # The steepest place is the rim, where a pixel p of the sine is √(2p) of the angle.
    pixel = view.pixel(size[1]) * depth(view, centre) / radius
    assert steps.max() <= 1.1 * np.sqrt(2 * pixel)
    sides = [facing(view, centre, direction, radius) for direction in path]
    assert sides[0] and not sides[-1] and sides == sorted(sides, reverse=True)


def test_the_handle_of_what_is_outside_stands_at_the_rim():
    setup, size = load("teapot").with_(eye=(0, 0, 6), target=(0, 0, 0)), (900, 600)
    view = seen(setup.scene, setup.camera, size)
    for point, inside in (((0, 0, 0), True), ((50, 0, 0), False), ((0.1, 0.3, 9), False)):
        (x, y), found = placed(view, point, size, 14)
        assert found == inside
        assert 13.9 <= x <= 886.1 and 13.9 <= y <= 586.1
    assert placed(view, (50, 0, 0), size, 14)[0] == pytest.approx((886, 300))
    assert placed(view, (0, 50, 9), size, 14)[0] == pytest.approx((450, 14))
    assert placed(view, (0, 0, 6), size, 14)[0] == pytest.approx((450, 14))  # at the eye itself


def test_neat_numbers_have_the_decimals_that_the_scene_needs():
    assert neat((1.23456789, 0, 1e-9), 2.0) == (1.23457, 0.0, 0.0)
    assert neat((1234567.8, 0, 0), 1e6) == (1234570.0, 0.0, 0.0)
    assert neat((1.23456789e-6, 0, 0), 1e-6) == (1.23457e-6, 0.0, 0.0)


@pytest.mark.parametrize("kind", ["directional", "point", "spot", "rectangle", "polygon"])
def test_dragging_a_light_changes_that_light_alone(kind):
    setup, size = load("teapot"), (920, 650)
    setup = exchanged(setup, 0, converted(setup.scene.lights[0], kind, setup))
    view = seen(setup.scene, setup.camera, size)
    for handle in light_handles(setup, view, size, 14):
        new = dragged(setup, handle.key, view, size, (30.0, 20.0))
        assert new.scene.lights[0] != setup.scene.lights[0]
        assert exchanged(new, 0, setup.scene.lights[0]) == setup
        if handle.seen:
            after = {h.key: h for h in light_handles(new, view, size, 14)}[handle.key]
            if handle.shape != "tip":  # it keeps its distance from the lamp instead
                moved = np.subtract(after.place, handle.place)
                # Five decimals of a number of the size of the scene: a hundredth of a pixel.
                assert moved == pytest.approx((30.0, 20.0), abs=0.05)


def test_the_end_of_a_spots_axis_is_dragged():
    setup, size = load("teapot"), (920, 650)
    spot = converted(setup.scene.lights[0], "spot", setup)
    setup = exchanged(setup, 0, replace(spot, position=(0, 1.2, 0), axis=(0, -1, 0)))
    view = seen(setup.scene, setup.camera, size)
    new = dragged(setup, "axis 0", view, size, (60.0, 0.0)).scene.lights[0]
    assert new.position == (0.0, 1.2, 0.0)
    assert spot_end(new, setup) @ view.camera_from_world[0] > 0.05


@pytest.mark.parametrize("key", ["object 0", "object 0 x", "object 0 y", "object 0 z"])
def test_an_object_follows_the_mouse_and_an_axis_holds_it(key):
    setup, size = load("teapot"), (920, 650)
    view = seen(setup.scene, setup.camera, size)
    new = dragged(setup, key, view, size, (40.0, 25.0))
    item, before = new.scene.objects[0], setup.scene.objects[0]
    assert replace(item, transform=before.transform) == before
    moved = np.subtract(item.transform.translate, before.transform.translate)
    if key[-1] in "xyz":
        assert np.count_nonzero(moved) == 1 and moved["xyz".index(key[-1])]
    else:
        assert np.count_nonzero(moved) == 3


@pytest.mark.gl
class TestInTheWindow:
    """The same by the mouse, in the real app."""

    def place(self, hands, shape):
        from playground.gui.picture.comparison import pictures

        x, y, _, _ = hands.window.view_box()
        width, height = hands.pixels().shape[1::-1]
        picture = pictures(hands.state, width, height)[-1]
        size = picture.box[2:]
        view = seen(picture.setup.scene, picture.setup.camera, size)
        found = light_handles(picture.setup, view, size, 14)
        found += object_handles(picture.setup, 0, view, size, 14, 70)
        at = next(h.place for h in found if h.shape == shape)
        return at[0] + x + picture.box[0], at[1] + y + picture.box[1]

    def turned_on(self, hands, **switches):
        overlays = replace(hands.state.overlays, **switches)
        hands.window.state = replace(hands.state, overlays=overlays)
        hands.frames(3)

    @pytest.mark.parametrize("layout", ["single", "side by side", "wipe", "terms", "difference"])
    def test_a_lamp_is_dragged_in_one_step_and_the_camera_stands(self, hands, layout):
        setup = hands.state.setup
        centre = tuple(setup.bounds()[0])
        light = replace(converted(setup.scene.lights[0], "point", setup), position=centre)
        hands.load("teapot", lights=(light,))
        hands.window.state = replace(hands.state, layout=layout)
        self.turned_on(hands, move_lights=True)
        before, start = hands.state.setup, self.place(hands, "lamp")
        hands.drag(start, (start[0] + 60, start[1] + 10), (start[0] - 40, start[1] + 30))
        after = hands.state.setup
        assert after.camera == before.camera
        assert after.scene.lights != before.scene.lights
        assert self.place(hands, "lamp") == pytest.approx((start[0] - 40, start[1] + 30), abs=0.5)
        assert len(hands.state.history.past) == 1 and hands.state.grip is None
        hands.key("z", "ctrl")
        assert hands.state.setup == before

    def test_a_sun_is_dragged(self, hands):
        hands.key("l")
        before, start = hands.state.setup, self.place(hands, "sun")
        hands.drag(start, (start[0] - 30, start[1] + 20))
        light = hands.state.setup.scene.lights[0]
        assert light.to_light != before.scene.lights[0].to_light
        assert hands.state.setup == exchanged(before, 0, light)

    def test_an_object_is_dragged_along_an_axis(self, hands):
        hands.key("m")
        before, start = hands.state.setup, self.place(hands, "x")
        hands.drag(start, (start[0] + 50, start[1]))
        x, y, z = hands.state.setup.scene.objects[0].transform.translate
        was = before.scene.objects[0].transform.translate
        assert x != was[0] and (y, z) == was[1:]
        assert hands.state.setup.camera == before.camera

    def test_handles_that_are_off_catch_nothing(self, hands):
        start = self.place(hands, "sun")
        before = hands.state.setup
        hands.drag(start, (start[0] - 60, start[1] + 20))
        assert hands.state.setup.scene == before.scene
        assert hands.state.setup.camera != before.camera

    def test_keys_and_the_wheel_pan(self, hands):
        for deed in (lambda: hands.key("left_arrow", "shift"), lambda: self.shift_wheel(hands)):
            before = hands.state.setup.camera
            deed()
            after = hands.state.setup.camera
            assert after.target != before.target
            assert np.subtract(after.eye, after.target) == pytest.approx(
                np.subtract(before.eye, before.target)
            )

    def shift_wheel(self, hands):
        hands.io.add_key_event(hands.imgui.Key.mod_shift, True)
        hands.wheel(460, 350, 1.0)
        hands.io.add_key_event(hands.imgui.Key.mod_shift, False)
        hands.frames()
