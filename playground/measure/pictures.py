"""A picture for an experiment, and how far it is from another one."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from playground.measure import metrics
from playground.measure.record import Errors
from playground.render.image import Image
from playground.render.renderer import open_renderer
from playground.scene.setup import Setup
from playground.shading.display import code8


def picture(
    setup: Setup, size: tuple[int, int], renderer: str = "gl", method: str = "raster"
) -> Image:
    """One picture in linear light."""
    with open_renderer(size, renderer, method=method) as drawn:
        image = drawn.render(setup)
    assert isinstance(image, Image)
    return image


def picture_errors(
    got: Image, want: Image, reference: str, covered: NDArray[np.bool_] | None = None
) -> Errors:
    """The errors of a picture against another.

    ``covered`` (H, W) says where the reference shows a surface; then only pixels that both
    cover are compared, except by FLIP, which sees the whole pictures. What is not finite counts as
    a screen shows it, black or full light, and is told in ``more``.
    """
    wild = ~np.isfinite(got.pixels).all(axis=-1)
    if wild.any():
        tame = np.nan_to_num(got.pixels, nan=0.0, posinf=1.0, neginf=0.0)
        got = replace(got, pixels=tame)
    left_out = None
    mask = np.ones(got.pixels.shape[:2], dtype=bool)
    if covered is not None:
        assert got.coverage is not None
        drawn = got.coverage > 0.5
        mask, left_out = drawn & covered, int((drawn ^ covered).sum())
    a, b = got.pixels[mask], want.pixels[mask]
    shown_got, shown_want = got.shown(), want.shown()
    codes = code8(shown_got[mask]).astype(int) - code8(shown_want[mask])
    return Errors(
        rmse=metrics.rmse(a, b),
        max=metrics.largest(a, b),
        mean=float(np.mean(np.abs(np.subtract(a, b, dtype=np.float64)))),
        reference=reference,
        flip=float(np.mean(metrics.flip_map(shown_want, shown_got))),
        off=float((np.abs(codes).max(axis=-1) > 1).mean()),
        left_out=left_out,
        more={"pixels not finite": float(wild.sum())} if wild.any() else {},
    )
