"""Shader programs, specialised to what is needed and compiled once each."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from playground.errors import PlaygroundError
from playground.render.gl.source import Source, assemble, bake
from playground.render.needs import Needs
from playground.shading.light import BRIGHTEST

if TYPE_CHECKING:
    import moderngl

    from playground.render.gl.mesh_buffers import MeshBuffers

STAGES = {
    "per-fragment": ("phong.vert", "phong.frag"),
    "per-vertex": ("gouraud.vert", "colour.frag"),
    "flat": ("flat.vert", "colour.frag"),
}
STORED = ("stored.vert", "stored.frag")  # for every shading
SAMPLERS = {"lightmap_texels": 1}  # texture units; those not named here are 0
LARGEST_WHOLE = 32  # exponents up to here are cheaper by squaring, and off by 2e-6 at most
BRIGHTEST_IN = {"float16": "65504.0", "float64": f"{BRIGHTEST}lf"}
INTERPOLATION = {"per-fragment": "smooth", "per-vertex": "smooth", "flat": "flat"}


class ShaderError(RuntimeError):
    """A shader of ours does not compile; the message names file and line."""


class Program:
    """A compiled program: its uniforms, and the vertex arrays made for it."""

    def __init__(self, context: moderngl.Context, sources: tuple[Source, Source]) -> None:
        import moderngl

        vertex, fragment = sources
        try:
            self.gl = context.program(vertex_shader=vertex.text, fragment_shader=fragment.text)
        except moderngl.Error as error:
            raise ShaderError(explain(str(error), sources)) from None
        members = {name: self.gl[name] for name in self.gl}
        self.attributes = {n for n, m in members.items() if isinstance(m, moderngl.Attribute)}
        self._uniforms = {n: m for n, m in members.items() if isinstance(m, moderngl.Uniform)}
        self._arrays: dict[int, tuple[MeshBuffers, moderngl.VertexArray]] = {}
        for name in SAMPLERS.keys() & self._uniforms.keys():
            self._uniforms[name].value = SAMPLERS[name]

    def write(self, values: Mapping[str, Any]) -> None:
        """Upload values as the program's numbers, matrices as NumPy writes them, row by row.

        What the program does not use is skipped.
        """
        for name, value in values.items():
            uniform = self._uniforms.get(name)
            if uniform is not None:
                double = str(getattr(uniform, "fmt", "")).endswith("d")  # missing from the stubs
                array = np.asarray(value, dtype=np.float64 if double else np.float32)
                if getattr(uniform, "matrix", False):
                    array = array.T
                elif array.ndim == 2:  # drivers drop elements at the end that count for nothing
                    array = array[: uniform.array_length]
                uniform.write(array.tobytes())

    def array(self, buffers: MeshBuffers) -> moderngl.VertexArray:
        """The vertex array that feeds ``buffers`` to this program."""
        if id(buffers) not in self._arrays:
            self._arrays[id(buffers)] = buffers, buffers.array(self)
        return self._arrays[id(buffers)][1]

    def forget(self, buffers: MeshBuffers) -> None:
        """Drop the vertex array of ``buffers``, which are about to be released."""
        held = self._arrays.pop(id(buffers), None)
        if held is not None:
            held[1].release()

    def release(self) -> None:
        """Free the GPU memory."""
        for _, array in self._arrays.values():
            array.release()
        self.gl.release()


def check_precision(context: moderngl.Context, needs: Needs) -> None:
    """Raise an error if the driver does not compute in this precision."""
    if needs.precision != "float64":
        return
    if context.version_code < 410:
        raise PlaygroundError(
            "this driver has no float64 arithmetic",
            got=f"OpenGL {context.version_code / 100:.1f}",
            allowed="OpenGL 4.1 or newer",
            fix="Use --renderer numpy, or precision float32.",
        )


def check_lights(context: moderngl.Context, needs: Needs) -> None:
    """Raise an error if the lights do not fit into the uniforms that the driver offers.

    A directional light takes three vectors of ``interface/lights.glsl``, a point light
    four, a spot light six, an area light three and its corners; sixteen are left for
    everything else.
    """
    names = ("GL_MAX_FRAGMENT_UNIFORM_COMPONENTS", "GL_MAX_VERTEX_UNIFORM_COMPONENTS")
    room = min(int(context.info[name]) for name in names) // 4 - 16
    taken = 3 * needs.directional_lights + 4 * needs.point_lights + 6 * needs.spot_lights
    taken += (3 + needs.area_corners) * needs.area_lights
    taken *= 2 if needs.precision == "float64" else 1
    if taken > room:
        count = needs.directional_lights + needs.point_lights + needs.spot_lights
        count += needs.area_lights
        raise PlaygroundError(
            "too many lights for this driver",
            got=f"{count} lights",
            allowed=f"{room // 3} directional, {room // 4} point, {room // 6} spot or "
            f"{room // 7} rectangle lights",
            fix="Use --renderer numpy, which takes any number.",
        )


def stages(needs: Needs) -> tuple[str, str]:
    """The files of the vertex and the fragment stage."""
    return STORED if needs.stored else STAGES[needs.shading]


def sources_for(
    needs: Needs,
    constants: Mapping[str, Any] | None = None,
    overrides: Mapping[str, str] | None = None,
) -> tuple[Source, Source]:
    """The two stages for exactly these needs; ``constants`` are uniforms that became literals.

    ``overrides`` are texts that take the place of shader files, by the files' names.
    """
    defines: dict[str, object] = {**needs.defines, "BRIGHTEST": BRIGHTEST}
    defines["INTERPOLATION"] = INTERPOLATION[needs.shading]
    if needs.stored:
        defines["PER_FRAGMENT"] = needs.shading == "per-fragment"
        defines["FLAT"] = needs.shading == "flat"
    if needs.marks:
        kind = np.float16 if needs.precision == "float16" else np.float32
        defines["SMALLEST_NORMAL"] = f"{np.finfo(kind).tiny:.8e}"
    if needs.precision != "native":
        vertex, fragment = _in_precision(needs, defines, overrides or {})
        return bake(vertex, constants or {}), bake(fragment, constants or {})
    if constants and float(constants["shininess"]) in range(1, LARGEST_WHOLE + 1):
        defines["WHOLE_EXPONENT"] = int(constants["shininess"])
    vertex, fragment = (
        assemble(stage, defines, bugs=needs.bugs, overrides=overrides) for stage in stages(needs)
    )
    return bake(vertex, constants or {}), bake(fragment, constants or {})


def _in_precision(
    needs: Needs, defines: dict[str, object], overrides: Mapping[str, str]
) -> tuple[Source, Source]:
    from playground.render.gl.other_precision import in_precision, libraries

    defines["BRIGHTEST"] = BRIGHTEST_IN[needs.precision]
    first = libraries(needs.precision, needs.area_lights > 0)
    made = []
    for stage in stages(needs):
        if stage == "phong.vert":  # hands positions and normals on, and shades nothing
            made.append(assemble(stage, defines, bugs=needs.bugs, overrides=overrides))
            continue
        source = assemble(stage, defines, "", needs.bugs, overrides, first)
        made.append(in_precision(source, needs.precision, overrides))
    return made[0], made[1]


def explain(log: str, sources: tuple[Source, ...]) -> str:
    """A driver's log, each stage's part told in files and lines of ``shaders/``."""
    for mark, source in zip(("vertex_shader", "fragment_shader"), sources, strict=True):
        if mark in log:
            return source.explain(log.split(mark, 1)[1])
    return log.strip()
