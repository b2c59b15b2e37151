"""Cases of the rasteriser: coverage, perspective, the near plane.

All of it is the CPU's own exact or float64 arithmetic: a graphics card does these steps
in hardware, where no shader function can reach them. The pictures of both renderers are
compared elsewhere.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from playground.render.raster.clip import clip_segment
from playground.render.raster.coverage import covered_pixels
from playground.render.raster.depth import perspective_weights

Outputs = dict[str, Any]
MOST_PIXELS = 2**25  # an 8K screen; the memory of a computer ends soon after


def raster_coverage(inputs: Outputs, formulas: Any) -> Outputs:
    """Which pixel centres triangles cover, counted."""
    triangles = np.asarray(inputs["triangles"], np.float64)
    width, height = inputs["viewport"]
    if width * height > MOST_PIXELS:
        raise ValueError(f"{width} x {height} pixels are more than {MOST_PIXELS}")
    left, top = inputs.get("origin", (0, 0))
    fragments = covered_pixels(triangles, (width, height), (left, top))
    places = np.stack([fragments.column, fragments.row])
    distinct, times = np.unique(places, axis=1, return_counts=True)
    return {
        "pixels_per_triangle": np.bincount(fragments.piece, minlength=len(triangles)),
        "covered": distinct.shape[1],
        "covered_more_than_once": np.count_nonzero(times > 1),
        "sum_x": distinct[0].sum(),
        "sum_y": distinct[1].sum(),
    }


def perspective_interp(inputs: Outputs, formulas: Any) -> Outputs:
    """The weights of the corners at a point of the picture, and 1/w there."""
    clip, ndc = (np.asarray(inputs[key], np.float64) for key in ("clip", "ndc"))
    weights, one_over_w = perspective_weights(clip, ndc)
    return {"bary": weights, "attr": weights @ np.asarray(inputs["attr"]), "one_over_w": one_over_w}


def near_clip(inputs: Outputs, formulas: Any) -> Outputs:
    """Where a segment crosses the near plane, and an attribute there."""
    cut = clip_segment(np.asarray(inputs["a"], np.float64), np.asarray(inputs["b"], np.float64))
    attribute = (1.0 - cut.t) * inputs["attr_a"] + cut.t * inputs["attr_b"]
    return {
        "clipped": cut.clipped,
        "visible": cut.visible,
        "t": cut.t,
        "point": cut.point,
        "attr": attribute,
    }
