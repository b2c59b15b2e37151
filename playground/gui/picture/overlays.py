"""Drawings over a picture: where light comes from, and the axes of the world."""

from __future__ import annotations

from itertools import pairwise
from math import cos, pi, radians, sin

import numpy as np

from playground.gui.picture.canvas import Canvas, Rgb, segment
from playground.gui.picture.gizmo_math import Array, seen
from playground.gui.picture.gizmos import ring_radius, spot_end, tint
from playground.gui.picture.overlay_knobs import Overlays
from playground.render.view import View
from playground.scene.light import AreaLight, DirectionalLight, PointLight, SpotLight
from playground.scene.setup import Setup
from playground.shading.vector import unit

AXIS_COLOURS: dict[str, Rgb] = {
    "x": (1.0, 0.42, 0.38),
    "y": (0.45, 0.85, 0.40),
    "z": (0.45, 0.65, 1.0),
}
CORNER = 46.0  # units from the lower left corner to the origin of the axes
AXIS = 28.0  # length of an axis
SIDES = 40  # of the circle at the end of a cone
NEAR_END = 0.35  # of the way from the centre to the sun: where its arrow ends


def draw(overlays: Overlays, setup: Setup, canvas: Canvas) -> None:
    """What is switched on, over the picture of ``setup``."""
    if not (overlays.axes or overlays.light_rays):
        return
    view = seen(setup.scene, setup.camera, canvas.size)
    canvas.begin()
    if overlays.light_rays:
        _light_rays(setup, view, canvas)
    if overlays.axes:
        _axes(view, canvas)
    canvas.end()


def _axes(view: View, canvas: Canvas) -> None:
    """x, y and z as they lie in the picture, the nearest drawn last."""
    corner = CORNER * canvas.unit
    origin = (corner, canvas.size[1] - corner)
    length = AXIS * canvas.unit
    directions = view.camera_from_world.T  # rows: the world's axes as the camera sees them
    for i in np.argsort(directions[:, 2]):
        name = "xyz"[i]
        x, y, _ = directions[i]
        colour = AXIS_COLOURS[name]
        canvas.line(origin, (origin[0] + length * x, origin[1] - length * y), colour, 2.5)
        end = length + 9.0 * canvas.unit
        canvas.plate((origin[0] + end * x, origin[1] - end * y), name, colour)


def _light_rays(setup: Setup, view: View, canvas: Canvas) -> None:
    """An arrow for every light, the cone of a spot light, the outline of an area light."""
    centre, radius = setup.bounds()
    for light in setup.scene.lights:
        colour = tint(light)
        if isinstance(light, SpotLight):
            _cone(light, setup, view, canvas)
            ends = np.asarray(light.position), spot_end(light, setup)
        elif isinstance(light, DirectionalLight):
            sun = ring_radius(setup, view, canvas.size) * unit(light.to_light)
            ends = centre + sun, centre + NEAR_END * sun
        else:
            assert isinstance(light, (PointLight, AreaLight))
            if isinstance(light, AreaLight):
                _outline(light, view, canvas)
            place = light.centre if isinstance(light, AreaLight) else light.position
            offset = np.asarray(place) - centre
            away = float(np.linalg.norm(offset))
            ends = centre + offset, centre + offset * min(NEAR_END * radius / (away or 1.0), 1.0)
        line = segment(view, *ends, canvas.size)
        if line is not None:
            canvas.arrow(*line, colour)


def _outline(light: AreaLight, view: View, canvas: Canvas) -> None:
    """The edges of an area light."""
    corners = np.asarray(light.corners)
    for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        line = segment(view, a, b, canvas.size)
        if line is not None:
            canvas.line(*line, tint(light), 2.0)


def _cone(light: SpotLight, setup: Setup, view: View, canvas: Canvas) -> None:
    """The circles of full and of no light, and four lines from the light to the outer one."""
    apex = np.asarray(light.position, dtype=np.float64)
    ahead = spot_end(light, setup) - apex
    colour = tint(light)
    for angle, alpha in ((light.inner_angle, 0.5), (light.outer_angle, 1.0)):
        ring = circle(apex, ahead, radians(angle))
        for a, b in pairwise(ring):
            line = segment(view, a, b, canvas.size)
            if line is not None:
                canvas.line(*line, colour, 1.5, alpha)
    for end in ring[: -1 : SIDES // 4]:
        line = segment(view, apex, end, canvas.size)
        if line is not None:
            canvas.line(*line, colour, 1.0, 0.7)


def circle(apex: Array, ahead: Array, angle: float) -> Array:
    """Points (SIDES + 1, 3) at ``angle`` from ``ahead``, as far from the apex as it is long."""
    length = float(np.linalg.norm(ahead))
    axis = ahead / length
    helper = np.eye(3)[int(np.argmin(np.abs(axis)))]
    side = np.cross(axis, helper)
    side = side / np.linalg.norm(side)
    other = np.cross(axis, side)
    turn = np.linspace(0.0, 2.0 * pi, SIDES + 1)[:, None]
    around = np.cos(turn) * side + np.sin(turn) * other
    return np.asarray(apex + length * (cos(angle) * axis + sin(angle) * around))
