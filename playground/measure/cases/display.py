"""Cases of what is shown: the sRGB curve and its 8-bit codes."""

from __future__ import annotations

from typing import Any

import numpy as np

from playground.shading.display import code8

Outputs = dict[str, Any]


def srgb(inputs: Outputs, formulas: Any) -> Outputs:
    """Clamp, then the curve, its 8-bit code, and the inverse of the curve."""
    clamp = formulas.display.clamp_colour
    clamped = clamp(np.full(3, inputs["linear"]))[0]
    encoded = clamp(np.full(3, formulas.display.srgb_encode(clamped)))[0]
    return {
        "srgb": encoded,
        "code8": code8(encoded),
        "decode": formulas.display.srgb_decode(clamped),
    }
