"""The program for one traced scene: assembled, its numbers built in once they stay."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from playground.render.gl.program import Program
from playground.render.gl.source import Source, assemble, bake

if TYPE_CHECKING:
    import moderngl


def sources_of(
    symbols: Mapping[str, object], constants: Mapping[str, Any] | None = None
) -> tuple[Source, Source]:
    """The two stages for these symbols; ``constants`` are uniforms that became literals."""
    symbols = dict(symbols)
    shininess = {float(row[0]) for row in (constants or {}).get("material_shininess", ())}
    if len(shininess) == 1 and shininess <= set(range(1, 33)):
        symbols["WHOLE_EXPONENT"] = int(shininess.pop())
    fragment = assemble("trace/whitted.frag", symbols)
    return assemble("trace/whitted.vert"), bake(fragment, _named(constants or {}, symbols))


def _named(constants: Mapping[str, Any], symbols: Mapping[str, object]) -> dict[str, Any]:
    """Constants in the shape their declarations have: single numbers in rows of one."""
    grey = ("material_reflectance", "material_transmittance")
    return {
        name: np.asarray(value)[..., :1] if symbols["GREY"] and name in grey else value
        for name, value in constants.items()
        if not (name.startswith("mesh_") and symbols.get("MESHES", 0) not in (0, 1))
    }


class TraceProgram:
    """A compiled program and the one triangle that runs it."""

    def __init__(
        self,
        context: moderngl.Context,
        symbols: Mapping[str, object],
        constants: Mapping[str, Any] | None = None,
    ) -> None:
        self._program = Program(context, sources_of(symbols, constants))
        self._array = context.vertex_array(self._program.gl, [])
        self._grey = bool(symbols["GREY"])

    def write(self, values: Mapping[str, Any]) -> None:
        """Upload values; what the program does not use is skipped."""
        whole = {n: v for n, v in values.items() if getattr(v, "dtype", None) == np.uint32}
        numbers = {name: value for name, value in values.items() if name not in whole}
        self._program.write(_named(numbers, {"GREY": self._grey}))
        for name, value in whole.items():
            if name in self._program.gl:
                member: Any = self._program.gl[name]
                member.write(value[: member.array_length].tobytes())

    def write_units(self, units: Mapping[str, Sequence[int]]) -> None:
        """Tell samplers their texture units; an array has one for each element."""
        for name, numbers in units.items():
            if name in self._program.gl:
                member: Any = self._program.gl[name]
                member.write(np.array(numbers[: member.array_length], dtype=np.int32).tobytes())

    def draw(self) -> None:
        """Trace every pixel of the framebuffer that is bound."""
        self._array.render(vertices=3)

    def release(self) -> None:
        """Free the GPU memory."""
        self._array.release()
        self._program.release()
