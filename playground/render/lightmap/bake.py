"""Bakes solved radiosity into a lightmap: texel by texel, seams closed, gutters filled."""

from __future__ import annotations

from collections.abc import Callable, Generator
from dataclasses import dataclass
from math import isqrt
from typing import TYPE_CHECKING

import numpy as np

from playground.errors import PlaygroundError
from playground.render.lightmap.atlas import GUTTER, check_size, unwrap
from playground.render.lightmap.buried import filled
from playground.render.lightmap.lighting import Lighting
from playground.render.lightmap.lightmap import Lightmap, geometry_checksum, lighting_checksum
from playground.render.lightmap.seams import find_seams, sewn
from playground.render.lightmap.texels import lay_out
from playground.render.radiosity.patch.memory import available
from playground.shading.floats import Array
from playground.shading.lightmap import dilated
from playground.steps import finished

if TYPE_CHECKING:
    from playground.render.radiosity.result import Radiosity

SIZE = 256  # texels along an edge, unless asked otherwise
RAYS = 256  # gathered per texel, unless asked otherwise
MOST_RAYS = 65536
BYTES = 1000  # of memory for each texel of the image, measured; a little more than it takes
BATCH = 1 << 18  # rays sent between two reports of progress


@dataclass(frozen=True)
class Baked:
    """A lightmap, and what is to be known of it.

    ``jump`` is the light's largest jump across a seam before and after sewing, as a share of the
    brightest texel, None without seams. ``lost`` counts texels that are buried too deep to be lit;
    ``split`` pairs of neighbours with a wall between them that is thinner than a texel: light
    comes through it, as far as a texel.
    """

    lightmap: Lightmap
    charts: int
    jump: tuple[float, float] | None
    lost: int
    split: int

    def __str__(self) -> str:
        share, size = self.lightmap.coverage.mean(), self.lightmap.size
        said = [f"{size}x{size} texels, {self.charts} charts cover {100.0 * share:.0f} %"]
        if self.jump is not None:
            before, after = (100.0 * x for x in self.jump)
            said.append(
                f"jump at seams {before:.2g} % of the brightest, {after:.2g} % after sewing"
            )
        if self.lost:
            said.append(f"{self.lost} texels lie inside something")
        if self.split:
            said.append(
                f"{self.split} neighbours have a wall between them that is thinner than both"
            )
        return "; ".join(said)


def bake(
    result: Radiosity,
    size: int = SIZE,
    rays: int = RAYS,
    progress: Callable[[float], None] | None = None,
) -> Lightmap:
    """The lightmap of a solved radiosity; ``progress`` is told the share done. See `baking`."""
    return finished(baking(result, size, rays), progress).lightmap


def baking(result: Radiosity, size: int = SIZE, rays: int = RAYS) -> Generator[float, None, Baked]:
    """Bake step by step: yields the share done, returns a `Baked`. May be dropped at any time.

    Parameters
    ----------
    result : Radiosity
        Is solved first, if it is not.
    size : int
        Texels along an edge.
    rays : int
        With how many rays indirect light is gathered at each texel; 0 takes the light of the
        patches instead, which is faster and as coarse as they are.

    Raises
    ------
    PlaygroundError
        A size or number of rays that is none, surfaces that do not fit into that size, or
        more texels than memory has room for while they are lit.
    """
    _check(size, rays)
    setup = result.setup
    atlas = unwrap(setup.scene, size)
    yield 0.01
    for _ in result.steps():
        yield 0.01 + 0.29 * result.progress
    texels = lay_out(setup.scene, atlas, result.patches.origin)
    lighting = Lighting(result, texels, rays)
    step = max(BATCH // max(rays, RAYS), 1)
    for first in range(0, len(texels), step):
        lighting.light(slice(first, first + step))
        yield 0.3 + 0.68 * min(first + step, len(texels)) / len(texels)

    covered = texels.coverage
    missing = texels.image(lighting.buried[:, None])[..., 0] > 0.0
    image = filled(texels.image(lighting.finished()), missing, covered)
    seams = find_seams(setup.scene, atlas)
    closed = sewn(image, seams)
    jump = None
    if len(seams.texel):
        brightest = max(float(image.max()), 1e-300)
        before, after = (float(np.abs(seams.jump(x)).max()) for x in (image, closed))
        jump = before / brightest, after / brightest
    closed = _with_gutters(closed, covered)
    chart = np.full((size, size), -1, dtype=np.int32)
    chart[texels.row, texels.column] = texels.chart
    direct, indirect = closed[..., :3].astype(np.float32), closed[..., 3:].astype(np.float32)
    checksums = geometry_checksum(setup.scene), lighting_checksum(setup)
    lightmap = Lightmap(size, direct, indirect, covered, chart, atlas.parts, *checksums)
    return Baked(lightmap, atlas.charts, jump, int(lighting.buried.sum()), lighting.split())


def _check(size: int, rays: int) -> None:
    """Raise an error before the work for numbers that make none, or more than fits into memory."""
    if isinstance(rays, bool) or not isinstance(rays, int) or not 0 <= rays <= MOST_RAYS:
        raise PlaygroundError(
            "this cannot be the number of rays per texel", got=rays, allowed=f"0 to {MOST_RAYS}"
        )
    check_size(size)
    free = available()
    if free is not None and size * size * BYTES > free:
        raise PlaygroundError(
            f"baking {size} x {size} texels does not fit into memory",
            got=f"{size}² × {BYTES} bytes = {size * size * BYTES / 1e9:.3g} GB, "
            f"and {free / 1e9:.3g} GB free",
            allowed=f"about {isqrt(free // BYTES)} texels along an edge on this machine",
        )


def _with_gutters(image: Array, covered: Array) -> Array:
    """The image with the texels around charts filled from their nearest neighbours."""
    rows, columns = np.nonzero(~covered)
    texel = np.stack([columns, rows], axis=-1)
    known, result = covered, image
    for _ in range(GUTTER):
        passes = [
            dilated(np.concatenate([part, known[..., None]], axis=-1), texel)
            for part in (result[..., :3], result[..., 3:])
        ]
        result, known = result.copy(), known.copy()
        result[rows, columns] = np.hstack([new[:, :3] for new in passes])
        known[rows, columns] = passes[0][:, 3] > 0.0
    return result
