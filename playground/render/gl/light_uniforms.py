"""Where lights stand and where they look, as ``shaders/interface/lights.glsl`` has them.

Their colours are not here: a rasterised surface has products with its own, a traced scene the
lights' own.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from playground.render.surface import SurfaceLight
from playground.render.view import FARTHEST, View


def standing_values(
    lights: Sequence[SurfaceLight], view: View, farthest: float = FARTHEST
) -> dict[str, Any]:
    """What moves with the eye: places, attenuation for distances there, corners of area lights.

    A light beyond ``farthest`` (in units of the view) comes nearer, see `View.light_place`.
    """
    values: dict[str, Any] = {}
    for kind in ("point", "spot"):
        ours = [(x.position, x.attenuation) for x in lights if x.kind == kind]
        places = [view.light_place(at, fading, farthest) for at, fading in ours if at is not None]
        if places:
            values[f"{kind}_position"] = [position for position, _ in places]
            values[f"{kind}_attenuation"] = [fading for _, fading in places]
    areas = [view.corners(light.corners) for light in lights if light.corners is not None]
    if areas:  # all with as many corners: the last one repeated adds edges without length
        most = max(map(len, areas))
        padded = [np.pad(x, ((0, most - len(x)), (0, 0)), "edge") for x in areas]
        values["area_corner"] = np.concatenate(padded)
    return values


def turned_values(lights: Sequence[SurfaceLight]) -> dict[str, Any]:
    """What stays when the eye moves: directions, the edges of spots, which sides shine."""
    values = {
        "directional_to_light": [x.to_light for x in lights if x.kind == "directional"],
        "spot_axis": [x.axis for x in lights if x.kind == "spot"],
        "spot_edge_width": [x.edge_width for x in lights if x.kind == "spot"],
        "area_two_sided": [[float(x.two_sided)] for x in lights if x.kind == "area"],
    }
    return {name: np.array(rows) for name, rows in values.items() if rows}
