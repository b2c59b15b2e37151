"""Figures of ray tracing: one picture per depth with what each adds; the tests per pixel."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from playground.explain.colour_map import colour_of
from playground.explain.panels import INK, PAPER, Panel, Sheet, lay_out, typeface
from playground.explain.ray_tests import ray_tests
from playground.render.image import Image
from playground.render.renderer import Renderer
from playground.scene.setup import Setup
from playground.shading.display import code8

MOST = 12  # pictures of one sheet
COLUMNS = 4
MAGNIFY = 4
FEW = 0.005  # of the pixels of a heat map may lie beyond its scale


def depth_sheet(setup: Setup, renderer: Renderer) -> Sheet:
    """The picture at depth 0, 1, 2, ..., and under each what the depth has added.

    It ends where no ray is left to follow, at the setup's own depth, or when the sheet is full.
    """
    images = [_traced(renderer, setup.with_(depth=0))]
    added: list[NDArray[np.float64]] = []
    for depth in range(1, min(setup.settings.depth, MOST - 1) + 1):
        if _nothing_left(images[-1]):
            break
        images.append(_traced(renderer, setup.with_(depth=depth)))
        added.append(np.abs(images[-1].shown() - images[-2].shown()))
    above = [Panel(image.codes(), f"depth {depth}") for depth, image in enumerate(images)]
    below = [Panel(np.full_like(above[0].codes, 255), "")]
    for depth, more in enumerate(added, 1):
        codes = code8(np.clip(MAGNIFY * more, 0.0, 1.0))
        below.append(Panel(codes, f"depth {depth} − depth {depth - 1}, × {MAGNIFY}"))
    rows = []
    for start in range(0, len(images), COLUMNS):
        part = slice(start, start + COLUMNS)
        rows += [above[part], below[part]]
    message = _told(added, images[-1])
    heading = f"{setup.name}: what each bounce adds"
    return Sheet(lay_out(rows, heading, message), setup, message)


def _told(added: list[NDArray[np.float64]], last: Image) -> str:
    """What the depths add, and what is still left out after the last one."""
    parts = [
        f"depth {depth} adds at most {more.max():.3f}, on average {more.mean():.5f}"
        for depth, more in enumerate(added, 1)
    ]
    told = f"{'; '.join(parts)} (of full intensity, as shown); " if parts else ""
    if _nothing_left(last):
        return f"{told}after depth {len(added)} no ray goes on"
    return f"{told}after depth {len(added)} {last.left_out}"


def _nothing_left(image: Image) -> bool:
    return image.left_out is not None and image.left_out.max == 0.0


def _traced(renderer: Renderer, setup: Setup) -> Image:
    image = renderer.render(setup)
    assert isinstance(image, Image)
    return image


def tests_sheet(setup: Setup, renderer: Renderer) -> Sheet:
    """The picture beside the intersection tests of each pixel, with a scale of their colours."""
    image = _traced(renderer, setup)
    found = ray_tests(setup, renderer.size)
    first, every = (_heat(counts) for counts in found)
    row = [
        Panel(image.codes(), "the picture"),
        Panel(first, "tests of the primary ray"),
        Panel(every, "tests of all rays but shadow rays"),
    ]
    counted = [f"{c.mean():.4g} on average, {c.max()} at most" for c in found]
    message = (
        "a test is one shape with a formula, one box of a tree or one triangle held against a ray: "
        f"per primary ray {counted[0]}; per pixel, reflected and refracted rays included, "
        f"{counted[1]}"
    )
    heading = f"{setup.name}: intersection tests per pixel"
    return Sheet(lay_out([row], heading, message), setup, message)


def _heat(counts: NDArray[np.int64]) -> NDArray[np.uint8]:
    """Counts (H, W) as colours, with their scale along the lower edge.

    It ends where no more than `FEW` of the pixels lie beyond: one pixel does not darken the rest.
    """
    from PIL import Image as Pictures
    from PIL import ImageDraw

    top = max(int(np.quantile(counts, 1.0 - FEW, method="higher")), 1)
    picture = Pictures.fromarray(code8(colour_of(counts / top)))
    height, width = counts.shape
    size = max(height // 22, 7)
    high, left, right = round(2.6 * size), round(0.08 * width), round(0.92 * width)
    draw = ImageDraw.Draw(picture)
    draw.rectangle((0, height - high, width, height), PAPER)
    scale = code8(colour_of(np.linspace(0.0, 1.0, right - left)))
    bar = np.broadcast_to(scale, (size, *scale.shape))
    picture.paste(Pictures.fromarray(np.ascontiguousarray(bar)), (left, height - high + size // 3))
    for share in (0.0, 0.5, 1.0):
        more = "≥ " if share == 1.0 and counts.max() > top else ""
        place = left + share * (right - left), height - 0.2 * size
        draw.text(place, f"{more}{share * top:.10g}", INK, typeface(size), "mb")
    return np.asarray(picture)
