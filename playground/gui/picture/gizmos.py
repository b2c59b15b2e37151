"""Handles in the picture for lights and an object: where they stand, and what a drag does.

Pure functions. A key names a handle: ``"light 0"``, ``"axis 0"`` (where a spot light
points), ``"object 2"``, ``"object 2 x"``, ``"light 0 x"``.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from playground.gui.picture.gizmo_math import (
    Array,
    Pixel,
    Size,
    axis_move,
    depth,
    facing,
    neat,
    placed,
    sight_move,
    turned_on_ball,
)
from playground.gui.picture.light_change import exchanged
from playground.render.view import View
from playground.scene.light import AreaLight, DirectionalLight, Light, PointLight, SpotLight
from playground.scene.setup import Setup
from playground.shading.vector import unit

RING = 0.8  # of the shorter half of the picture: the largest ring on which suns stand
SHORTEST, LONGEST = 0.3, 3.0  # radii of the scene: how long the line to a spot's handle is
AXES = "xyz"
Rgb = tuple[float, float, float]


@dataclass(frozen=True)
class Grip:
    """The handle that the mouse holds, the setup as it was then, and what was done since.

    ``moved`` is parallel to the screen, in ImGui's units; ``pushed`` are steps away from the eye.
    """

    key: str
    setup: Setup
    moved: Pixel = (0.0, 0.0)
    pushed: float = 0.0


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


def light_handles(
    setup: Setup,
    view: View,
    size: Size,
    margin: float,
    reach: float = 0.0,
    axes_of: int | None = None,
) -> list[Handle]:
    """The handles of every light; a spot light has a second one for its axis.

    The lamp number ``axes_of`` has three more along the axes, ``reach`` pixels long.
    """
    found: list[Handle] = []
    for i, light in enumerate(setup.scene.lights):
        centre = lamp_place(light)
        if isinstance(light, DirectionalLight):
            found += _sun(i, light, setup, view, size, margin)
            continue
        assert centre is not None
        place, inside = placed(view, centre, size, margin)
        found.append(Handle(f"light {i}", "lamp", place, inside, tint(light)))
        if isinstance(light, SpotLight):
            tip, seen = placed(view, spot_end(light, setup), size, margin)
            if seen:
                found.append(Handle(f"axis {i}", "tip", tip, True, tint(light), place))
        if inside and i == axes_of:
            found += _axes(f"light {i}", centre, place, view, size, reach)
    return found


def lamp_place(light: Light) -> Array | None:
    """Where a light is (3,); None for one that comes from a direction."""
    if isinstance(light, AreaLight):
        return np.asarray(light.centre, dtype=np.float64)
    return np.asarray(light.position) if isinstance(light, PointLight) else None


def object_handles(
    setup: Setup, number: int, view: View, size: Size, margin: float, reach: float
) -> list[Handle]:
    """The handle of one object, and three along the axes, ``reach`` pixels long."""
    if number >= len(setup.scene.objects):
        return []
    centre, _ = setup.scene.objects[number].ball
    place, inside = placed(view, centre, size, margin)
    found = [Handle(f"object {number}", "object", place, inside, (1.0, 1.0, 1.0))]
    return [*found, *_axes(found[0].key, centre, place, view, size, reach)] if inside else found


def _axes(
    key: str, centre: Array, base: Pixel, view: View, size: Size, reach: float
) -> list[Handle]:
    """The three arrows at a thing; those that point at the eye are no handles."""
    length, found = reach * depth(view, centre) * view.pixel(size[1]), []
    for axis, name in zip(np.eye(3), AXES, strict=True):
        end, seen = placed(view, centre + length * axis, size, 0.0)
        if seen and axis_move(view, centre, axis, size, (0.0, 0.0)) is not None:
            found.append(Handle(f"{key} {name}", name, end, True, (1, 1, 1), base))
    return found


def dragged(
    setup: Setup, key: str, view: View, size: Size, moved: Pixel, pushed: float = 0.0
) -> Setup:
    """The setup after a handle was dragged by ``moved`` pixels from where it stood in ``setup``.

    ``pushed`` is how many steps it went away from the eye, where that means something.
    ``setup`` itself where the drag means nothing.
    """
    kind, number, *axis = key.split()
    index, radius = int(number), setup.bounds()[1]

    def way(point: Array) -> Array | None:
        if axis:
            direction = np.eye(3)[AXES.index(axis[0])]
            along = axis_move(view, point, direction, size, moved)
            return None if along is None else along * direction
        return sight_move(view, point, size, moved, pushed)

    if kind == "object":
        return _moved_object(setup, index, way)
    light = setup.scene.lights[index]
    centre = lamp_place(light)
    if centre is None:
        return _turned_sun(setup, index, view, size, moved)
    if kind == "axis":
        assert isinstance(light, SpotLight)
        end = spot_end(light, setup)
        ahead = neat(end + sight_move(view, end, size, moved, pushed) - centre, radius)
        return exchanged(setup, index, replace(light, axis=ahead)) if any(ahead) else setup
    move = way(centre)
    if move is None:
        return setup
    place = neat(centre + move, radius)
    if isinstance(light, AreaLight):
        x, y, z = map(float, np.subtract(place, centre))
        return exchanged(setup, index, light.moved((x, y, z)))
    assert isinstance(light, PointLight)
    return exchanged(setup, index, replace(light, position=place))


def _turned_sun(setup: Setup, index: int, view: View, size: Size, moved: Pixel) -> Setup:
    light = setup.scene.lights[index]
    assert isinstance(light, DirectionalLight)
    centre, ring = setup.bounds()[0], ring_radius(setup, view, size)
    towards = turned_on_ball(view, centre, ring, unit(light.to_light), size, moved)
    return exchanged(setup, index, replace(light, to_light=neat(towards, 1.0)))


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


def _moved_object(setup: Setup, index: int, way: Callable[[Array], Array | None]) -> Setup:
    item = setup.scene.objects[index]
    centre, _ = item.ball
    move = way(centre)
    if move is None:
        return setup
    place = neat(np.add(item.transform.translate, move), setup.bounds()[1])
    items = list(setup.scene.objects)
    items[index] = replace(item, transform=replace(item.transform, translate=place))
    return replace(setup, scene=replace(setup.scene, objects=tuple(items)))
