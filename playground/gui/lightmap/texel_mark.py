"""The texel under the mouse, marked in the picture: that of the atlas, or of the picture itself."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from imgui_bundle import imgui

from playground.explain.texel_places import TexelPlace, TexelPlaces
from playground.gui.layers import stages
from playground.gui.lightmap.atlas_look import Spot
from playground.gui.lightmap.atlas_picture import AtlasPicture, baked
from playground.gui.picture.canvas import Canvas, Rgb, segment
from playground.gui.picture.comparison import Picture
from playground.gui.picture.gizmo_math import ray, seen
from playground.gui.picture.pointer import pointed
from playground.gui.same_object import kept_for_same
from playground.gui.state import State
from playground.scene.camera import Camera
from playground.scene.scene import Scene

COLOUR: Rgb = (1.0, 0.48, 0.0)
SIZE = 7.0  # of the cross, in units of the interface
NORMAL = 4.0  # texels: the line along the normal


def draw(
    state: State,
    shown: tuple[Picture, ...],
    atlas: AtlasPicture,
    origin: Any,
    dense: Any,
    scale: float,
) -> State:
    """Mark the texel; the state with the one that the mouse is over in the picture."""
    in_sight, atlas.seen = atlas.seen, False
    look, found = state.atlas, baked(state.setup.scene) if in_sight else None
    if found is None:
        return state if look.spot is None else replace(state, atlas=replace(look, spot=None))
    places = found[1]
    if look.spot is not None and look.spot.in_atlas:
        place = places.of_texel(look.spot.column, look.spot.row)
        if place is not None:
            for picture in stages(state, shown):
                _marked(place, places.spacing, picture, Canvas(origin, dense, scale, picture.box))
        return state
    spot = _under_mouse(places, shown, origin)
    return state if spot == look.spot else replace(state, atlas=replace(look, spot=spot))


def _under_mouse(places: TexelPlaces, shown: tuple[Picture, ...], origin: Any) -> Spot | None:
    found = pointed(shown, origin) if imgui.is_window_hovered() else None
    if found is None:
        return None
    picture = shown[found[0]]
    size = picture.box[2:]
    at = found[1][0] * size[0], found[1][1] * size[1]
    setup = picture.setup
    return _spot(places, setup.scene, setup.camera, str((*at, *size)))


@kept_for_same(2)
def _spot(places: TexelPlaces, scene: Scene, camera: Camera, where: str) -> Spot | None:
    """The texel at a pixel of a picture; a mouse that rests costs nothing."""
    x, y, width, height = (float(word) for word in where.strip("()").split(","))
    size = int(width), int(height)
    view = seen(scene, camera, size)
    place = places.under_ray(np.array(view.eye), ray(view, size, (x, y)))
    return None if place is None else Spot(place.column, place.row, False)


def _marked(place: TexelPlace, spacing: float, picture: Picture, canvas: Canvas) -> None:
    """A cross where the texel is, and a line along the normal."""
    setup = picture.setup
    view = seen(setup.scene, setup.camera, canvas.size)
    side = place.side if place.side @ (view.eye - place.position) >= 0.0 else -place.side
    line = segment(view, place.position, place.position + NORMAL * spacing * side, canvas.size)
    if line is None:
        return
    (x, y), end = line
    size = SIZE * canvas.unit
    canvas.begin()
    canvas.line((x, y), end, COLOUR)
    canvas.line((x - size, y - size), (x + size, y + size), COLOUR)
    canvas.line((x - size, y + size), (x + size, y - size), COLOUR)
    canvas.end()
