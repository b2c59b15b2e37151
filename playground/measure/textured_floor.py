"""The floor of a lightmapped frame: the shortest program that draws unlit textured meshes.

One vertex array, one texture, one lookup per pixel with the texture unit's own filter, read into
an array. A lightmapped frame is measured against it.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from pyrr import matrix44

from playground.render.gl.context import headless, rest
from playground.scene.camera import Camera
from playground.shading.floats import Array

if TYPE_CHECKING:
    import moderngl

VERTEX = """#version 330
uniform mat4 clip; in vec3 position; in vec2 place; out vec2 at;
void main() { at = place; gl_Position = clip * vec4(position, 1.0); }
"""
FRAGMENT = """#version 330
uniform sampler2D texels; in vec2 at; out vec4 colour;
void main() { colour = vec4(texture(texels, at).rgb, 1.0); }
"""


class TexturedFloor:
    """Draws meshes with one texture.

    Parameters
    ----------
    size : (int, int)
        Width and height of the picture.
    meshes : sequence of (positions (V, 3), faces (F, 3), texcoords (V, 2))
        In the world.
    texels : (H, W, 3) float32
    """

    def __init__(
        self,
        size: tuple[int, int],
        meshes: Sequence[tuple[Array, NDArray[np.int32], NDArray[np.float32]]],
        texels: NDArray[np.float32],
        context: moderngl.Context | None = None,
    ) -> None:
        self.context = context = context or headless()
        self.program = context.program(vertex_shader=VERTEX, fragment_shader=FRAGMENT)
        table = np.concatenate([np.hstack([p, uv]) for p, _, uv in meshes]).astype(np.float32)
        starts = np.cumsum([0, *(len(p) for p, _, _ in meshes)])
        faces = [f + start for (_, f, _), start in zip(meshes, starts, strict=False)]
        self.vertices = context.buffer(table.tobytes())
        self.indices = context.buffer(np.concatenate(faces).astype(np.uint32).tobytes())
        layout = [(self.vertices, "3f 2f", "position", "place")]
        self.array = context.vertex_array(self.program, layout, self.indices)
        height, width, _ = texels.shape
        data = np.ascontiguousarray(texels, dtype=np.float32).tobytes()
        self.texture = context.texture((width, height), 3, data, dtype="f4")
        self.colour = context.renderbuffer(size, 4)
        self.depth = context.depth_renderbuffer(size)
        self.target = context.framebuffer([self.colour], self.depth)
        self.codes: NDArray[np.uint8] = np.empty((size[1], size[0], 4), np.uint8)

    def frame(self, camera: Camera, near: float, far: float) -> NDArray[np.uint8]:
        """Draw what a camera sees and read it, bottom row first."""
        import moderngl

        height, width, _ = self.codes.shape
        view = matrix44.create_look_at(
            *(np.array(x) for x in (camera.eye, camera.target, camera.up))
        )
        lens = matrix44.create_perspective_projection(camera.fov, width / height, near, far)
        self.program["clip"].write((view @ lens).astype("f4").tobytes())  # type: ignore[union-attr]
        self.context.enable_only(moderngl.DEPTH_TEST)  # open meshes have backs to be seen
        self.texture.use(0)
        self.target.use()
        self.target.clear(0.0, 0.0, 0.0, 1.0)
        self.array.render()
        self.target.read_into(self.codes, components=4, alignment=1)
        return self.codes

    def close(self) -> None:
        """Free the GPU memory."""
        rest(self.context)
        parts = (self.target, self.colour, self.depth, self.texture, self.array)
        for part in (*parts, self.vertices, self.indices, self.program):
            part.release()
