"""Lightmaps: how large they must be and how long they take; what a frame with one costs."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import ExitStack, closing
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from playground.measure.experiments.sentences import of, reach, sentence, times
from playground.measure.gathered import REFERENCE, Gathered, gathered_picture, light_errors
from playground.measure.record import Candidate, Errors, Experiment, Timer
from playground.measure.rows import Row, slope
from playground.measure.textured_floor import TexturedFloor
from playground.measure.timing import rounds_of
from playground.percent import percent
from playground.render.image import Image
from playground.render.lightmap.bake import bake
from playground.render.lightmap.lightmap import Lightmap
from playground.render.radiosity.result import Radiosity, radiosity
from playground.render.renderer import open_renderer
from playground.scene.library import load
from playground.scene.setup import Setup
from playground.shading.floats import Array

SIZE, QUICK_SIZE = (80, 60), (32, 24)  # of the pictures that are judged
TEXELS, QUICK_TEXELS = (32, 64, 128, 256), (32, 64)
PATCHES, QUICK_PATCHES = 600, 150
FRAME = (1280, 720)
FRAME_TEXELS, QUICK_FRAME_TEXELS = 256, 64
WAYS = {"from the patches": 0, "gathered, 16 rays": 16, "gathered, 256 rays": 256}  # rays a texel
QUICK_WAYS = ("from the patches", "gathered, 16 rays")
DRAWN = "no lightmap: drawn by patches"
BAKING, FRAMES = "baking", "a frame"
FLOOR, LIGHTMAP = "unlit texture", "lightmap"
BESIDE = "beside the patches"
BOUND = 0.05


def groups(quick: bool) -> Iterator[list[Candidate]]:
    """All ways to bake at all sizes in turn; then a frame beside an unlit textured one."""
    sizes, ways = (QUICK_TEXELS, QUICK_WAYS) if quick else (TEXELS, tuple(WAYS))
    baked = [_baked(way, texels, quick) for texels in sizes for way in ways]
    yield [_by_patches(quick), *baked]
    yield [_frame(FLOOR, quick), _frame(LIGHTMAP, quick)]


@lru_cache(maxsize=1)
def _scene() -> Setup:
    """The Cornell box, shown without exposure and curve, which the floor does not have either."""
    setup = load("cornell-box").with_(terms=("diffuse", "emissive"))
    return setup.with_(exposure=1.0, curve="none")


@lru_cache(maxsize=2)
def _solved(quick: bool) -> Radiosity:
    result = radiosity(_scene().with_(patches=QUICK_PATCHES if quick else PATCHES)).solve()
    result.close()
    return result


@lru_cache(maxsize=2)
def _reference(quick: bool) -> Gathered:
    return gathered_picture(_scene(), QUICK_SIZE if quick else SIZE, quick)


@lru_cache(maxsize=2)
def _patch_picture(quick: bool) -> Array:
    """The solution as its patches show it."""
    setup, size = _solved(quick).setup, QUICK_SIZE if quick else SIZE
    with open_renderer(size, method="radiosity") as drawn:
        return _pixels(drawn.render(setup))


def _pixels(image: Any) -> Array:
    assert isinstance(image, Image)
    return np.asarray(image.pixels, dtype=np.float64)


def _by_patches(quick: bool) -> Candidate:
    def opened(_: ExitStack) -> Timer:
        result = _solved(quick)
        return rounds_of(lambda: result.stored(), 1)

    def errors() -> Errors:
        return light_errors(_patch_picture(quick), _reference(quick))

    return Candidate(DRAWN, {}, opened, errors, BAKING)


def _baked(way: str, texels: int, quick: bool) -> Candidate:
    def opened(_: ExitStack) -> Timer:
        result = _solved(quick)
        return rounds_of(lambda: bake(result, texels, WAYS[way]), 1)

    def errors() -> Errors:
        with ExitStack() as stack:
            setup = _saved(bake(_solved(quick), texels, WAYS[way]), stack)
            size = QUICK_SIZE if quick else SIZE
            drawn = stack.enter_context(open_renderer(size, method="lightmap"))
            pixels = _pixels(drawn.render(setup))
        patches = replace(_reference(quick), pixels=_patch_picture(quick))
        return light_errors(
            pixels, _reference(quick), **{BESIDE: light_errors(pixels, patches).mean}
        )

    return Candidate(way, {"texels": texels}, opened, errors, BAKING)


def _saved(lightmap: Lightmap, stack: ExitStack) -> Setup:
    """The scene with a lightmap, which is a file for as long as the stack stands."""
    folder = Path(stack.enter_context(TemporaryDirectory()))
    file = folder / "box.lightmap.npz"
    lightmap.save(file)
    return _scene().with_(lightmap=str(file))


def _frame(method: str, quick: bool) -> Candidate:
    def opened(stack: ExitStack) -> Timer:
        texels = QUICK_FRAME_TEXELS if quick else FRAME_TEXELS
        draw = _drawing(method, bake(_solved(quick), texels, 0), stack)
        step = 0

        def frame() -> None:
            nonlocal step
            step += 1
            draw(step)

        return rounds_of(frame)

    return Candidate(method, {}, opened, None, FRAMES)


def _drawing(method: str, lightmap: Lightmap, stack: ExitStack) -> Callable[[int], Any]:
    """Draws one step of a moving camera into an array of 8-bit RGBA."""
    if method == FLOOR:
        floor = stack.enter_context(
            closing(TexturedFloor(FRAME, _meshes(lightmap), lightmap.texels()))
        )
        return lambda step: floor.frame(_moved(_scene(), step).camera, 100.0, 2000.0)
    setup = _saved(lightmap, stack)
    drawn = stack.enter_context(open_renderer(FRAME, "gl", method="lightmap"))
    codes = np.empty((FRAME[1], FRAME[0], 4), np.uint8)
    return lambda step: drawn.render(_moved(setup, step), out=codes)


def _moved(setup: Setup, step: int) -> Setup:
    """The camera, a millimetre further for each of a hundred steps, and back."""
    x, y, z = setup.camera.eye
    return setup.with_(eye=(x + step % 100, y, z))


def _meshes(lightmap: Lightmap) -> list[tuple[Array, Any, Any]]:
    """Corners in the world, triangles and places in the atlas of every object."""
    found = []
    for item, part in zip(_scene().scene.objects, lightmap.parts, strict=True):
        if part is not None:
            geometry, matrix = item.geometry(), item.transform.matrix
            local = part.mesh(geometry.mesh).positions + geometry.offset
            found.append((local @ matrix[:3, :3].T + matrix[:3, 3], part.faces, part.texcoords))
    return found


def finding(rows: list[Row]) -> str:
    """How large a lightmap comes within a bound, how errors fall, and what a frame costs."""
    parts = []
    baked = [row for row in rows if row.case == BAKING and "texels" in row.knobs]
    best, drawn = reach(baked, BOUND), of(rows, DRAWN)
    if best is not None:
        parts.append(
            f"{percent(BOUND)} takes {best.knobs['texels']} texels a side, {best.method} "
            f"({best.median / 1e3:.2g} s to bake)"
        )
    elif baked:
        parts.append(f"no lightmap comes within {percent(BOUND)}")
    if drawn and drawn[0].error is not None:
        parts.append(f"drawn by its patches the same solution is off by {percent(drawn[0].error)}")
    powers = ((way, slope(of(baked, way), "texels")) for way in WAYS)
    falls = [f"{power:.1f} ({way})" for way, power in powers if power is not None]
    if falls:
        parts.append(f"errors go as texels to the power {', '.join(falls)}")
    frame = of(rows, LIGHTMAP)
    if frame and frame[0].ratio is not None:
        parts.append(f"a frame takes {times(frame[0].ratio)} the time of an unlit textured one")
    return sentence(*parts)


EXPERIMENT = Experiment(
    "lightmap",
    "Lightmap",
    "How many texels must a lightmap have, should its light be gathered anew, and is it drawn as "
    "fast as a texture?",
    groups,
    finding,
    REFERENCE,
    error="mean",
    error_label="mean error / mean light",
    time_label="ms to bake; per frame",
    show=("mean", "rmse", BESIDE),
    ratio_to=FLOOR,
)
