"""Samples per pixel: what they cost and how far the picture is from infinitely many."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import lru_cache

import numpy as np

from playground.measure.experiments.sentences import of, sentence, times
from playground.measure.experiments.spheres import QUICK_SIZE, SIZE, sphere
from playground.measure.jackknife import jackknife
from playground.measure.metrics import flip_map, largest, rmse
from playground.measure.pictures import picture, picture_errors
from playground.measure.record import Candidate, Errors, Experiment
from playground.measure.rows import Row, ratio, slope
from playground.measure.timing import frames_of
from playground.percent import percent
from playground.render.image import Image
from playground.render.numpy_renderer import render_sample
from playground.render.raster.coverage import SUBPIXELS
from playground.render.renderer import open_renderer
from playground.scene.setup import Setup
from playground.shading.vector import Array

SAMPLES, QUICK_SAMPLES = (1, 2, 4, 8, 16), (1, 4)
TESSELLATION = 24  # coarse enough for a polygonal silhouette
BATCHES, CELLS, QUICK_CELLS = 10, 5, 2  # of the reference: batches of CELLS² stratified samples
SEED = 1
RENDERERS = {"GL": "gl", "NumPy": "numpy"}


def groups(quick: bool) -> Iterator[list[Candidate]]:
    """Each renderer with each number of samples that it takes, all in turn."""
    size = QUICK_SIZE if quick else SIZE
    setup = sphere(TESSELLATION)
    with open_renderer((8, 8), "gl") as gl:
        most = {n: gl.samples(setup.with_(samples=n)) for n in QUICK_SAMPLES + SAMPLES}
    counts = QUICK_SAMPLES if quick else SAMPLES
    cells = QUICK_CELLS if quick else CELLS
    yield [
        _candidate(name, n, size, cells)
        for name, renderer in RENDERERS.items()
        for n in counts
        if renderer == "numpy" or most[n] == n
    ]


def _candidate(name: str, samples: int, size: tuple[int, int], cells: int) -> Candidate:
    setup, renderer = sphere(TESSELLATION).with_(samples=samples), RENDERERS[name]

    def errors() -> Errors:
        got = picture(setup, size, renderer)
        batches = reference_batches(size, cells)
        want = _image(np.mean(batches, axis=0), setup)
        judged = picture_errors(got, want, _reference(cells))
        shown = got.shown()
        spread = {
            "rmse": jackknife(lambda mean: rmse(got.pixels, mean), batches),
            "max": jackknife(lambda mean: largest(got.pixels, mean), batches),
            "flip": jackknife(
                lambda mean: float(np.mean(flip_map(_image(mean, setup).shown(), shown))), batches
            ),
        }
        own = np.std(batches, axis=0, ddof=1) / np.sqrt(len(batches))
        noise = {"noise of the reference": float(np.sqrt(np.mean(own**2)))}
        return replace(judged, uncertainty=spread, more=noise)

    opened = frames_of(setup, size, renderer)
    return Candidate(name, {"samples": samples}, opened, errors)


def _reference(cells: int) -> str:
    return f"{BATCHES * cells**2} samples per pixel at random places, one per cell, in float64"


def _image(pixels: Array, setup: Setup) -> Image:
    return Image(pixels.astype(np.float32), setup=setup)


@lru_cache(maxsize=2)
def reference_batches(size: tuple[int, int], cells: int) -> tuple[Array, ...]:
    """Independent pictures (H, W, 3), each the mean of one random sample per cell of a pixel."""
    rng = np.random.default_rng(SEED)
    setup = sphere(TESSELLATION)
    batches = []
    for _ in range(BATCHES):
        total = np.zeros((size[1], size[0], 3))
        for row in range(cells):
            for column in range(cells):
                place = (np.array([column, row]) + rng.random(2)) / cells
                x, y = np.floor(place * SUBPIXELS) / SUBPIXELS  # as the rasteriser rounds them
                total += render_sample(setup, size, (float(x), float(y)))[0]
        batches.append(total / cells**2)
    return tuple(batches)


def finding(rows: list[Row]) -> str:
    """What the most samples bring and cost in each renderer, and how the error falls."""
    parts = []
    for name in RENDERERS:
        found = sorted(of(rows, name), key=lambda row: int(row.knobs["samples"]))
        if len(found) < 2 or not found[0].error or not found[-1].error:
            continue
        first, last = found[0], found[-1]
        power = slope(found, "samples")
        parts.append(
            f"{name}: {last.knobs['samples']} samples take "
            f"{times(ratio(last, first))} the time of {first.knobs['samples']} and change "
            f"the error from {percent(first.error or 0.0)} to {percent(last.error or 0.0)}, "
            f"as samples to the power {power:.2f}"
        )
    return sentence(*parts)


EXPERIMENT = Experiment(
    "anti-aliasing",
    "Anti-aliasing",
    "Samples per pixel: what does each cost, and how much closer does it bring the picture to "
    "infinitely many?",
    groups,
    finding,
    "the mean of many random samples per pixel in float64 (its own noise is in the table)",
    show=("rmse", "max", "flip", "off", "noise of the reference"),
)
