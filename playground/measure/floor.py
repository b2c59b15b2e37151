"""The floor: the shortest moderngl program that draws a Phong-lit mesh, written by hand.

What a frame costs without a scene, without features, without care: one vertex array, one
light, the textbook formula with the built-in pow, read into an array. Ours is measured
against it. ``python -m playground.measure.floor OUT.png`` draws one picture and ends: the
floor of a first image.
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from pyrr import matrix44

from playground.measure import frames_scene as scene
from playground.render.gl.context import headless
from playground.scene.mesh import Mesh

if TYPE_CHECKING:
    import moderngl

VERTEX = """#version 330
uniform mat4 clip; in vec3 position; in vec3 normal; out vec3 p; out vec3 n;
void main() { p = position; n = normal; gl_Position = clip * vec4(position, 1.0); }
"""
FRAGMENT = """#version 330
uniform vec3 eye, light, ambient, diffuse, specular; uniform float shininess;
in vec3 p; in vec3 n; out vec4 colour;
void main() {
    vec3 N = normalize(n), L = normalize(light - p), V = normalize(eye - p);
    float d = max(dot(N, L), 0.0);
    float s = d > 0.0 ? pow(max(dot(reflect(-L, N), V), 0.0), shininess) : 0.0;
    colour = vec4(ambient + diffuse * d + specular * s, 1.0);
}
"""


class Floor:
    """Draws the scene of `frames_scene` with a moving camera."""

    def __init__(
        self, mesh: Mesh, samples: int = 1, context: moderngl.Context | None = None
    ) -> None:
        self.context = context = context or headless()
        self.program = context.program(vertex_shader=VERTEX, fragment_shader=FRAGMENT)
        vertices = context.buffer(np.hstack([mesh.positions, mesh.normals]).astype("f4").tobytes())
        indices = context.buffer(mesh.faces.astype("u4").tobytes())
        self.array = context.vertex_array(
            self.program, [(vertices, "3f 3f", "position", "normal")], indices
        )
        self.resolved = self._framebuffer(0)
        self.target = self._framebuffer(samples) if samples > 1 else self.resolved
        values = {"light": scene.LIGHT, "ambient": scene.AMBIENT, "diffuse": scene.DIFFUSE}
        for name, value in {**values, "specular": scene.SPECULAR}.items():
            self._set(name, value)
        self._set("shininess", scene.SHININESS)
        width, height = scene.SIZE
        self.projection = matrix44.create_perspective_projection(
            scene.FOV, width / height, scene.NEAR, scene.FAR, dtype="f8"
        )
        self.codes: NDArray[np.uint8] = np.empty((height, width, 4), np.uint8)

    def _framebuffer(self, samples: int) -> moderngl.Framebuffer:
        colour = self.context.renderbuffer(scene.SIZE, 4, samples=samples)
        depth = self.context.depth_renderbuffer(scene.SIZE, samples=samples)
        return self.context.framebuffer([colour], depth)

    def _set(self, name: str, value: object) -> None:
        self.program[name].value = value  # type: ignore[union-attr]

    def frame(self, step: int) -> NDArray[np.uint8]:
        """Draw one step of the orbit and read it, (H, W, 4), bottom row first."""
        import moderngl

        eye = scene.eye(step)
        view = matrix44.create_look_at(np.array(eye), np.zeros(3), np.array([0.0, 1.0, 0.0]))
        self.program["clip"].write((view @ self.projection).astype("f4").tobytes())  # type: ignore[union-attr]
        self._set("eye", eye)
        self.context.front_face = "ccw"
        self.context.enable_only(moderngl.DEPTH_TEST | moderngl.CULL_FACE)
        self.target.use()
        self.target.clear(*scene.BACKGROUND, 1.0)
        self.array.render()
        if self.target is not self.resolved:
            self.context.copy_framebuffer(self.resolved, self.target)
        self.resolved.read_into(self.codes, components=4, alignment=1)
        return self.codes


def main() -> None:
    """Draw one picture of a thousand triangles into the PNG file that the arguments name."""
    from playground.render.image_file import png_bytes
    from playground.scene.shapes import make

    codes = Floor(make("icosphere", scene.TESSELLATION["1k"])).frame(0)
    with open(sys.argv[1], "wb") as file:
        file.write(png_bytes(codes[::-1, :, :3]))


if __name__ == "__main__":
    main()
