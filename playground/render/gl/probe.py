"""Runs a function of ``shaders/lib`` on the GPU for arrays of arguments.

What the parity tests and the case checker call: the very GLSL that the renderer uses,
in float32, through transform feedback; no pixels involved.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from playground import locate
from playground.render.gl.context import headless, rest
from playground.render.gl.program import ShaderError
from playground.render.gl.source import assemble

WIDTH = {"float": 1, "vec2": 2, "vec3": 3, "vec4": 4}
_SIGNATURE = re.compile(r"^(\w+)\s+(\w+)\(([^)]*)\)\s*\{", re.MULTILINE)


@dataclass(frozen=True)
class Signature:
    """A GLSL function: result type, name, and parameters as (qualifier, type, name)."""

    result: str
    name: str
    parameters: tuple[tuple[str, str, str], ...]


def signatures(library: str) -> dict[str, Signature]:
    """Every function of ``shaders/lib/LIBRARY.glsl``, by name."""
    found = {}
    text = locate.shader(f"lib/{library}.glsl").read_text(encoding="utf-8")
    for result, name, inside in _SIGNATURE.findall(text):
        parameters = []
        for part in filter(None, (p.strip() for p in inside.split(","))):
            *qualifier, kind, label = part.split()
            parameters.append((qualifier[0] if qualifier else "in", kind, label))
        found[name] = Signature(result, name, tuple(parameters))
    return found


def call(
    library: str,
    name: str,
    *arguments: ArrayLike,
    texels: NDArray[np.float32] | None = None,
    constant: int = 0,
) -> NDArray[np.float32]:
    """The result of GLSL function ``name`` for each row of the arguments, float32.

    Parameters
    ----------
    library : str
        Which file of ``shaders/lib``, without its suffix.
    arguments : arrays of shape (N,) or (N, k)
        One per ``in`` parameter; single values are repeated.
    texels : (H, W, 3) float32, optional
        What a ``sampler2D`` parameter reads.
    constant : int, optional
        What a ``const int`` parameter is compiled with.

    Returns
    -------
    (N,) or (N, k) array; ``out`` parameters follow as further columns.
    """
    import moderngl

    signature = signatures(library)[name]
    inputs = [p for p in signature.parameters if p[0] == "in" and p[1] in WIDTH]
    columns = _columns(arguments, [WIDTH[kind] for _, kind, _ in inputs])
    outputs = [("result", signature.result)]
    outputs += [
        (label, kind) for qualifier, kind, label in signature.parameters if qualifier == "out"
    ]
    source = assemble(f"lib/{library}.glsl", tail=_main(signature, outputs, constant))
    context = headless()
    varyings = tuple(f"out_{label}" for label, _ in outputs)
    try:
        program = context.program(vertex_shader=source.text, varyings=varyings)
    except moderngl.Error as error:
        raise ShaderError(source.explain(str(error))) from None

    # Bind what the program kept of its inputs, run it once per row, and read it back.
    names = [f"in_{label}" for _, _, label in inputs]
    content: Any = [
        (context.buffer(column.tobytes()), f"{column.shape[1]}f", label)
        for column, label in zip(columns, names, strict=True)
        if label in program
    ]
    textures = []
    if texels is not None:
        size = (texels.shape[1], texels.shape[0])
        textures = [context.texture(size, 3, np.ascontiguousarray(texels).tobytes(), dtype="f4")]
        textures[0].use(0)
    widths = sum(WIDTH[kind] for _, kind in outputs)
    rows = len(columns[0])
    buffer = context.buffer(reserve=4 * rows * widths)
    rest(context)
    array = context.vertex_array(program, content)
    array.transform(buffer, moderngl.POINTS, rows)
    result = np.frombuffer(buffer.read(), np.float32).reshape(rows, widths)
    held: list[Any] = [array, program, buffer, *textures, *(column for column, *_ in content)]
    for item in held:
        item.release()
    return result[:, 0] if widths == 1 else result


def _main(signature: Signature, outputs: list[tuple[str, str]], constant: int) -> str:
    lines, passed = [], []
    for qualifier, kind, label in signature.parameters:
        if kind.startswith("sampler"):
            lines.append(f"uniform {kind} in_{label};")
            passed.append(f"in_{label}")
        elif qualifier == "const":
            passed.append(str(constant))
        elif qualifier == "in":
            lines.append(f"in {kind} in_{label};")
            passed.append(f"in_{label}")
        else:
            passed.append(f"out_{label}")
    lines += [f"out {kind} out_{label};" for label, kind in outputs]
    lines.append(f"void main() {{ out_result = {signature.name}({', '.join(passed)}); }}")
    return "\n".join(lines)


def _columns(arguments: tuple[ArrayLike, ...], widths: list[int]) -> list[NDArray[np.float32]]:
    """The arguments as float32 arrays of one length, shape (N, width) each."""
    shaped = [
        np.asarray(a, dtype=np.float32).reshape(-1, width)
        for a, width in zip(arguments, widths, strict=True)
    ]
    rows = max(len(array) for array in shaped)
    return [
        np.ascontiguousarray(np.broadcast_to(array, (rows, array.shape[1]))) for array in shaped
    ]
