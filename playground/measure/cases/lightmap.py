"""Cases of lightmaps: the bilinear lookup, dilation, and what bleeds into a chart at its border."""

from __future__ import annotations

from typing import Any

import numpy as np

Outputs = dict[str, Any]
EMPTY = -1.0  # what a texel is called in the answers if nothing has reached it


def lightmap_bilinear(inputs: Outputs, formulas: Any) -> Outputs:
    """Bilinear lookup that stops at the border: the outermost texel centres bound u and v."""
    texels = np.repeat(np.asarray(inputs["texels"], np.float64)[..., None], 3, axis=-1)
    return {"value": _lookup(formulas, texels, inputs["u"], inputs["v"])}


def lightmap_dilate(inputs: Outputs, formulas: Any) -> Outputs:
    """All passes of dilation, each from the image that the one before has left."""
    values = np.array(inputs["texels"], dtype=np.float64)  # null becomes NaN
    covered = np.isfinite(values)
    texels = _texels(np.where(covered, values, 0.0), covered)
    texels = _spread(formulas, texels, inputs["passes"])
    return {"texels": np.where(texels[..., 3] > 0.0, texels[..., 0], EMPTY)}


def lightmap_bleed(inputs: Outputs, formulas: Any) -> Outputs:
    """A row of texels, of which a chart covers a part: a lookup at its border."""
    width, inside, background = int(inputs["width"]), inputs["inside"], inputs["background"]
    place = np.arange(width)
    covered = ((place >= inputs["first"]) & (place <= inputs["last"]))[None]
    texels = _texels(np.where(covered, float(inside), float(background)), covered)
    spread = _spread(formulas, texels, inputs["gutter"])
    filled = np.where(spread[..., 3:] > 0.0, spread[..., :3], float(background))
    share = formulas.lightmap.bleed(texels, _texcoord(texels, inputs["u"], 0.5))[0]
    return {
        "without_dilation": _lookup(formulas, texels[..., :3], inputs["u"], 0.5),
        "with_gutter": _lookup(formulas, filled, inputs["u"], 0.5),
        "bleed": share * abs(inside - background),
    }


def _texels(values: Any, covered: Any) -> Any:
    return np.stack([values, values, values, covered.astype(np.float64)], axis=-1)


def _spread(formulas: Any, texels: Any, passes: float) -> Any:
    """So many passes of dilation; once one changes nothing, no other will."""
    for _ in range(int(passes)):
        before, texels = texels, _pass(formulas, texels)
        if np.array_equal(before, texels, equal_nan=True):
            break
    return texels


def _pass(formulas: Any, texels: Any) -> Any:
    rows, columns = np.indices(texels.shape[:2])
    texel = np.stack([columns, rows], axis=-1).reshape(-1, 2).astype(np.float64)
    return np.asarray(formulas.lightmap.dilated(texels, texel)).reshape(texels.shape)


def _texcoord(texels: Any, u: float, v: float) -> Any:
    size = np.array([texels.shape[1], texels.shape[0]])
    return np.clip([[u, v]], 0.5 / size, 1.0 - 0.5 / size)


def _lookup(formulas: Any, texels: Any, u: float, v: float) -> Any:
    texcoord = _texcoord(texels, u, v)
    return np.reshape(formulas.texture.bilinear(texels, texcoord), (-1, 3))[0, 0]
