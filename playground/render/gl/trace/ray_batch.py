"""Given rays against one mesh on the GPU: the walk by itself, to be tested and measured.

Same questions as `playground.render.trace.walk`, answered in float32 by
shaders/trace/bvh.glsl.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from playground.render.gl.context import rest
from playground.render.gl.program import Program
from playground.render.gl.source import assemble
from playground.render.gl.trace.bvh_texels import bvh_texels
from playground.render.trace.bvh import Bvh

if TYPE_CHECKING:
    import moderngl

WIDTH = 640  # of the picture whose pixels are the rays
FAR = 1e30  # stands for an infinite limit
KINDS = {np.dtype(np.float32): "f4", np.dtype(np.uint32): "u4"}


class RayBatch:
    """N rays, the tree of a mesh and a program, all uploaded; `run` sends the rays.

    Parameters
    ----------
    origin, direction : (N, 3) arrays
    limit : (N,) array or a number
        Only hits with 0 < t < limit count.
    any_hit : bool
        Ask only whether each ray is blocked.
    """

    def __init__(
        self,
        context: moderngl.Context,
        bvh: Bvh,
        origin: ArrayLike,
        direction: ArrayLike,
        limit: ArrayLike = np.inf,
        *,
        any_hit: bool = False,
    ) -> None:
        self._context, self._bvh = context, bvh
        texels = bvh_texels([bvh])
        symbols: dict[str, object] = dict(texels.defines)
        if any_hit:
            symbols["ANY_HIT"] = 1
        sources = assemble("trace/screen.vert"), assemble("trace/rays.frag", symbols)
        self._program = Program(context, sources)
        self._array = context.vertex_array(self._program.gl, [])
        self._size, rays = len(np.asarray(origin)), _pictures(origin, direction, limit)
        self._textures = [self._texture(x) for x in (texels.nodes, texels.corners, *rays)]
        names = ("bvh_nodes", "bvh_corners", "ray_origins", "ray_directions")
        self._unit = {name: unit for unit, name in enumerate(names)}
        tree = texels.trees[0]
        self._program.write({"bvh_low": tree.low, "bvh_cell": tree.cell})
        for name, value in {**self._unit, "bvh_root": tree.root}.items():
            if name in self._program.gl:
                member: Any = self._program.gl[name]
                member.value = value
        shape = (WIDTH, len(rays[0]))
        hits = context.texture(shape, 4, dtype="f4"), context.texture(shape, 1, dtype="i4")
        self._target = context.framebuffer(hits)

    def _texture(self, texels: NDArray[Any]) -> moderngl.Texture:
        height, width, _ = texels.shape
        data = np.ascontiguousarray(texels).tobytes()
        texture = self._context.texture((width, height), 4, data, dtype=KINDS[texels.dtype])
        texture.filter = (self._context.NEAREST, self._context.NEAREST)
        return texture

    def run(self) -> None:
        """Send all rays, and wait until the last one is done."""
        for unit, texture in enumerate(self._textures):
            texture.use(unit)
        self._target.use()
        self._context.enable_only(self._context.NOTHING)  # whatever was drawn before
        self._array.render(vertices=3)
        self._context.finish()

    def hits(self) -> tuple[NDArray[np.float32], NDArray[np.int64], NDArray[np.float32]]:
        """What `walk.closest` gives: t (N,), triangle (N,), weights (N, 3).

        Of an ``any_hit`` batch only whether the triangle is −1 means something.
        """
        found, slot = (
            np.frombuffer(self._target.read(components=n, attachment=k, dtype=kind), kind)
            for k, (n, kind) in enumerate(((4, "f4"), (1, "i4")))
        )
        found = found.reshape(-1, 4)[: self._size]
        number = np.append(self._bvh.order, -1)[slot[: self._size]].astype(np.int64)
        return found[:, 0], number, found[:, 1:]

    def release(self) -> None:
        """Free the GPU memory."""
        rest(self._context)
        for held in (*self._target.color_attachments, self._target, *self._textures, self._array):
            held.release()
        self._program.release()


def _pictures(
    origin: ArrayLike, direction: ArrayLike, limit: ArrayLike
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Origins, and directions with the limit, as pictures (H, WIDTH, 4); the rest reach nowhere."""
    start = np.asarray(origin, dtype=np.float32)
    rows = max(-(-len(start) // WIDTH), 1)
    origins = np.zeros((rows * WIDTH, 4), dtype=np.float32)
    directions = np.tile(np.array([0.0, 0.0, 1.0, 0.0], dtype=np.float32), (rows * WIDTH, 1))
    origins[: len(start), :3] = start
    directions[: len(start), :3] = direction
    directions[: len(start), 3] = np.minimum(np.asarray(limit, dtype=np.float64), FAR)
    return origins.reshape(rows, WIDTH, 4), directions.reshape(rows, WIDTH, 4)
