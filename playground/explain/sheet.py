"""The figures of the lecture: the four terms and their sum, the row of shininess, the shadings.

Those of ray tracing are in `playground.explain.ray_sheet`, of radiosity in `radiosity_sheet`.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from playground.errors import unknown_name
from playground.explain.panels import Panel, Sheet, lay_out
from playground.render.image import Image
from playground.render.renderer import Renderer, open_renderer
from playground.scene.settings import TERMS
from playground.scene.setup import Setup

TRACED = ("depth", "tests")  # sheets that are drawn by ray tracing
GLOBAL = ("bounces", "answers")  # sheets of light between surfaces
SHEETS = ("terms", "shininess", "shading", *TRACED, *GLOBAL)
SHININESS = (5, 10, 20, 80)
MAGNIFY = 8
SAMPLES = 4


def make_sheet(
    setup: Setup,
    kind: str,
    size: tuple[int, int] = (400, 300),
    renderer: str = "auto",
    progress: Callable[[float], object] = lambda share: None,
) -> Sheet:
    """Lay out the figure ``kind``, one of `SHEETS`, with panels of ``size``.

    ``progress`` is told the share done of those that take long, `GLOBAL`.

    Raises
    ------
    PlaygroundError
        No figure of that name, or what `render` refuses.
    """
    if kind not in SHEETS:
        raise unknown_name("sheet", kind, SHEETS)
    if kind in GLOBAL:
        from playground.explain.radiosity_sheet import answers_sheet, bounce_sheet

        draw_global = bounce_sheet if kind == "bounces" else answers_sheet
        return draw_global(setup, size, renderer, progress)
    if kind in TRACED:
        from playground.explain.ray_sheet import depth_sheet, tests_sheet

        draw = depth_sheet if kind == "depth" else tests_sheet
        with open_renderer(size, renderer, method="ray-tracing") as opened:
            return draw(setup, opened)
    make = {"terms": _terms, "shininess": _shininess, "shading": _shading}[kind]
    with open_renderer(size, renderer) as opened:
        if opened.name == "gl":  # smooth edges for the projector, where they cost little
            setup = setup.with_(samples=max(SAMPLES, setup.settings.samples))
        return make(setup, opened)


def _picture(renderer: Renderer, setup: Setup) -> Image:
    image = renderer.render(setup)
    assert isinstance(image, Image)
    return image


def _terms(setup: Setup, renderer: Renderer) -> Sheet:
    """(a)–(d) the terms alone and (e) their sum, per-vertex above per-fragment."""
    rows, errors, clipped = [], {}, 0.0
    for shading in ("per-vertex", "per-fragment"):
        shaded = setup.with_(shading=shading)
        alone = [_picture(renderer, shaded.with_(terms=(term,))) for term in TERMS]
        whole = _picture(renderer, shaded.with_(terms=TERMS))
        errors[shading] = _sum_error(alone, whole)
        clipped = max(clipped, float(np.mean((whole.pixels > 1.0).any(axis=-1))))
        names = [f"({letter}) {term}" for letter, term in zip("abcd", TERMS, strict=True)]
        rows.append(
            [
                Panel(image.codes(), f"{name}, {shading}")
                for image, name in zip([*alone, whole], [*names, "(e) sum"], strict=True)
            ]
        )
    message = (
        f"(a) + (b) + (c) + (d) = (e) to {errors['per-fragment']:.1e} per-fragment and to "
        f"{errors['per-vertex']:.1e} where the rasteriser interpolates the colours; "
        f"linear light, before the display clamps the {100 * clipped:.1f} % of pixels above 1"
    )
    return Sheet(
        lay_out(rows, f"{setup.name}: the four terms and their sum", message),
        setup,
        message,
        max(errors.values()),
    )


def _sum_error(alone: list[Image], whole: Image) -> float:
    """How far the four pictures of single terms add up to the fifth, linear light.

    Every picture holds the background once, weighted by what no surface covers.
    """
    assert whole.coverage is not None
    assert whole.setup is not None
    behind = (1.0 - whole.coverage[..., None]) * np.array(whole.setup.scene.background)
    total = np.sum([image.pixels.astype(np.float64) - behind for image in alone], axis=0)
    return float(np.max(np.abs(total + behind - whole.pixels)))


def _shininess(setup: Setup, renderer: Renderer) -> Sheet:
    """(a)–(d): the same scene with shininess 5, 10, 20 and 80."""
    row = [
        Panel(
            _picture(renderer, setup.with_(shininess=sh)).codes(),
            f"({letter}) sh = {sh}",
        )
        for letter, sh in zip("abcd", SHININESS, strict=True)
    ]
    message = (
        "the larger the shininess, the faster (r·v)^sh falls off, and the smaller the highlight"
    )
    heading = f"{setup.name}: shininess {', '.join(map(str, SHININESS))}"
    return Sheet(lay_out([row], heading, message), setup, message)


def _shading(setup: Setup, renderer: Renderer) -> Sheet:
    """Flat | per-vertex | per-fragment | how the last two differ, magnified."""
    modes = ("flat", "per-vertex", "per-fragment")
    images = [_picture(renderer, setup.with_(shading=mode)) for mode in modes]
    row = [Panel(image.codes(), mode) for image, mode in zip(images, modes, strict=True)]
    difference = np.abs(images[1].shown() - images[2].shown())
    magnified = np.clip(MAGNIFY * difference, 0.0, 1.0)
    codes = np.floor(255.0 * magnified + 0.5).astype(np.uint8)
    row.append(Panel(codes, f"|per-vertex − per-fragment| × {MAGNIFY}"))
    message = (
        "per-vertex differs from per-fragment by at most "
        f"{difference.max():.3f}, on average {difference.mean():.5f}, of full intensity"
    )
    heading = f"{setup.name}: the model evaluated per triangle, per vertex, per fragment"
    return Sheet(lay_out([row], heading, message), setup, message)
