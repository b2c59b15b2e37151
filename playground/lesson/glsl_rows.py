"""Runs a function of GLSL text for rows of arguments, through transform feedback."""

from __future__ import annotations

from typing import Any

import numpy as np

from playground.errors import PlaygroundError
from playground.shading.vector import Array

TYPES = {1: "float", 3: "vec3"}


def run_rows(
    text: str, file: str, name: str, arguments: tuple[Array, ...], width: int = 3
) -> Array:
    """What function ``name`` of the text gives for each row of the arguments, (N, width).

    Raises
    ------
    PlaygroundError
        The text does not compile; the message names ``file`` and the line. Or there is no
        GL driver.
    """
    import moderngl

    from playground.render.gl.context import NoDriverError, headless, rest
    from playground.render.gl.source import assemble

    rows = [np.ascontiguousarray(a, dtype=np.float32).reshape(len(a), -1) for a in arguments]
    inputs = [f"in {TYPES[row.shape[1]]} in_{i};" for i, row in enumerate(rows)]
    passed = ", ".join(f"in_{i}" for i in range(len(rows)))
    main = f"out {TYPES[width]} out_result;\nvoid main() {{ out_result = {name}({passed}); }}"
    source = assemble(file, tail="\n".join([*inputs, main]), overrides={file: text})
    try:
        context = headless()
    except NoDriverError as error:
        raise PlaygroundError(
            "GLSL is checked by the GPU, and there is no GL driver",
            fix="Write the functions in Python, or see playground doctor for what to install.",
        ) from error
    try:
        program = context.program(vertex_shader=source.text, varyings=("out_result",))
    except moderngl.Error as error:
        types = ", ".join(TYPES[row.shape[1]] for row in rows)
        raise PlaygroundError(_told(source.explain(str(error)), file, f"{name}({types})")) from None
    columns = [context.buffer(row.tobytes()) for row in rows]
    content = [
        (column, f"{rows[i].shape[1]}f4", f"in_{i}")
        for i, column in enumerate(columns)
        if f"in_{i}" in program
    ]
    count = len(rows[0])
    buffer = context.buffer(reserve=4 * width * count)
    rest(context)
    array = context.vertex_array(program, content)
    array.transform(buffer, moderngl.POINTS, count)
    result = np.frombuffer(buffer.read(), np.float32).reshape(count, width).astype(np.float64)
    held: list[Any] = [array, program, buffer, *columns]
    for item in held:
        item.release()
    return result


def _told(message: str, file: str, call: str) -> str:
    """What the compiler says, with the name of the student's file and nothing of our own lines."""
    lines = [row.replace(f"shaders/{file}:", f"{file}:") for row in message.splitlines()]
    theirs = [row for row in lines if row.startswith(f"{file}:")]
    if theirs:
        return "\n".join(theirs)
    reason = lines[0].partition(": ")[2]
    return f"{file}: {call} cannot be called: does a brace lack, or an argument? ({reason})"
