"""The floor of ray tracing: one room in one shader, written by hand for exactly this room.

Walls, spheres, lamp and materials are numbers in its source; a fixed epsilon keeps rays off their
own surface; there is nothing that this room does not need. `room_setup` is the same room for
everybody else: a mirror and a glass sphere, one point light, shadows that glass casts too.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from playground.render.gl.context import headless, rest
from playground.scene.camera import Camera
from playground.scene.light import PointLight
from playground.scene.material import Material
from playground.scene.scene import Object, Scene
from playground.scene.settings import Settings
from playground.scene.setup import Setup
from playground.scene.transform import Transform

if TYPE_CHECKING:
    import moderngl

Triple = tuple[float, float, float]

SIZE = (640, 480)
DEPTH = 5
FOV = 40.0
BLACK = (0.0, 0.0, 0.0)
WHITE, RED, GREEN = (0.73, 0.71, 0.68), (0.63, 0.06, 0.05), (0.14, 0.45, 0.09)
AMBIENT = (0.08, 0.08, 0.08)
LAMP = (0.0, 0.9, 0.0)

VERTEX = """#version 330
void main() {
    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
"""
FRAGMENT = """#version 330
uniform vec3 eye; uniform vec2 size; out vec4 colour;
const vec4 MIRROR = vec4(-0.45, -0.6, -0.4, 0.4), GLASS = vec4(0.45, -0.6, 0.3, 0.4);
const vec3 LAMP = vec3(0.0, 0.9, 0.0);
float ball(vec4 s, vec3 o, vec3 d) {
    vec3 q = o - s.xyz;
    float b = dot(q, d), D = b * b - dot(q, q) + s.w * s.w;
    if (D < 0.0) return 1e30;
    D = sqrt(D);
    return -b - D > 1e-3 ? -b - D : -b + D > 1e-3 ? -b + D : 1e30;
}
float walls(vec3 o, vec3 d, out vec3 n) {
    float t = 1e30, a = (sign(d.x) - o.x) / d.x;
    n = vec3(0.0);
    vec3 p = o + a * d;
    if (a > 1e-3 && abs(p.y) <= 1.0 && abs(p.z) <= 1.0) { t = a; n = vec3(-sign(d.x), 0.0, 0.0); }
    a = (sign(d.y) - o.y) / d.y; p = o + a * d;
    if (a > 1e-3 && a < t && abs(p.x) <= 1.0 && abs(p.z) <= 1.0) { t = a; n = vec3(0.0, -sign(d.y), 0.0); }
    a = (-1.0 - o.z) / d.z; p = o + a * d;
    if (a > 1e-3 && a < t && abs(p.x) <= 1.0 && abs(p.y) <= 1.0) { t = a; n = vec3(0.0, 0.0, 1.0); }
    return t;
}
vec3 lit(vec3 p, vec3 n) {
    vec3 m = n.x > 0.5 ? vec3(0.63, 0.06, 0.05) : n.x < -0.5 ? vec3(0.14, 0.45, 0.09) : vec3(0.73, 0.71, 0.68);
    vec3 l = LAMP - p, start = p + 1e-3 * n;
    float d = length(l), c = max(dot(n, l / d), 0.0);
    if (c > 0.0 && (ball(MIRROR, start, l / d) < d || ball(GLASS, start, l / d) < d)) c = 0.0;
    return m * (0.08 + c);
}
vec3 trace(vec3 o, vec3 d) {
    vec3 sum = vec3(0.0), later_o[6], later_d[6];
    float later_w[6], w = 1.0;
    int later_depth[6], waiting = 0, depth = 0;
    while (true) {
        vec3 n;
        float t = walls(o, d, n), a = ball(MIRROR, o, d), b = ball(GLASS, o, d);
        bool goes_on = false;
        if (min(a, b) >= t) { if (t < 1e30) sum += w * lit(o + t * d, n); }
        else if (depth < 5) {
            goes_on = true;
            vec3 p = o + min(a, b) * d;
            if (a < b) { n = (p - MIRROR.xyz) / MIRROR.w; d = reflect(d, n); o = p + 1e-3 * n; w *= 0.9; }
            else {
                n = (p - GLASS.xyz) / GLASS.w;
                bool into = dot(d, n) < 0.0;
                n = into ? n : -n;
                float eta = into ? 1.0 / 1.5 : 1.5, c = -dot(d, n), k = 1.0 - eta * eta * (1.0 - c * c);
                vec3 r = reflect(d, n);
                if (k < 0.0) { o = p + 1e-3 * n; d = r; }
                else {
                    float ct = sqrt(k), s = (eta * c - ct) / (eta * c + ct), q = (c - eta * ct) / (c + eta * ct);
                    float F = 0.5 * (s * s + q * q);
                    later_o[waiting] = p + 1e-3 * n; later_d[waiting] = r;
                    later_w[waiting] = w * F; later_depth[waiting++] = depth + 1;
                    d = normalize(eta * d + (eta * c - ct) * n); o = p - 1e-3 * n; w *= 1.0 - F;
                }
            }
            ++depth;
        }
        if (!goes_on) {
            if (waiting == 0) break;
            --waiting;
            o = later_o[waiting]; d = later_d[waiting]; w = later_w[waiting]; depth = later_depth[waiting];
        }
    }
    return sum;
}
void main() {
    vec2 place = (2.0 * gl_FragCoord.xy / size - 1.0) * HALF * vec2(size.x / size.y, 1.0);
    colour = vec4(trace(eye, normalize(vec3(place, -1.0))), 1.0);
}
"""  # noqa: E501


def eye(step: int) -> tuple[float, float, float]:
    """A camera that sways; it looks straight ahead."""
    return (0.05 * float(np.sin(0.3 * step)), 0.0, 3.7)


def room_setup() -> Setup:
    """The room; every ray is followed down to `DEPTH`."""
    walls = (
        _wall(WHITE, (0.0, 0.0, -1.0), (90.0, 0.0, 0.0)),
        _wall(WHITE, (0.0, -1.0, 0.0), (0.0, 0.0, 0.0)),
        _wall(WHITE, (0.0, 1.0, 0.0), (180.0, 0.0, 0.0)),
        _wall(RED, (-1.0, 0.0, 0.0), (0.0, 0.0, -90.0)),
        _wall(GREEN, (1.0, 0.0, 0.0), (0.0, 0.0, 90.0)),
    )
    none = Material(diffuse=BLACK, ambient=BLACK, specular=BLACK)
    mirror = replace(none, reflectance=(0.9, 0.9, 0.9))
    glass = replace(none, transmittance=(1.0, 1.0, 1.0), index=1.5)
    balls = _ball(mirror, (-0.45, -0.6, -0.4)), _ball(glass, (0.45, -0.6, 0.3))
    lights = (PointLight(position=LAMP, ambient=AMBIENT),)
    settings = Settings(depth=DEPTH, threshold=0.0, clear_shadows=False)
    scene = Scene(background=BLACK, objects=(*walls, *balls), lights=lights)
    return swayed(Setup(scene, Camera(fov=FOV), settings, "analytic room"), 0)


def swayed(setup: Setup, step: int) -> Setup:
    """The room at one step of the camera."""
    place = eye(step)
    return setup.with_(eye=place, target=(place[0], 0.0, 0.0))


def _wall(colour: Triple, place: Triple, turned: Triple) -> Object:
    material = Material(diffuse=colour, ambient=colour, specular=BLACK)
    return Object("quad", material=material, transform=Transform(translate=place, rotate=turned))


def _ball(material: Material, place: Triple) -> Object:
    return Object("sphere", material=material, transform=Transform(translate=place, size=0.4))


class RoomFloor:
    """Draws the room; pictures of 8-bit RGBA or of floats, bottom row first."""

    def __init__(
        self,
        size: tuple[int, int] = SIZE,
        dtype: str = "f1",
        context: moderngl.Context | None = None,
    ) -> None:
        self._context = context = context or headless()
        half = f"{np.tan(np.radians(FOV / 2.0)):.9f}"
        source = FRAGMENT.replace("HALF", half)
        self._program = context.program(vertex_shader=VERTEX, fragment_shader=source)
        self._program["size"].value = size  # type: ignore[union-attr]
        self._array = context.vertex_array(self._program, [])
        self._colour = context.renderbuffer(size, 4, dtype=dtype)
        self._target = context.framebuffer([self._colour])
        kind = np.uint8 if dtype == "f1" else np.float32
        self._dtype, self.pixels = dtype, np.empty((size[1], size[0], 4), kind)

    def frame(self, step: int) -> NDArray[np.uint8] | NDArray[np.float32]:
        """Trace one step of the camera and read it, (H, W, 4), bottom row first."""
        import moderngl

        self._program["eye"].value = eye(step)  # type: ignore[union-attr]
        self._target.use()
        self._context.enable_only(moderngl.NOTHING)
        self._array.render(moderngl.TRIANGLES, vertices=3)
        self._target.read_into(self.pixels, components=4, alignment=1, dtype=self._dtype)
        return self.pixels

    def close(self) -> None:
        """Free the GPU memory."""
        rest(self._context)
        for item in (self._target, self._colour, self._array, self._program):
            item.release()
