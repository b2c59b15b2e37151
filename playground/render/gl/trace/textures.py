"""Images and lists of points that a traced scene looks up, as textures."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from playground.errors import PlaygroundError
from playground.render.gl.trace.program import TraceProgram
from playground.render.gl.trace.standing import Placed
from playground.render.gl.trace.trees import Trees
from playground.render.gl.trace.uniforms import area_points

if TYPE_CHECKING:
    import moderngl


class Textures:
    """The textures of the scene that was bound last."""

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self._images: dict[int, tuple[object, moderngl.Texture]] = {}
        self._others: dict[str, list[moderngl.Texture]] = {}
        self._placed: Placed | None = None
        self._trees: Trees | None = None

    def check(self, placed: Placed) -> None:
        """Raise `PlaygroundError` if a scene looks up more textures than a shader may."""
        images = sum(look.texels is not None for look in placed.layout.looks)
        others = (1 if "area" in placed.layout.lights else 0) + (3 if placed.trees else 0)
        most = int(self._context.info["GL_MAX_TEXTURE_IMAGE_UNITS"])
        if images + others > most:
            raise PlaygroundError(
                "too many textures for the ray tracer on the GPU",
                got=f"{images} materials with an image",
                allowed=f"up to {most - others} with this driver and scene",
                fix="Use fewer images, or --renderer numpy.",
            )

    def bind(self, placed: Placed, program: TraceProgram) -> None:
        """Make what the program looks up ready: images first."""
        if placed is not self._placed:
            self._load(placed)
        images = [id(look.texels) for look in placed.layout.looks if look.texels is not None]
        named = {"texels": [self._images[key][1] for key in images], **self._others}
        unit = 0
        for name, textures in named.items():
            program.write_units({name: range(unit, unit + len(textures))})
            for texture in textures:
                texture.use(unit)
                unit += 1

    def _load(self, placed: Placed) -> None:
        wanted = {id(look.texels): look.texels for look in placed.layout.looks}
        wanted = {key: texels for key, texels in wanted.items() if texels is not None}
        for key in [key for key in self._images if key not in wanted]:
            self._images.pop(key)[1].release()
        for key, texels in wanted.items():
            if key not in self._images:
                self._images[key] = texels, self._texture(np.asarray(texels, np.float32))
        points = area_points(placed.scene, placed.layout)
        if points is not None:
            self._put("area_points", self._texture(points.astype(np.float32)))
        trees = placed.trees
        if trees is not None and trees is not self._trees:
            self._put("bvh_nodes", self._texture(trees.texels.nodes))
            self._put("bvh_corners", self._texture(trees.corners))
            self._put("bvh_normals", self._texture(trees.normals))
        self._trees, self._placed = trees, placed

    def _put(self, name: str, texture: moderngl.Texture) -> None:
        for old in self._others.pop(name, []):
            old.release()
        self._others[name] = [texture]

    def _texture(self, numbers: NDArray[Any]) -> moderngl.Texture:
        size, parts = (numbers.shape[1], numbers.shape[0]), numbers.shape[2]
        largest = int(self._context.info["GL_MAX_TEXTURE_SIZE"])
        if max(size) > largest:
            raise PlaygroundError(
                "a texture is too large for this driver",
                got=f"{size[0]}x{size[1]}",
                allowed=f"up to {largest} texels a side",
                fix="Make the image smaller, or use --renderer numpy.",
            )
        kind = "u4" if numbers.dtype == np.uint32 else "f4"
        data = np.ascontiguousarray(numbers).tobytes()
        texture = self._context.texture(size, parts, data, dtype=kind)
        texture.filter = (self._context.NEAREST, self._context.NEAREST)
        return texture

    def release(self) -> None:
        """Free the GPU memory."""
        images = [texture for _, texture in self._images.values()]
        for texture in (*images, *(x for found in self._others.values() for x in found)):
            texture.release()
        self._images, self._others, self._placed, self._trees = {}, {}, None, None
