"""`explain` for every method: the terms of a pixel, the rays behind it, or its stored light."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, overload

from playground.errors import PlaygroundError
from playground.explain.pixel import Explanation
from playground.explain.pixel import explain as explain_raster
from playground.explain.ray_tree import RayTree
from playground.render.checks import check_method
from playground.render.renderer import STORED
from playground.scene.setup import Setup

if TYPE_CHECKING:
    from playground.explain.patch_pair import PatchPair
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
    setup: Setup,
    pixel: tuple[int, int],
    size: tuple[int, int] = SIZE,
    method: str = ...,
    to: tuple[int, int] | None = ...,
) -> Explanation | RayTree | StoredPixel | PatchPair: ...
def explain(
    setup: Setup,
    pixel: tuple[int, int],
    size: tuple[int, int] = SIZE,
    method: str = "raster",
    to: tuple[int, int] | None = None,
) -> Explanation | RayTree | StoredPixel | PatchPair:
    """Why ``pixel`` = (x, y), counted from the top left corner, has its colour.

    Computed by the float64 reference for a picture of ``size``, one sample at the
    centre of the pixel. ``method`` is ``"raster"``, which gives an `Explanation`,
    ``"ray-tracing"``, which gives a `RayTree`, or ``"radiosity"`` or ``"lightmap"``, which give a
    `StoredPixel`. With radiosity, a second pixel ``to`` asks for the `PatchPair` of the patches
    in both: their form factors.

    Raises
    ------
    PlaygroundError
        A pixel is outside the picture or shows no patch, or the method is unknown.
    """
    check_method(method)
    if to is not None:
        return _pair(setup, pixel, to, size, method)
    if method in STORED:
        from playground.explain.stored_pixel import explain_stored

        return explain_stored(setup, pixel, size, method)
    if method == "ray-tracing":
        from playground.explain.ray_pixel import trace_pixel

        return trace_pixel(setup, pixel, size)
    return explain_raster(setup, pixel, size)


def _pair(
    setup: Setup, pixel: tuple[int, int], to: tuple[int, int], size: tuple[int, int], method: str
) -> PatchPair:
    """The form factors of the patches in two pixels."""
    from playground.explain.patch_at import patches_of_pixels
    from playground.explain.patch_pair import explain_pair

    if method != "radiosity":
        raise PlaygroundError(
            "a second pixel is for form factors", got=f"method {method}", allowed="radiosity"
        )
    return explain_pair(*patches_of_pixels(setup, pixel, to, size), setup.settings)
