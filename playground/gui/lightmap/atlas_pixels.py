"""The atlas of a lightmap as codes: enlarged texels, borders of charts, what was dilated."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from playground.gui.lightmap.atlas_look import AtlasLook
from playground.gui.same_object import kept_for_same
from playground.render.lightmap.atlas import GUTTER
from playground.render.lightmap.lightmap import Lightmap
from playground.scene.settings import Settings
from playground.shading.display import code8, display_colour

EMPTY, LIGHTER = 46, 58  # codes of the squares behind texels that hold nothing
SQUARE = 8  # pixels
BORDER = (255, 122, 0)  # orange, which no wall of the setups has
TINT = (190, 70, 255)  # of dilated texels
STRENGTH = 0.55


def atlas_codes(
    lightmap: Lightmap, look: AtlasLook, settings: Settings, size: int
) -> NDArray[np.uint8]:
    """What is seen of ``lightmap`` in a square of ``size`` pixels, (size, size, 3)."""
    column, row = texels_at(lightmap.size, look, size)
    here = row[:, None], column[None, :]
    direct, indirect = lightmap.direct[here], lightmap.indirect[here]
    light = {"all": direct + indirect, "direct": direct, "indirect": indirect}[settings.light_shown]
    colours = display_colour(light, settings.exposure, settings.clamp, settings.curve)
    codes = code8(colours)
    chart, added = lightmap.chart[here], around(lightmap)[here]
    if look.dilated:
        tinted = (1.0 - STRENGTH) * codes + STRENGTH * np.array(TINT)
        codes = np.where(added[..., None], tinted.astype(np.uint8), codes)
    empty = (chart < 0) & ~(added & look.dilated)
    codes = np.where(empty[..., None], _squares(size)[..., None], codes)
    if look.borders:
        codes[_edges(chart)] = BORDER
    return np.ascontiguousarray(codes)


def texels_at(texels: int, look: AtlasLook, size: int) -> tuple[NDArray[np.intp], ...]:
    """The column of each column of pixels, and the row of each row of pixels, from the top."""
    place = (np.arange(size) + 0.5) / size
    left, low = look.corner()
    u, v = left + place / look.zoom, low + (1.0 - place) / look.zoom
    column, row = (np.clip((x * texels).astype(np.intp), 0, texels - 1) for x in (u, v))
    return column, row


@kept_for_same(2)
def around(lightmap: Lightmap) -> NDArray[np.bool_]:
    """Which texels dilation has filled: as many passes about the charts as it makes, (H, W)."""
    filled = lightmap.coverage
    for _ in range(GUTTER):
        wide = np.pad(filled, 1)
        filled = np.zeros_like(filled)
        for i in range(3):
            for j in range(3):
                filled |= wide[i : i + len(filled), j : j + len(filled)]
    return np.asarray(filled & ~lightmap.coverage)


def _edges(chart: NDArray[np.int32]) -> NDArray[np.bool_]:
    """Pixels of a chart beside one of another chart, or of none."""
    edge = np.zeros(chart.shape, dtype=bool)
    across, down = chart[:, 1:] != chart[:, :-1], chart[1:] != chart[:-1]
    edge[:, 1:] |= across
    edge[:, :-1] |= across
    edge[1:] |= down
    edge[:-1] |= down
    return np.asarray(edge & (chart >= 0))


def _squares(size: int) -> NDArray[np.uint8]:
    place = np.arange(size) // SQUARE
    return np.where((place[:, None] + place) % 2, LIGHTER, EMPTY).astype(np.uint8)
