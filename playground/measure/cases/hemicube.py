"""Cases of the hemicube: the delta form factors of its pixels, and their sums."""

from __future__ import annotations

from typing import Any

import numpy as np

Outputs = dict[str, Any]


def hemicube_pixel(inputs: Outputs, formulas: Any) -> Outputs:
    """One pixel of the top or of a side, by the integral over it and by the midpoint rule."""
    pixel = (inputs["i"], inputs["j"], inputs["resolution"], inputs["face"] == "side")
    return {
        "exact": formulas.hemicube.exact_delta_form_factor(*pixel),
        "midpoint": formulas.hemicube.delta_form_factor(*pixel),
    }


def hemicube_sum(inputs: Outputs, formulas: Any) -> Outputs:
    """What a whole face receives by either rule; the five add up to 1, or nearly."""
    sums = {}
    for name, rule in (
        ("midpoint", formulas.hemicube.delta_form_factor),
        ("exact", formulas.hemicube.exact_delta_form_factor),
    ):
        for face in ("top", "side"):
            sums[name, face] = _face_sum(rule, inputs["resolution"], face == "side")
    return {
        "midpoint_top_sum": sums["midpoint", "top"],
        "midpoint_side_sum": sums["midpoint", "side"],
        "midpoint_total": sums["midpoint", "top"] + 4.0 * sums["midpoint", "side"],
        "exact_top": sums["exact", "top"],
        "exact_side": sums["exact", "side"],
    }


def _face_sum(rule: Any, resolution: int, side: bool) -> float:
    """The sum over one face, in float64; a few rows at a time, however fine it is."""
    total = 0.0
    rows = resolution // 2 if side else resolution
    step = max(2**16 // resolution, 1)
    column = np.arange(resolution, dtype=np.float64)
    for first in range(0, rows, step):
        row = np.arange(first, min(first + step, rows), dtype=np.float64)[:, None]
        total += float(np.sum(rule(column, row, float(resolution), side), dtype=np.float64))
    return total
