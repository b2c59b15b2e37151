"""A full-screen pass in which every pixel is a point of a floor under a shining square.

The GLSL of the closed forms against the same sums over samples as in `area_samples`.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from playground.measure.area_samples import CORNERS, EYE, FLOOR
from playground.measure.power_pass import VERTEX
from playground.render.gl.context import headless, rest
from playground.render.gl.source import assemble

CLOSED = {
    "diffuse": "form_factor(p, UP, corners, false)",
    "highlight": "lobe_integral(p, axis, corners, shininess, false)",
}
INTEGRAND = {
    "diffuse": "0.318309886 * max(dot(to_light, UP), 0.0)",
    "highlight": "power_below_one(dot(to_light, axis), 1.0 - dot(to_light, axis), shininess)",
}
# The point moves a little from one evaluation to the next, so that none can be left out.
# The random numbers: pcg2d (Jarzynski & Olano, Hash Functions for GPU Rendering, JCGT 9(3), 2020).
FRAGMENT = """
uniform vec3 corners[4], eye;
uniform vec2 size;
uniform float shininess, extent;
uniform int evaluations, count, seed;
out vec4 sum;
const vec3 UP = vec3(0.0, 1.0, 0.0);
uvec2 pcg2d(uvec2 v) {
    v = v * 1664525u + 1013904223u;
    v += v.yx * 1664525u;
    v ^= v >> 16u;
    v += v.yx * 1664525u;
    return v ^ (v >> 16u);
}
float sampled(vec3 p, vec3 axis) {
    int side = int(sqrt(float(count)) + 0.5);
    uint point = uint(gl_FragCoord.x) + 65536u * uint(gl_FragCoord.y);
    vec3 across = corners[1] - corners[0], along = corners[3] - corners[0];
    float total = 0.0;
    for (int i = 0; i < count; ++i) {
        vec2 place = vec2(pcg2d(uvec2(uint(i) + 65536u * uint(seed), point)) >> 8u) / 16777216.0;
        if (STRATIFIED) place = (vec2(i / side, i - i / side * side) + place) / float(side);
        vec3 offset = corners[0] + place.x * across + place.y * along - p;
        float squared = dot(offset, offset);
        vec3 to_light = offset * inversesqrt(squared);
        total += INTEGRAND * dot(to_light, UP) / squared;
    }
    return total / float(count);
}
void main() {
    vec2 place = extent * (gl_FragCoord.xy / size - 0.5);
    float total = 0.0;
    for (int i = 0; i < evaluations; ++i) {
        vec3 p = vec3(place.x + 1e-3 * float(i), 0.0, place.y);
        vec3 axis = reflection(UP, normalize(eye - p));
        total += VALUE;
    }
    sum = vec4(total);
}
"""


class AreaPass:
    """Pictures (H, W) of what reaches the floor, in float32.

    ``integral`` is "diffuse" or "highlight"; ``method`` "closed", "uniform" or "stratified".
    """

    def __init__(
        self, integral: str, method: str, count: int, shininess: float, size: tuple[int, int]
    ) -> None:
        self.size = size
        value = CLOSED[integral] if method == "closed" else "sampled(p, axis)"
        tail = FRAGMENT.replace("VALUE", value).replace("INTEGRAND", INTEGRAND[integral])
        tail = tail.replace("STRATIFIED", str(method == "stratified").lower())
        self._context = context = headless()
        source = assemble("lib/area_light.glsl", tail=tail, first=("lib/vector.glsl",))
        self._program = context.program(vertex_shader=VERTEX, fragment_shader=source.text)
        for name, numbers in {
            "corners": CORNERS, "eye": EYE, "size": size, "shininess": shininess, "extent": FLOOR,
        }.items():  # fmt: skip
            self._set(name, np.asarray(numbers, np.float32))
        self._set("count", np.int32(count))
        self._array = context.vertex_array(self._program, [])
        self._colour = context.renderbuffer(size, 1, dtype="f4")
        self._target = context.framebuffer([self._colour])

    def run(self, evaluations: int, seed: int = 0) -> None:
        """Evaluate so many times at every pixel, and wait for the end."""
        import moderngl

        self._set("evaluations", np.int32(evaluations))
        self._set("seed", np.int32(seed))
        self._target.use()
        self._context.enable_only(moderngl.NOTHING)
        self._array.render(moderngl.TRIANGLES, vertices=3)
        self._target.read((0, 0, 1, 1), components=1, dtype="f4")

    def values(self, seed: int = 0) -> NDArray[np.float32]:
        """One evaluation at every point, (H, W); other samples for every seed."""
        self.run(1, seed)
        data = self._target.read(components=1, dtype="f4")
        return np.frombuffer(data, np.float32).reshape(self.size[::-1])

    def _set(self, name: str, numbers: NDArray[np.float32] | np.int32) -> None:
        if name in self._program:  # the compiler drops what this method does not need
            self._program[name].write(numbers.tobytes())  # type: ignore[union-attr]

    def close(self) -> None:
        """Free the GPU memory."""
        rest(self._context)
        for item in (self._target, self._colour, self._array, self._program):
            item.release()
