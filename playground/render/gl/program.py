"""Shader programs, specialised to what is needed and compiled once each."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from playground.render.gl.source import Source, assemble
from playground.render.needs import Needs

if TYPE_CHECKING:
    import moderngl

STAGES = {
    "per-fragment": ("phong.vert", "phong.frag"),
    "per-vertex": ("gouraud.vert", "colour.frag"),
    "flat": ("flat.vert", "colour.frag"),
}
INTERPOLATION = {"per-fragment": "smooth", "per-vertex": "smooth", "flat": "flat"}


class ShaderError(RuntimeError):
    """A shader of ours does not compile; the message names file and line."""


class Program:
    """A compiled program and its uniforms; a uniform the program dropped is ignored."""

    def __init__(self, context: moderngl.Context, sources: tuple[Source, Source]) -> None:
        import moderngl

        vertex, fragment = sources
        try:
            self.gl = context.program(vertex_shader=vertex.text, fragment_shader=fragment.text)
        except moderngl.Error as error:
            raise ShaderError(explain(str(error), sources)) from None
        self.attributes = {
            name for name in self.gl if isinstance(self.gl[name], moderngl.Attribute)
        }
        members = {name: self.gl[name] for name in self.gl}
        self._uniforms = {n: m for n, m in members.items() if isinstance(m, moderngl.Uniform)}

    def write(self, name: str, value: Any) -> None:
        """Upload ``value`` as float32; matrices are given as NumPy writes them, row by row."""
        uniform = self._uniforms.get(name)
        if uniform is not None:
            array = np.asarray(value, dtype=np.float32)
            if getattr(uniform, "matrix", False):  # missing from the stubs
                array = array.swapaxes(-1, -2)
            uniform.write(array.tobytes()[: 4 * uniform.dimension * uniform.array_length])

    def write_integer(self, name: str, value: int) -> None:
        """Set an integer or sampler."""
        if name in self._uniforms:
            self._uniforms[name].value = value


def sources_for(needs: Needs) -> tuple[Source, Source]:
    """The two stages for exactly these needs."""
    defines: dict[str, object] = {**needs.defines, "INTERPOLATION": INTERPOLATION[needs.shading]}
    vertex, fragment = STAGES[needs.shading]
    return assemble(vertex, defines), assemble(fragment, defines)


def explain(log: str, sources: tuple[Source, ...]) -> str:
    """A driver's log, each stage's part told in files and lines of ``shaders/``."""
    marks = ("vertex_shader", "fragment_shader")
    for mark, source in zip(marks, sources, strict=False):
        if mark in log:
            return source.explain(log.split(mark, 1)[1])
    return "\n".join(source.explain(log) for source in sources[:1])
