"""Handles in the picture for lights and an object: where they stand, and what a drag does.

Pure functions. A key names a handle: ``"light 0"``, ``"axis 0"`` (where a spot light
points), ``"object 2"``, ``"object 2 x"``.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from playground.gui.gizmo_math import (
    Array,
    Pixel,
    Size,
    axis_move,
    depth,
    facing,
    neat,
    placed,
    plane_move,
    turned_on_ball,
)
from playground.gui.light_change import exchanged
from playground.render.view import View
from playground.scene.light import DirectionalLight, Light, PointLight, SpotLight
from playground.scene.setup import Setup, ball_of
from playground.shading.vector import unit

RING = 0.8  # of the shorter half of the picture: the largest ring on which suns stand
SHORTEST, LONGEST = 0.3, 3.0  # radii of the scene: how long the line to a spot's handle is
AXES = "xyz"
Rgb = tuple[float, float, float]


@dataclass(frozen=True)
class Grip:
    """The handle that the mouse holds, and the setup as it was when it was taken."""

    key: str
    setup: Setup


@dataclass(frozen=True)
class Handle:
    """Something to take hold of in a picture.

    ``seen`` is false where the thing itself is outside the picture, or a sun is behind
    the scene. ``base`` is where the line to it begins.
    """

    key: str
    shape: str  # "lamp", "sun", "tip", "object" or an axis
    place: Pixel
    seen: bool
    colour: Rgb
    base: Pixel | None = None


def light_handles(setup: Setup, view: View, size: Size, margin: float) -> list[Handle]:
    """The handles of every light; a spot light has a second one for its axis."""
    found: list[Handle] = []
    for i, light in enumerate(setup.scene.lights):
        if isinstance(light, DirectionalLight):
            found += _sun(i, light, setup, view, size, margin)
        elif isinstance(light, PointLight):
            place, inside = placed(view, light.position, size, margin)
            found.append(Handle(f"light {i}", "lamp", place, inside, tint(light)))
            if isinstance(light, SpotLight):
                tip, inside = placed(view, spot_end(light, setup), size, margin)
                if inside:
                    found.append(Handle(f"axis {i}", "tip", tip, True, tint(light), place))
    return found


def object_handles(
    setup: Setup, number: int, view: View, size: Size, margin: float, reach: float
) -> list[Handle]:
    """The handle of one object, and three along the axes, ``reach`` pixels long."""
    if number >= len(setup.scene.objects):
        return []
    centre, _ = ball_of(setup.scene.objects[number])
    place, inside = placed(view, centre, size, margin)
    found = [Handle(f"object {number}", "object", place, inside, (1.0, 1.0, 1.0))]
    if not inside:
        return found
    length = reach * depth(view, centre) * view.pixel(size[1])
    for axis, name in zip(np.eye(3), AXES, strict=True):
        end, seen = placed(view, centre + length * axis, size, 0.0)
        if seen and axis_move(view, centre, axis, size, (0.0, 0.0)) is not None:
            found.append(Handle(f"object {number} {name}", name, end, True, (1, 1, 1), place))
    return found


def dragged(setup: Setup, key: str, view: View, size: Size, moved: Pixel) -> Setup:
    """The setup after a handle was dragged by ``moved`` pixels from where it stood in ``setup``.

    ``setup`` itself where the drag means nothing.
    """
    kind, number, *axis = key.split()
    index = int(number)
    if kind == "object":
        return _moved_object(setup, index, "".join(axis), view, size, moved)
    light = setup.scene.lights[index]
    centre, radius = setup.bounds()
    if isinstance(light, DirectionalLight):
        ring = ring_radius(setup, view, size)
        towards = turned_on_ball(view, centre, ring, unit(light.to_light), size, moved)
        return exchanged(setup, index, replace(light, to_light=neat(towards, 1.0)))
    assert isinstance(light, PointLight)
    if kind == "light":
        place = np.asarray(light.position) + plane_move(view, light.position, size, moved)
        return exchanged(setup, index, replace(light, position=neat(place, radius)))
    assert isinstance(light, SpotLight)
    end = spot_end(light, setup)
    end = end + plane_move(view, end, size, moved)
    ahead = neat(np.subtract(end, light.position), radius)
    return exchanged(setup, index, replace(light, axis=ahead)) if any(ahead) else setup


def ring_radius(setup: Setup, view: View, size: Size) -> float:
    """How far from the centre of the scene suns stand: with it, or as far as can be seen."""
    centre, radius = setup.bounds()
    visible = RING * min(size) / 2.0 * view.pixel(size[1]) * depth(view, centre)
    return min(radius, visible) if visible > 0.0 else radius


def spot_end(light: SpotLight, setup: Setup) -> Array:
    """The point (3,) on the axis of a spot light where its handle stands."""
    centre, radius = setup.bounds()
    away = float(np.linalg.norm(np.subtract(light.position, centre)))
    length = min(max(away, SHORTEST * radius), LONGEST * radius)
    return np.asarray(light.position) + length * unit(light.axis)


def tint(light: Light) -> Rgb:
    """The hue of a light, as bright as can be."""
    most = max(light.diffuse) or max(light.specular)
    source = light.diffuse if max(light.diffuse) else light.specular
    red, green, blue = (c / most if most else 0.5 for c in source)
    return red, green, blue


def _sun(
    index: int, light: DirectionalLight, setup: Setup, view: View, size: Size, margin: float
) -> list[Handle]:
    centre, _ = setup.bounds()
    towards, ring = unit(light.to_light), ring_radius(setup, view, size)
    if depth(view, centre) <= 0.0 or depth(view, centre + ring * towards) <= 0.0:
        return []
    place, inside = placed(view, centre + ring * towards, size, margin)
    middle, _ = placed(view, centre, size, 0.0)
    before = facing(view, centre, towards, ring)
    return [Handle(f"light {index}", "sun", place, inside and before, tint(light), middle)]


def _moved_object(
    setup: Setup, index: int, axis: str, view: View, size: Size, moved: Pixel
) -> Setup:
    item = setup.scene.objects[index]
    centre, _ = ball_of(item)
    if axis:
        direction = np.eye(3)[AXES.index(axis)]
        way = axis_move(view, centre, direction, size, moved)
        if way is None:
            return setup
        move = way * direction
    else:
        move = plane_move(view, centre, size, moved)
    place = neat(np.add(item.transform.translate, move), setup.bounds()[1])
    items = list(setup.scene.objects)
    items[index] = replace(item, transform=replace(item.transform, translate=place))
    return replace(setup, scene=replace(setup.scene, objects=tuple(items)))
