"""`explain` for every method: the terms of a pixel, the rays behind it, or its stored light."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, overload

from playground.explain.pixel import Explanation
from playground.explain.pixel import explain as explain_raster
from playground.explain.ray_tree import RayTree
from playground.render.checks import check_method
from playground.render.renderer import STORED
from playground.scene.setup import Setup

if TYPE_CHECKING:
    from playground.explain.stored_pixel import StoredPixel

SIZE = (640, 480)


@overload
def explain(
    setup: Setup,
    pixel: tuple[int, int],
    size: tuple[int, int] = SIZE,
    method: Literal["raster"] = "raster",
) -> Explanation: ...
@overload
def explain(
    setup: Setup, pixel: tuple[int, int], size: tuple[int, int] = SIZE, method: str = ...
) -> Explanation | RayTree | StoredPixel: ...
def explain(
    setup: Setup, pixel: tuple[int, int], size: tuple[int, int] = SIZE, method: str = "raster"
) -> Explanation | RayTree | StoredPixel:
    """Why ``pixel`` = (x, y), counted from the top left corner, has its colour.

    Computed by the float64 reference for a picture of ``size``, one sample at the
    centre of the pixel. ``method`` is ``"raster"``, which gives an `Explanation`,
    ``"ray-tracing"``, which gives a `RayTree`, or ``"radiosity"`` or ``"lightmap"``, which give a
    `StoredPixel`.

    Raises
    ------
    PlaygroundError
        The pixel is outside the picture, or the method is unknown.
    """
    check_method(method)
    if method in STORED:
        from playground.explain.stored_pixel import explain_stored

        return explain_stored(setup, pixel, size, method)
    if method == "ray-tracing":
        from playground.explain.ray_pixel import trace_pixel

        return trace_pixel(setup, pixel, size)
    return explain_raster(setup, pixel, size)
