"""Nusselt's picture of a form factor: a patch drawn on a hemisphere, then straight down.

Source: Nusselt, Graphische Bestimmung des Winkelverhältnisses bei der Wärmestrahlung, VDI 72, 1928.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from playground.render.radiosity.factor.hemisphere import nusselt
from playground.render.radiosity.factor.pairs import point_at
from playground.render.radiosity.patch.patches import Patches
from playground.shading.area_light import form_factor
from playground.shading.flat_polygon import clip_front
from playground.shading.floats import Array

PIECES = 48  # of each edge, which becomes an arc of an ellipse


@dataclass(frozen=True, eq=False)
class Projection:
    """Patch j as a point of patch i sees it, on the unit hemisphere over that point.

    ``outline`` (K, 2) are places on the base disc, all around; ``height`` (K,) is how far over
    them the hemisphere is, ``corners`` which of them are corners. Nothing where j is below the
    horizon. ``covered`` is the outline's area over π, ``exact`` the form factor from that point by
    Lambert's closed form: the same but for the outline's short straight pieces.
    """

    outline: Array
    height: Array
    corners: tuple[int, ...]
    covered: float
    exact: float


def projection(
    patches: Patches, i: int, j: int, place: tuple[float, float] = (0.5, 0.5)
) -> Projection:
    """Patch j seen from the point of patch i at ``place`` = (s, t) in [0, 1], bilinear."""
    normal, polygon = patches.normal[i], patches.polygon[j]
    position = point_at(patches.polygon[i][None], np.asarray(place))[0]
    kept = clip_front(polygon[None], ((polygon - position) @ normal)[None])[0]
    kept = kept[np.any(kept != np.roll(kept, 1, axis=0), axis=-1)]
    exact = float(form_factor(position, normal, polygon, two_sided=False))
    towards = -patches.normal[j] @ (polygon[0] - position)
    if len(kept) < 3 or towards <= 0.0:
        return Projection(np.empty((0, 2)), np.empty(0), (), 0.0, exact)
    share = np.linspace(0.0, 1.0, PIECES, endpoint=False)[:, None]
    onwards = np.roll(kept, -1, axis=0) - kept
    points = (kept[:, None] + share * onwards[:, None]).reshape(-1, 3)
    outline = nusselt(position, normal, points)
    x, y = outline.T
    area = 0.5 * abs(float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))))
    return Projection(
        outline=outline,
        height=np.sqrt(np.maximum(1.0 - x * x - y * y, 0.0)),
        corners=tuple(range(0, len(points), PIECES)),
        covered=area / np.pi,
        exact=exact,
    )
