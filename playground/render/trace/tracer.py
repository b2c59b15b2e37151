"""The ray tracer in NumPy, float64: the reference for the GPU, and the fallback without one."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from playground.errors import PlaygroundError
from playground.render.checks import check_out, check_setup
from playground.render.image import Image, LeftOut
from playground.render.numpy_renderer import sample_offsets
from playground.render.trace import walk
from playground.render.trace.solids import Walker
from playground.render.trace.traced_scene import TracedScene, prepare
from playground.render.trace.warn import warnings_of
from playground.render.trace.whitted import BATCH, primary, waves
from playground.scene.setup import Setup
from playground.shading.floats import Array


class NumpyTracer:
    """Traces pictures of one size. ``left_out`` and ``warnings`` tell of the last one."""

    name = "numpy"
    walker: Walker = walk

    def __init__(self, size: tuple[int, int]) -> None:
        self.size = size
        self.left_out: LeftOut | None = None
        self.warnings: tuple[str, ...] = ()

    def render(self, setup: Setup, out: NDArray[Any] | None = None) -> Image | NDArray[Any]:
        """Trace ``setup``; see `playground.render.renderer.Renderer.render`."""
        check_setup(setup)
        if out is not None:
            check_out(out, self.size)
        tracing = Tracing(setup, self.size, self.walker)
        for _ in tracing.steps():
            pass
        image = tracing.image()
        self.left_out, self.warnings = image.left_out, image.warnings
        return image if out is None else image.into(out)

    def samples(self, setup: Setup) -> int:
        """As many samples per pixel as ``setup`` asks for."""
        return setup.settings.samples

    def close(self) -> None:
        """Nothing is held."""

    def __enter__(self) -> NumpyTracer:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()


class EmbreeTracer(NumpyTracer):
    """The same, but rays go through meshes with Embree; see `playground.render.trace.embree`."""

    name = "embree"

    def __init__(self, size: tuple[int, int]) -> None:
        from playground.render.trace import embree

        embree.check_embree()
        self.walker = embree
        super().__init__(size)


class Tracing:
    """One picture while it is made: can be looked at, and dropped, after every step."""

    def __init__(self, setup: Setup, size: tuple[int, int], walker: Walker = walk) -> None:
        if setup.settings.bugs:
            raise PlaygroundError(
                "the ray tracer makes no mistakes",
                got=f"bugs = {', '.join(setup.settings.bugs)}",
                fix="Use --method raster, or --set bugs= for none.",
            )
        self.scene: TracedScene = prepare(setup, size, walker)
        self.name = NumpyTracer.name if walker is walk else EmbreeTracer.name
        self.warnings = warnings_of(self.scene)
        pixels = size[0] * size[1]
        self._colour, self._lost = np.zeros((pixels, 3)), np.zeros((pixels, 3))
        self._covered, self._traced = np.zeros(pixels), np.zeros(pixels)

    def steps(self) -> Iterator[float]:
        """Trace wave after wave; yields the share of the pixels' samples done, 1 at the end.

        The first sample of every pixel comes before the second of any.
        """
        pixels = len(self._traced)
        offsets = sample_offsets(self.scene.settings.samples)
        for i, offset in enumerate(offsets):
            for start in range(0, pixels, BATCH):
                end = min(start + BATCH, pixels)
                for _ in self._trace(slice(start, end), offset):
                    yield (i + start / pixels) / len(offsets)
            yield (i + 1) / len(offsets)

    def _trace(self, chosen: slice, offset: tuple[float, float]) -> Iterator[None]:
        """Add one sample of each of some neighbouring pixels, bounce after bounce."""
        pixel = np.arange(chosen.start, chosen.stop)
        origin, direction, limit = self.scene.camera_rays(pixel, offset)
        rays = primary(self.scene, origin, direction, pixel - chosen.start)
        self._traced[chosen] += 1.0
        for wave in waves(self.scene, rays, limit):
            _add(self._colour[chosen], wave.rays.pixel, wave.added)
            _add(self._lost[chosen], wave.rays.pixel, wave.lost)
            if wave.depth == 0:
                self._covered[pixel[wave.hit]] += 1.0
            yield

    def image(self) -> Image:
        """The picture as far as it is traced; black where nothing is yet."""
        width, height = self.scene.size
        count = np.maximum(self._traced, 1.0)[:, None]

        def picture(values: Array) -> NDArray[np.float32]:
            return (values / count).astype(np.float32).reshape(height, width, -1)

        return Image(
            picture(self._colour),
            picture(self._covered[:, None])[..., 0],
            self.scene.setup,
            self.name,
            left_out=LeftOut(picture(self._lost)),
            warnings=self.warnings,
        )


def _add(sums: Array, pixel: NDArray[np.intp], values: Array) -> None:
    """Add values (N, 3) to the sums (P, 3) of their pixels, of which several may be the same."""
    if values.any():
        for channel in range(3):
            sums[:, channel] += np.bincount(pixel, values[:, channel], len(sums))
