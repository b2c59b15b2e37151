"""The camera moves as the hand does, and never flips."""

import numpy as np
import pytest

from playground.gui.picture.orbit import STEEPEST, dolly, orbit, pan, widened
from playground.render.projection import vertical_angle, view_rotation
from playground.scene.camera import Camera

CAMERAS = [
    Camera(),
    Camera(eye=(0, 5, 0), target=(0, 0, 0)),  # straight down: along up
    Camera(eye=(1e6 + 2, 3, 1), target=(1e6, 0, 0)),
    Camera(eye=(1, 2, 3), target=(0.5, 0.2, 0), up=(0.3, 0.2, 1.0)),
]


def distance(camera):
    return float(np.linalg.norm(np.subtract(camera.eye, camera.target)))


def elevation(camera):
    up = np.asarray(camera.up) / np.linalg.norm(camera.up)
    return np.degrees(np.arcsin(np.subtract(camera.eye, camera.target) @ up / distance(camera)))


@pytest.mark.parametrize("camera", CAMERAS)
@pytest.mark.parametrize(("yaw", "pitch"), [(30, 0), (-170, 20), (5, -400), (0, 400)])
def test_orbit_keeps_distance_and_target(camera, yaw, pitch):
    moved = orbit(camera, yaw, pitch)
    slack = 1e-9 * max(1.0, np.abs(camera.target).max() * 1e-3)
    assert distance(moved) == pytest.approx(distance(camera), abs=slack + 1e-9)
    assert moved.target == camera.target
    assert abs(elevation(moved)) <= STEEPEST + 1e-6


@pytest.mark.parametrize("camera", [CAMERAS[0], CAMERAS[3]])
def test_there_and_back_again(camera):
    back = orbit(orbit(camera, 50, 10), -50, -10)
    assert back.eye == pytest.approx(camera.eye, abs=1e-12)


def test_a_full_turn_ends_where_it_began():
    camera = Camera()
    for _ in range(72):
        camera = orbit(camera, 5.0, 0.0)
    assert camera.eye == pytest.approx(Camera().eye, abs=1e-12)


@pytest.mark.parametrize("camera", CAMERAS)
def test_up_stays_up_on_the_way_over_the_pole(camera):
    for _ in range(100):
        camera = orbit(camera, 1.0, 5.0)
        above = view_rotation(camera)[1]
        assert above @ np.asarray(camera.up) > 0.0


def test_yaw_goes_to_the_right_and_pitch_up():
    camera = Camera(eye=(0, 0, 5))
    assert orbit(camera, 10, 0).eye[0] > 0
    assert orbit(camera, 0, 10).eye[1] > 0


def test_pan_moves_eye_and_target_alike():
    camera = Camera(eye=(0, 0, 5), fov=90.0)
    moved = pan(camera, 0.5, 0.25)
    # At 90 degrees the picture is 10 high at the target.
    assert moved.target == pytest.approx((5.0, 2.5, 0.0))
    assert np.subtract(moved.eye, moved.target) == pytest.approx((0, 0, 5))


def test_dolly_stops_at_its_limits_and_comes_back():
    camera = Camera(eye=(0, 0, 5))
    assert distance(dolly(camera, 0.5, 1.0, 10.0)) == pytest.approx(2.5)
    assert distance(dolly(camera, 0.01, 1.0, 10.0)) == pytest.approx(1.0)
    assert distance(dolly(camera, 100.0, 1.0, 10.0)) == pytest.approx(10.0)
    outside = Camera(eye=(0, 0, 50))
    assert distance(dolly(outside, 1.1, 1.0, 10.0)) == pytest.approx(50.0)
    assert distance(dolly(outside, 0.9, 1.0, 10.0)) == pytest.approx(45.0)


@pytest.mark.parametrize("aspect", [0.1, 0.5, 0.99, 1.0, 1.2, 4 / 3])
def test_a_narrow_picture_sees_as_far_to_the_sides(aspect):
    camera = Camera(fov=30.0)
    assert widened(camera, 1.5) is camera
    seen = vertical_angle(widened(camera, aspect), aspect)
    half = np.tan(np.radians(seen / 2)) * aspect
    assert half == pytest.approx(np.tan(np.radians(15.0)) * 4 / 3)
