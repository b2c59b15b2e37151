"""The mouse and the arrow keys over the view, as a camera that moves."""

from __future__ import annotations

from dataclasses import replace

from imgui_bundle import imgui

from playground.gui.picture.orbit import dolly, orbit, pan
from playground.gui.state import State

HALF_TURN = 180.0  # degrees for a drag across the height of the view
STEP = 5.0  # degrees per press of an arrow key
SHIFT_STEP = 0.05  # of the height of the picture per press of an arrow key with Shift
NOTCH = 0.9  # of the distance per notch of the wheel
NEAREST, FARTHEST = 0.02, 40.0  # distance of the eye from the target, in radii of the scene
SPEED = 24.0  # degrees per second of the walk around the target


def navigated(state: State, space: imgui.ImVec2) -> tuple[State, bool]:
    """Catch the mouse over ``space``; returns the state and whether the camera is held.

    Left drag orbits; right, middle or Shift-left drag pans; the wheel goes nearer or away,
    with Shift (on a trackpad: two fingers) it pans.
    """
    imgui.set_next_item_allow_overlap()
    buttons = imgui.ButtonFlags_
    catch = (
        buttons.mouse_button_left.value
        | buttons.mouse_button_right.value
        | buttons.mouse_button_middle.value
    )
    size = imgui.ImVec2(max(space.x, 1.0), max(space.y, 1.0))
    imgui.invisible_button("view", size, catch)
    hovered, active = imgui.is_item_hovered(), imgui.is_item_active()
    io, camera = imgui.get_io(), state.setup.camera
    held = active
    dragged = any(imgui.is_mouse_dragging(button) for button in range(3))
    if active and dragged and (io.mouse_delta.x or io.mouse_delta.y):
        right, down = io.mouse_delta.x / size.y, io.mouse_delta.y / size.y
        if imgui.is_mouse_down(1) or imgui.is_mouse_down(2) or io.key_shift:
            camera = pan(camera, -right, down)
        else:
            camera = orbit(camera, -HALF_TURN * right, HALF_TURN * down)
    if hovered and io.key_shift and (io.mouse_wheel or io.mouse_wheel_h):
        camera = pan(camera, -SHIFT_STEP * io.mouse_wheel_h, SHIFT_STEP * io.mouse_wheel)
    elif hovered and io.mouse_wheel:
        radius = state.setup.bounds()[1]
        factor = NOTCH**io.mouse_wheel
        camera = dolly(camera, factor, NEAREST * radius, FARTHEST * radius)
    if camera is not state.setup.camera:
        state = state.with_setup(replace(state.setup, camera=camera))
    return state, held


def turned(state: State, yaw: float, pitch: float) -> State:
    """The state after the eye has walked around the target."""
    camera = orbit(state.setup.camera, yaw, pitch)
    return state.with_setup(replace(state.setup, camera=camera))


def shifted(state: State, right: float, up: float) -> State:
    """The state after eye and target have moved, in heights of the picture."""
    camera = pan(state.setup.camera, right, up)
    return state.with_setup(replace(state.setup, camera=camera))


def closer(state: State, factor: float) -> State:
    """The state after the eye has come nearer or gone away."""
    radius = state.setup.bounds()[1]
    camera = dolly(state.setup.camera, factor, NEAREST * radius, FARTHEST * radius)
    return state.with_setup(replace(state.setup, camera=camera))


def walked(state: State, seconds: float) -> State:
    """The state a moment later, if the camera is walking."""
    return turned(state, SPEED * seconds, 0.0) if state.playing else state
