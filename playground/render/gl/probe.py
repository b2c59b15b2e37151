"""Runs a function of ``shaders/lib`` on the GPU for arrays of arguments.

What the parity tests and the case checker call: the very GLSL that the renderer uses,
in float32 or another precision, through transform feedback; no pixels involved.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from playground import locate
from playground.render.gl.context import headless, rest
from playground.render.gl.program import ShaderError
from playground.render.gl.source import Source, assemble

if TYPE_CHECKING:
    import moderngl

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
            label, array, length = label.partition("[")
            kind += array + length
            parameters.append((qualifier[0] if qualifier else "in", kind, label))
        found[name] = Signature(result, name, tuple(parameters))
    return found


def call(
    library: str,
    name: str,
    *arguments: ArrayLike,
    texels: NDArray[np.float32] | None = None,
    constant: int = 0,
    precision: str = "native",
) -> NDArray[Any]:
    """The result of GLSL function ``name`` for each row of the arguments.

    Parameters
    ----------
    library : str
        Which file of ``shaders/lib``, without its suffix.
    arguments : arrays of shape (N,) or (N, k)
        One per ``in`` parameter; single values are repeated. An array parameter, such as
        the (K, 3) corners of a polygon, and a ``bool`` are the same for all rows.
    texels : (H, W, 3) or (H, W, 4) float32, optional
        What a ``sampler2D`` parameter reads.
    constant : int, optional
        What a ``const int`` parameter is compiled with.
    precision : {"native", "float16", "float64"}, optional
        In which arithmetic, see `playground.render.gl.other_precision`.

    Returns
    -------
    (N,) or (N, k) array of float32, or float64 for this precision; ``out`` parameters
        follow as further columns.

    Raises
    ------
    ShaderError
        The library does not compile.
    KeyError
        It has no such function.
    """
    import moderngl

    signature = signatures(library)[name]
    taken = [p for p in signature.parameters if p[0] == "in" and not p[1].startswith("sampler")]
    given = list(zip(taken, arguments, strict=True))
    inputs = [p for p in taken if p[1] in WIDTH]
    number = np.dtype(np.float64 if precision == "float64" else np.float32)
    columns = _columns(
        tuple(value for p, value in given if p[1] in WIDTH),
        [WIDTH[kind] for _, kind, _ in inputs],
        number,
    )
    same: dict[str, tuple[str, Any]] = {
        label: (kind, value) for (_, kind, label), value in given if kind not in WIDTH
    }
    outputs = [("result", signature.result)]
    outputs += [
        (label, kind) for qualifier, kind, label in signature.parameters if qualifier == "out"
    ]
    lengths = {kind[:-1].split("[")[1]: len(v) for kind, v in same.values() if "[" in kind}
    main = _main(signature, outputs, constant, precision)
    source = _source(library, lengths, main, precision)
    context = headless()
    varyings = tuple(f"out_{label}" for label, _ in outputs)
    try:
        program = context.program(vertex_shader=source.text, varyings=varyings)
    except moderngl.Error as error:
        raise ShaderError(source.explain(str(error))) from None

    for label, (kind, value) in same.items():
        if f"in_{label}" in program:
            dtype = np.dtype(np.int32) if kind == "bool" else number
            uniform: Any = program[f"in_{label}"]
            uniform.write(np.asarray(value, dtype).tobytes())

    inside = {f"in_{label}": column for (_, _, label), column in zip(inputs, columns, strict=True)}
    result = _run(context, program, inside, texels, sum(WIDTH[kind] for _, kind in outputs))
    return result[:, 0] if result.shape[1] == 1 else result


def _run(
    context: moderngl.Context,
    program: moderngl.Program,
    columns: dict[str, NDArray[Any]],
    texels: NDArray[np.float32] | None,
    width: int,
) -> NDArray[Any]:
    """Bind what the program kept of its inputs, run it once per row, read it back, let it go."""
    import moderngl

    rows, number = next(((len(c), c.dtype) for c in columns.values()), (1, np.dtype(np.float32)))
    content: Any = [
        (context.buffer(column.tobytes()), f"{column.shape[1]}f{number.itemsize}", name)
        for name, column in columns.items()
        if name in program
    ]
    textures = []
    if texels is not None:
        size = (texels.shape[1], texels.shape[0])
        channels = texels.shape[2]
        textures = [
            context.texture(size, channels, np.ascontiguousarray(texels).tobytes(), dtype="f4")
        ]
        textures[0].use(0)
    buffer = context.buffer(reserve=number.itemsize * rows * width)
    rest(context)
    array = context.vertex_array(program, content)
    array.transform(buffer, moderngl.POINTS, rows)
    result = np.frombuffer(buffer.read(), number).reshape(rows, width)
    held: list[Any] = [array, program, buffer, *textures, *(column for column, *_ in content)]
    for item in held:
        item.release()
    return result


def _source(library: str, defines: dict[str, int], main: str, precision: str) -> Source:
    if precision == "native":
        return assemble(f"lib/{library}.glsl", defines, tail=main)
    from playground.render.gl.other_precision import in_precision, libraries

    first = libraries(precision, area_lights=True)
    source = assemble(f"lib/{library}.glsl", defines, tail=main, first=first)
    return in_precision(source, precision, {})


def _main(
    signature: Signature, outputs: list[tuple[str, str]], constant: int, precision: str
) -> str:
    lines, passed = [], []
    double = precision == "float64"

    def typed(kind: str) -> str:
        return {"float": "double"}.get(kind, f"d{kind}") if double else kind

    for qualifier, kind, label in signature.parameters:
        if kind.startswith("sampler") or (qualifier == "in" and kind not in WIDTH):
            lines.append(f"uniform {kind} in_{label};")
            passed.append(f"in_{label}")
        elif qualifier == "const":
            passed.append(str(constant))
        elif qualifier == "in":
            lines.append(f"in {typed(kind)} in_{label};")
            passed.append(f"in_{label}")
        else:
            passed.append(f"out_{label}")
    lines += [f"out {typed(kind)} out_{label};" for label, kind in outputs]
    lines.append(f"void main() {{ out_result = {signature.name}({', '.join(passed)}); }}")
    return "\n".join(lines)


def _columns(
    arguments: tuple[ArrayLike, ...], widths: list[int], dtype: np.dtype[Any]
) -> list[NDArray[Any]]:
    """The arguments as arrays of one type and length, shape (N, width) each."""
    shaped = [
        np.asarray(a, dtype=dtype).reshape(-1, width)
        for a, width in zip(arguments, widths, strict=True)
    ]
    rows = max((len(array) for array in shaped), default=1)
    return [
        np.ascontiguousarray(np.broadcast_to(array, (rows, array.shape[1]))) for array in shaped
    ]
