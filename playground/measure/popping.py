"""The popping scope: what happens to a highlight while the camera moves.

The camera orbits its target; at each step the brightest point of the highlight and the
mean brightness are read off the picture, for per-vertex and per-fragment shading and for
the float64 reference. Per-vertex shading pops: its curve jumps where the others glide.
"""

from __future__ import annotations

from collections.abc import Generator, Iterable, Mapping
from dataclasses import dataclass, replace
from math import cos, radians, sin
from typing import Any

import numpy as np

from playground.measure.metrics import LUMINANCE
from playground.render.image import Image
from playground.render.renderer import Renderer, open_renderer
from playground.scene.camera import Camera
from playground.scene.setup import Setup

MODES = ("per-vertex", "per-fragment", "reference")


@dataclass(frozen=True)
class Brightness:
    """Of one picture: the largest component of its specular term, and its mean luminance."""

    peak: float
    mean: float


@dataclass(frozen=True)
class Step:
    """One position of the camera: the angle in degrees, and what each mode shows there."""

    angle: float
    modes: dict[str, Brightness]


def orbit(camera: Camera, angle: float) -> Camera:
    """The camera turned by ``angle`` degrees about the vertical axis through its target."""
    c, s = cos(radians(angle)), sin(radians(angle))
    x, y, z = (e - t for e, t in zip(camera.eye, camera.target, strict=True))
    tx, ty, tz = camera.target
    return replace(camera, eye=(tx + c * x + s * z, ty + y, tz + c * z - s * x))


def scope(
    setup: Setup,
    angles: Iterable[float],
    modes: Iterable[str] = MODES,
    size: tuple[int, int] = (160, 120),
    renderer: str = "auto",
    context: Any = None,
) -> Generator[Step]:
    """Measure ``setup`` at each angle of the orbit; yields as it goes.

    Parameters
    ----------
    angles : degrees from where the camera stands
    modes : of "flat", "per-vertex", "per-fragment" and "reference"
    size : of the pictures that are measured, in pixels
    renderer : for every mode but the reference, which is float64 NumPy
    context : of a window, to draw in
    """
    with open_renderer(size, renderer, context) as drawn, open_renderer(size, "numpy") as exact:
        opened = {mode: exact if mode == "reference" else drawn for mode in modes}
        yield from along(setup, angles, opened)


def along(setup: Setup, angles: Iterable[float], opened: Mapping[str, Renderer]) -> Generator[Step]:
    """As `scope`, with a renderer for each mode that is measured."""
    for angle in angles:
        turned = setup.with_(camera=orbit(setup.camera, angle), samples=1)
        found = {}
        for mode, renderer in opened.items():
            shading = "per-fragment" if mode == "reference" else mode
            whole = renderer.render(turned.with_(shading=shading))
            highlight = renderer.render(
                turned.with_(shading=shading, terms=("specular",), background=(0, 0, 0))
            )
            assert isinstance(whole, Image)
            assert isinstance(highlight, Image)
            mean = float(np.mean(whole.pixels.astype(np.float64) @ LUMINANCE))
            found[mode] = Brightness(float(highlight.pixels.max()), mean)
        yield Step(angle, found)


def largest_jump(steps: Iterable[Step], mode: str) -> Brightness:
    """The largest change of peak and of mean from one step to the next."""
    values = [step.modes[mode] for step in steps]
    if len(values) < 2:
        return Brightness(0.0, 0.0)
    peaks = np.diff([value.peak for value in values])
    means = np.diff([value.mean for value in values])
    return Brightness(float(np.abs(peaks).max()), float(np.abs(means).max()))
