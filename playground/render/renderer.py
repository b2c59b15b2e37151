"""The one door from a setup to a picture: `render`, and `open_renderer` for many.

Two renderers give one result. ``gl`` draws on the GPU, in a window's context or
headless; ``numpy`` is the float64 reference and works everywhere.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

from numpy.typing import NDArray

from playground.errors import PlaygroundError, unknown_name
from playground.render.checks import check_method, check_setup, check_size
from playground.render.image import Image
from playground.scene.setup import Setup

if TYPE_CHECKING:
    from playground.render.stored_renderer import LightSource

STORED = ("radiosity", "lightmap")  # methods that draw light computed before
RENDERERS = ("auto", "gl", "numpy", "embree")


class Renderer(Protocol):
    """Turns setups into pictures of one size; keeps what it can between them."""

    name: str
    size: tuple[int, int]

    def render(self, setup: Setup, out: NDArray[Any] | None = None) -> Image | NDArray[Any]:
        """Draw ``setup``.

        Parameters
        ----------
        setup : Setup
        out : array, optional
            uint8 (H, W, 4) for 8-bit codes, or float32 (H, W, 3) or (H, W, 4) for linear
            light and coverage; written in place and returned. Without it the result is
            a new `Image`.
        """
        ...

    def samples(self, setup: Setup) -> int:
        """How many samples per pixel this renderer takes for ``setup``: no more than it can."""
        ...

    def close(self) -> None:
        """Free what the renderer holds."""
        ...

    def __enter__(self) -> Renderer: ...

    def __exit__(self, *error: object) -> None: ...


def open_renderer(
    size: tuple[int, int] = (640, 480),
    renderer: str = "auto",
    context: Any = None,
    method: str = "raster",
) -> Renderer:
    """A renderer for pictures of ``size`` (width, height) in pixels, to use in a ``with`` block.

    ``renderer`` is ``"gl"``, ``"numpy"``, or ``"auto"``: gl where a driver is found (its
    ``.name`` says which it took); for ray tracing also ``"embree"``, NumPy with meshes left to
    the package embreex. ``context`` is a window's moderngl context. ``method`` is
    ``"raster"``, ``"ray-tracing"``, ``"radiosity"``, solved when the first picture asks for it, or
    ``"lightmap"``, the light of the file that the scene names.

    Raises
    ------
    PlaygroundError
        An impossible size, an unknown renderer or method, or ``"gl"`` without a driver.
    """
    size = check_size(size)
    check_method(method)
    if renderer not in RENDERERS:
        raise unknown_name("renderer", renderer, RENDERERS)
    if renderer == "embree":
        return _open_embree(size, method)
    if renderer != "numpy":
        from playground.render.gl.context import NoDriverError

        try:
            return _open_gl(size, context, method)
        except NoDriverError:
            if renderer == "gl":
                raise
    return _open_numpy(size, method)


def _open_embree(size: tuple[int, int], method: str) -> Renderer:
    if method != "ray-tracing":
        raise PlaygroundError(
            "the renderer embree only traces rays",
            got=method,
            fix="Add --method ray-tracing, or use --renderer numpy.",
        )
    from playground.render.trace.tracer import EmbreeTracer

    return EmbreeTracer(size)


def _open_gl(size: tuple[int, int], context: Any, method: str) -> Renderer:
    if method == "ray-tracing":
        from playground.render.gl.trace.tracer import GLTracer

        return GLTracer(size, context)
    if method in STORED:
        from playground.render.gl.context import headless
        from playground.render.gl.stored import GLStored

        context = context or headless()
        return GLStored(size, light_of(method, "auto", context), context)
    from playground.render.gl.renderer import GLRenderer

    return GLRenderer(size, context)


def _open_numpy(size: tuple[int, int], method: str) -> Renderer:
    if method == "ray-tracing":
        from playground.render.trace.tracer import NumpyTracer

        return NumpyTracer(size)
    if method in STORED:
        from playground.render.stored_renderer import NumpyStored

        return NumpyStored(size, light_of(method, "numpy"))
    from playground.render.numpy_renderer import NumpyRenderer

    return NumpyRenderer(size)


def light_of(method: str, renderer: str = "auto", context: Any = None) -> LightSource:
    """Where a method of `STORED` has its light from."""
    if method == "lightmap":
        from playground.render.lightmap.light_source import LightmapLight

        return LightmapLight()
    from playground.render.radiosity.light_source import RadiosityLight

    return RadiosityLight(renderer, context)


def render(
    setup: Setup,
    size: tuple[int, int] = (640, 480),
    renderer: str = "auto",
    method: str = "raster",
) -> Image:
    """The picture of ``setup``: linear float32 light, row 0 on top.

    Parameters
    ----------
    setup : Setup
    size : (int, int)
        Width and height in pixels.
    renderer : {"auto", "gl", "numpy", "embree"}
    method : {"raster", "ray-tracing", "radiosity", "lightmap"}

    Raises
    ------
    PlaygroundError
        An unknown name, an impossible size, or ``renderer="gl"`` without a driver.
    """
    check_setup(setup)
    with open_renderer(size, renderer, method=method) as opened:
        image = opened.render(setup)
    assert isinstance(image, Image)
    return image
