"""Figures of stored light: radiosity bounce by bounce, and one scene drawn by five methods."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from playground.explain.panels import Panel, Sheet, lay_out
from playground.render.image import Image
from playground.render.radiosity.drawn import DrawnPatches
from playground.render.radiosity.result import Radiosity, radiosity
from playground.render.renderer import Renderer, open_renderer
from playground.render.stored import StoredLight
from playground.render.stored_renderer import LightSource, NumpyStored
from playground.render.trace.path import PathTracing
from playground.scene.settings import Shading
from playground.scene.setup import Setup
from playground.shading.display import code8
from playground.shading.floats import Array

REFLECTIONS = 3  # pictures of so many, then all of them
MAGNIFY = 4
TEXELS, RAYS = 128, 32  # of a lightmap that is baked for the figure
PATHS = 8  # per pixel, of the reference
PATHS_DONE, SOLVED, BAKED = 0.45, 0.75, 0.95  # how far the five answers are then, about
Size = tuple[int, int]
Progress = Callable[[float], object]


def _untold(share: float) -> None:
    """Nobody asks how far the work is."""


class GivenLight:
    """A `LightSource` of patches whose light somebody else computes."""

    warnings: tuple[str, ...] = ()

    def __init__(self, drawn: DrawnPatches) -> None:
        self._drawn = drawn
        self.arriving: Array = np.zeros((len(drawn.patches.area), 3))

    def prepare(self, setup: Setup) -> Iterator[float]:
        """Nothing is left to compute."""
        return iter(())

    def stored(self, setup: Setup) -> tuple[StoredLight | None, ...]:
        """The light per object."""
        return self._drawn.stored(self.arriving)

    def note(self) -> str:
        """Nothing more is known."""
        return ""

    def close(self) -> None:
        """Nothing is held."""


def bounce_sheet(
    setup: Setup, size: Size, renderer: str = "auto", progress: Progress = _untold
) -> Sheet:
    """Emission alone, light reflected once, twice, ..., and all of it; below, what each adds.

    Highlights are left out. All light comes from the same gathering, so that the pictures of
    few reflections tend to that of all of them. ``progress`` is told the share of the work done.
    """
    plain = setup.with_(specular_weight=0.0, solver="gauss-seidel", light_shown="all")
    result = radiosity(plain, renderer)
    try:
        for share in result.solving():
            progress(BAKED * share)
        light = [*arriving_by_bounce(result, REFLECTIONS), result.arriving]
        flat = plain.settings.shading == Shading.FLAT
        pictures = _pictures(plain, size, renderer, GivenLight(result.drawn(flat)), light)
    finally:
        result.close()
    names = ["emission alone", *map(_reflections, range(1, REFLECTIONS + 1)), "all reflections"]
    above = [Panel(image.codes(), name) for image, name in zip(pictures, names, strict=True)]
    below = [Panel(np.full_like(above[0].codes, 255), "")]
    for k in range(1, len(pictures)):
        more = np.abs(pictures[k].shown() - pictures[k - 1].shown())
        what = f"what {_ordinal(k)} adds" if k <= REFLECTIONS else "what all others add"
        below.append(Panel(_magnified(more), f"{what}, × {MAGNIFY}"))
    message = _shares(result, light)
    heading = f"{setup.name}: radiosity, reflection by reflection"
    return Sheet(lay_out([above, below], heading, message), setup, message)


def arriving_by_bounce(result: Radiosity, most: int) -> list[Array]:
    """What arrives at each patch, (N, 3), of light reflected up to k times, k = 0 to ``most``.

    At k = 0 nothing is asked to arrive: only what shines by itself is seen. At k = 1 it is direct
    light, H = D + F E, whose reflection is seen; then H = D + F (E + rho H).
    """
    result.solve()
    system = result.system
    arriving = [np.zeros_like(system.emission)]
    for _ in range(most):
        leaving = system.emission + system.reflectance * arriving[-1]
        arriving.append(np.asarray(system.direct + system.form_factors.gather(leaving)))
    return arriving


def answers_sheet(
    setup: Setup, size: Size, renderer: str = "auto", progress: Progress = _untold
) -> Sheet:
    """The scene by local Phong, lightmap, ray tracing, radiosity, and paths taken by chance.

    The lightmap is that of the setup; without one, a small one is baked for the figure. All show
    all light. ``progress`` is told the share of the work done.
    """
    setup = setup.with_(light_shown="all")
    reference = PathTracing(setup, size)
    for share in reference.steps(PATHS):
        progress(PATHS_DONE * share)
    paths = reference.image()
    solved, baked = _solved(setup, size, renderer, progress)
    pictures = {
        "local Phong": _drawn(setup, size, renderer, "raster"),
        "lightmap": baked,
        "ray tracing": _drawn(setup, size, renderer, "ray-tracing"),
        "radiosity": solved,
        f"path-traced, {PATHS} paths per pixel": paths,
    }
    away = {name: _distance(image, paths) for name, image in pictures.items() if image is not paths}
    row = [
        Panel(image.codes(), f"({letter}) {name}")
        for letter, (name, image) in zip("abcde", pictures.items(), strict=True)
    ]
    blank = np.full_like(row[0].codes, 255)
    below = [
        Panel(_magnified(np.abs(image.shown() - paths.shown())), f"|({x}) − (e)| × {MAGNIFY}")
        for x, image in zip("abcd", pictures.values(), strict=False)
    ]
    far = ", ".join(f"{name} {value:.3f}" for name, value in away.items())
    noise = float(np.mean(reference.standard_error()))
    message = (
        "mean difference from the path-traced picture, of full intensity as shown: "
        f"{far}; that picture has a standard error of {noise:.3f} on average, in linear light, and "
        "no highlights. Local Phong has no shadows and an ambient term for all light between "
        "surfaces; ray tracing has shadows and the same ambient term"
    )
    heading = f"{setup.name}: one scene, five answers"
    return Sheet(lay_out([row, [*below, Panel(blank, "")]], heading, message), setup, message)


def _pictures(
    setup: Setup, size: Size, renderer: str, light: GivenLight, arriving: Sequence[Array]
) -> list[Image]:
    """A picture for each light."""
    found = []
    with _open(size, renderer, light) as opened:
        for each in arriving:
            light.arriving = each
            if opened.name == "gl":
                opened.ask_again()  # type: ignore[attr-defined]
            image = opened.render(setup)
            assert isinstance(image, Image)
            found.append(image)
    return found


def _open(size: Size, renderer: str, light: LightSource) -> Renderer:
    """A renderer of this light: the GPU where there is one and it may be used."""
    if renderer != "numpy":
        from playground.render.gl.context import NoDriverError, headless
        from playground.render.gl.stored import GLStored

        try:
            return GLStored(size, light, headless())
        except NoDriverError:
            if renderer == "gl":
                raise
    return NumpyStored(size, light)


def _drawn(setup: Setup, size: Size, renderer: str, method: str) -> Image:
    with open_renderer(size, renderer, method=method) as opened:
        image = opened.render(setup)
    assert isinstance(image, Image)
    return image


def _solved(setup: Setup, size: Size, renderer: str, progress: Progress) -> tuple[Image, Image]:
    """By radiosity, solved once, and by the lightmap of the setup, or one baked of it."""
    result = radiosity(setup, renderer)
    try:
        for share in result.solving():
            progress(PATHS_DONE + (SOLVED - PATHS_DONE) * share)
        drawn = GivenLight(result.drawn(setup.settings.shading == Shading.FLAT))
        picture = _pictures(setup, size, renderer, drawn, [result.arriving])[0]
        if setup.scene.lightmap:
            return picture, _drawn(setup, size, renderer, "lightmap")
        return picture, _baked(result, size, renderer, progress)
    finally:
        result.close()


def _baked(result: Radiosity, size: Size, renderer: str, progress: Progress) -> Image:
    """By a small lightmap that is made for the figure."""
    from playground.render.lightmap.bake import bake

    def told(share: float) -> None:
        progress(SOLVED + (BAKED - SOLVED) * share)

    setup, lightmap = result.setup, bake(result, TEXELS, RAYS, told)
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "figure.npz")
        lightmap.save(file)
        return _drawn(setup.with_(lightmap=str(file)), size, renderer, "lightmap")


def _distance(image: Image, reference: Image) -> float:
    return float(np.mean(np.abs(image.shown() - reference.shown())))


def _magnified(difference: Array) -> NDArray[np.uint8]:
    return code8(np.clip(MAGNIFY * difference, 0.0, 1.0))


def _shares(result: Radiosity, light: Sequence[Array]) -> str:
    """Of all the light that arrives, how much each number of reflections brings."""
    power = [float((result.patches.area @ each).sum()) for each in light]
    told = [
        f"{_ordinal(k)} {100.0 * (power[k] - power[k - 1]) / power[-1]:.1f} %"
        for k in range(1, len(power) - 1)
    ]
    rest = 100.0 * (power[-1] - power[-2]) / power[-1]
    return (
        f"of all light that arrives at surfaces, {', '.join(told)}, all others {rest:.1f} %; "
        "the first reflects what comes straight from lamps and emitters; highlights are left out"
    )


def _reflections(count: int) -> str:
    return "1 reflection" if count == 1 else f"{count} reflections"


def _ordinal(count: int) -> str:
    return f"the {('first', 'second', 'third')[count - 1]}"
