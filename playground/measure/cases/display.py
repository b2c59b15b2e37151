"""Cases of what is shown: the sRGB curve and its 8-bit codes, the bilinear lookup."""

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


def lightmap_bilinear(inputs: Outputs, formulas: Any) -> Outputs:
    """Bilinear lookup that stops at the border: the outermost texel centres bound u and v."""
    texels = np.repeat(np.asarray(inputs["texels"], np.float64)[..., None], 3, axis=-1)
    size = np.array([texels.shape[1], texels.shape[0]])
    texcoord = np.clip([inputs["u"], inputs["v"]], 0.5 / size, 1.0 - 0.5 / size)
    return {"value": formulas.texture.bilinear(texels, texcoord)[0]}
