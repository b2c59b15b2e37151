"""Handles on the screen: buttons that catch the mouse, and how they look."""

from __future__ import annotations

from dataclasses import replace
from math import cos, pi, sin

from imgui_bundle import imgui

from playground.gui.picture.canvas import SHADE, Canvas, Rgb, ink, note
from playground.gui.picture.gizmo_math import seen
from playground.gui.picture.gizmos import Grip, Handle, dragged, light_handles, object_handles
from playground.gui.picture.overlays import AXIS_COLOURS
from playground.gui.state import State
from playground.scene.setup import Setup

CATCH = 12.0  # units from the middle of a handle that still catch the mouse
LAMP = 9.0  # radius of a lamp
TIP = 6.0
REACH = 70.0  # length of an object's arrows
MARGIN = 14.0  # from the rim of the picture to handles of what is outside
RAYS = 8  # of a sun
WHITE = (1.0, 1.0, 1.0)
DEPTH = "Shift or the wheel: nearer or farther"
PUSHED = ("lamp", "tip", "object")  # handles that have a depth of their own
STEP = 4.0  # units of a drag with Shift per step away from the eye
NOTCH = 1.0  # steps per notch of the wheel
HINTS = {
    "lamp": f"drag: moves the light parallel to the screen; {DEPTH}; arrows: along an axis",
    "sun": "drag: turns the direction the light comes from; beyond the rim it goes behind",
    "tip": f"drag: the spot light points here; {DEPTH}",
    "object": f"drag: moves the object parallel to the screen; {DEPTH}; arrows: along an axis",
}


def handles(state: State, setup: Setup, canvas: Canvas) -> list[Handle]:
    """The handles that are switched on, over the picture of ``setup``; lights come on top."""
    view = seen(setup.scene, setup.camera, canvas.size)
    margin, found = MARGIN * canvas.unit, []
    if state.overlays.move_object:
        reach = REACH * canvas.unit
        found += object_handles(setup, state.chosen, view, canvas.size, margin, reach)
    if state.overlays.move_lights:
        lamp = state.lamp if state.solo is None else state.solo
        lights = light_handles(setup, view, canvas.size, margin, REACH * canvas.unit, lamp)
        found += [h for h in lights if state.solo is None or _number(h) == state.solo]
    return found


def _number(handle: Handle) -> int:
    return int(handle.key.split()[1])


def held(state: State, setup: Setup, canvas: Canvas) -> State:
    """Catch the mouse over the handles; the state in which the held one has followed it.

    ``setup`` is what the picture shows; its camera may differ from the state's in width.
    """
    whole = replace(state.setup, camera=setup.camera)
    for handle in handles(state, whole, canvas):
        middle, reach = canvas.at(handle.place), CATCH * canvas.scale
        imgui.set_cursor_screen_pos(imgui.ImVec2(middle.x - reach, middle.y - reach))
        imgui.set_next_item_allow_overlap()
        imgui.invisible_button(handle.key, imgui.ImVec2(2.0 * reach, 2.0 * reach))
        if imgui.is_item_activated():
            state = replace(state, grip=Grip(handle.key, whole))
        elif imgui.is_item_active():
            state = _followed(state, handle, canvas)
        hint = HINTS.get(handle.shape, f"drag: moves it along {handle.shape}")
        if imgui.is_item_hovered() or imgui.is_item_active():
            imgui.set_mouse_cursor(imgui.MouseCursor_.hand)
            state = replace(state, hint=f"{handle.key}   {hint}")
            if not handle.key.startswith("object"):
                state = replace(state, lamp=_number(handle))
        if imgui.is_item_hovered(imgui.HoveredFlags_.for_tooltip):
            note(f"{handle.key}\n{hint}")
    if state.grip is not None and not imgui.is_mouse_down(0):
        state = replace(state, grip=None)
    return state


def _followed(state: State, handle: Handle, canvas: Canvas) -> State:
    """The state in which what is held stands where mouse and wheel have taken it."""
    grip, io = state.grip, imgui.get_io()
    if grip is None or grip.key != handle.key:
        return state
    right, down, turned = io.mouse_delta.x, io.mouse_delta.y, io.mouse_wheel
    deep = handle.shape in PUSHED
    if deep and io.key_shift:
        grip = replace(grip, pushed=grip.pushed - down / (STEP * canvas.scale))
    else:
        grip = replace(grip, moved=(grip.moved[0] + right, grip.moved[1] + down))
    if deep and turned:
        grip = replace(grip, pushed=grip.pushed + NOTCH * turned)
    if grip == state.grip:
        return state
    view = seen(grip.setup.scene, grip.setup.camera, canvas.size)
    pixels = (grip.moved[0] * canvas.dense.x, grip.moved[1] * canvas.dense.y)
    scene = dragged(grip.setup, handle.key, view, canvas.size, pixels, grip.pushed).scene
    state = replace(state, grip=grip)
    return (
        state if scene == state.setup.scene else state.with_setup(replace(state.setup, scene=scene))
    )


def draw(state: State, setup: Setup, canvas: Canvas) -> None:
    """Paint the handles over the picture of ``setup``; lamps over their arrows."""
    whole = replace(state.setup, camera=setup.camera)
    canvas.begin()
    for handle in sorted(handles(state, whole, canvas), key=lambda h: h.shape not in AXIS_COLOURS):
        if handle.shape in AXIS_COLOURS:
            assert handle.base is not None
            canvas.arrow(handle.base, handle.place, AXIS_COLOURS[handle.shape], 3.0)
        elif handle.shape == "object":
            _disc(canvas, handle, 0.8 * LAMP, WHITE)
        elif handle.shape == "tip":
            if handle.base is not None:
                canvas.line(handle.base, handle.place, handle.colour, 1.5, 0.8)
            _disc(canvas, handle, TIP, handle.colour)
        else:
            _lamp(canvas, handle, state.grip is not None and state.grip.key == handle.key)
    canvas.end()


def _lamp(canvas: Canvas, handle: Handle, taken: bool) -> None:
    """A disc in the light's hue with its number; a sun has rays."""
    x, y = handle.place
    if handle.shape == "sun":
        if taken and handle.base is not None:
            canvas.line(handle.base, handle.place, handle.colour, 1.0, 0.6)
        for i in range(RAYS):
            c, s = cos(2.0 * pi * i / RAYS), sin(2.0 * pi * i / RAYS)
            near, far = (LAMP + 3.0) * canvas.unit, (LAMP + 8.0) * canvas.unit
            canvas.line((x + near * c, y + near * s), (x + far * c, y + far * s), handle.colour)
    _disc(canvas, handle, LAMP, handle.colour)
    number = handle.key.split()[1]
    canvas.text(handle.place, number, SHADE if handle.seen else WHITE)


def _disc(canvas: Canvas, handle: Handle, radius: float, colour: Rgb) -> None:
    """Full where the thing is seen; a ring where it is outside the picture or behind."""
    paint, middle = imgui.get_window_draw_list(), canvas.at(handle.place)
    radius *= canvas.scale
    if handle.seen:
        paint.add_circle_filled(middle, radius, ink(colour))
        paint.add_circle(middle, radius + canvas.scale, ink(SHADE, 0.7), 0, 2.0 * canvas.scale)
        return
    paint.add_circle_filled(middle, radius + 1.5 * canvas.scale, ink(SHADE, 0.7))
    paint.add_circle(middle, radius, ink(colour), 0, 2.0 * canvas.scale)
