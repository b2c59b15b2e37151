"""A full-screen pass that evaluates one power method at every pixel, many times over."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from playground.measure.power_methods import TO_EYE, TO_LIGHT, Method
from playground.render.gl.context import headless, rest
from playground.render.gl.source import assemble

VERTEX = """#version 330 core
void main() {
    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
"""
# The normal moves a little from one evaluation to the next, so that none can be left out.
FRAGMENT = """
uniform sampler2D table;
uniform vec3 to_light, to_eye;
uniform float side;
uniform int evaluations;
out vec4 sum;
float method(vec3 n, vec3 l, vec3 v) {
    BODY
}
void main() {
    vec2 place = 2.0 * gl_FragCoord.xy / side - 1.0;
    float total = 0.0;
    for (int i = 0; i < evaluations; ++i)
        total += method(normalize(vec3(place.x + 1e-3 * float(i), place.y, 1.0)), to_light, to_eye);
    sum = vec4(total);
}
"""


class PowerPass:
    """Square pictures of ``side`` pixels in float32, row 0 at y = −1."""

    def __init__(self, method: Method, side: int) -> None:
        self.side = side
        self._context = context = headless()
        source = assemble("lib/phong.glsl", tail=FRAGMENT.replace("BODY", method.glsl))
        self._program = context.program(vertex_shader=VERTEX, fragment_shader=source.text)
        values = {"to_light": TO_LIGHT, "to_eye": TO_EYE, "side": np.array(float(side))}
        for name, value in values.items():
            if name in self._program:
                self._program[name].write(value.astype("f4").tobytes())  # type: ignore[union-attr]
        table = method.table if method.table is not None else np.zeros((1, 1), np.float32)
        self._table = context.texture((table.shape[1], 1), 1, table.tobytes(), dtype="f4")
        self._table.repeat_x = False
        self._array = context.vertex_array(self._program, [])
        self._colour = context.renderbuffer((side, side), 1, dtype="f4")
        self._target = context.framebuffer([self._colour])

    def run(self, evaluations: int) -> None:
        """Evaluate so many times at every pixel, and wait for the end."""
        import moderngl

        self._program["evaluations"].value = evaluations  # type: ignore[union-attr]
        self._table.use(0)
        self._target.use()
        self._context.enable_only(moderngl.NOTHING)
        self._array.render(moderngl.TRIANGLES, vertices=3)
        self._target.read((0, 0, 1, 1), components=1, dtype="f4")

    def values(self) -> NDArray[np.float32]:
        """One evaluation at every pixel, (side, side)."""
        self.run(1)
        data = self._target.read(components=1, dtype="f4")
        return np.frombuffer(data, np.float32).reshape(self.side, self.side)

    def close(self) -> None:
        """Free the GPU memory."""
        rest(self._context)
        for item in (self._target, self._colour, self._array, self._table, self._program):
            item.release()
