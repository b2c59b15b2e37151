"""The project's formulas, once as float64 NumPy and once as float32 on the GPU.

A solver asks for a formula by file and name, ``formulas.phong.diffuse_factor(n, l)``, and
does not see which language answers: both have the same names and arguments.
"""

from __future__ import annotations

from collections.abc import Callable
from math import prod
from typing import Any

import numpy as np

from playground import shading


class NumPyFormulas:
    """The functions of ``playground/shading`` themselves."""

    precision = "f64"
    real = np.float64

    def __getattr__(self, library: str) -> Any:
        return getattr(shading, library)


class GLFormulas:
    """The functions of ``shaders/lib``, run on the GPU by `playground.render.gl.probe`."""

    precision = "f32"
    real = np.float32

    def __getattr__(self, library: str) -> Any:
        if library not in shading.__all__:
            raise AttributeError(f"there is no file shaders/lib/{library}.glsl")
        return _Library(library)


class _Library:
    """One file of ``shaders/lib``; its attributes are its functions."""

    def __init__(self, stem: str) -> None:
        self._stem = stem

    def __getattr__(self, name: str) -> Callable[..., Any]:
        return lambda *arguments: _on_gpu(self._stem, name, arguments)


def _on_gpu(library: str, name: str, arguments: tuple[Any, ...]) -> Any:
    """Call a GLSL function as its NumPy twin is called: arrays broadcast, results are arrays.

    ``out`` parameters follow the result, as further members of a tuple.

    Raises
    ------
    ValueError
        The arguments have no such shape as the function takes.
    """
    import moderngl

    from playground.render.gl import probe

    signature = probe.signatures(library)[name]
    wanted = [kind for qualifier, kind, _ in signature.parameters if qualifier == "in"]
    given = list(zip(wanted, arguments, strict=True))
    texels = next((np.asarray(x, np.float32) for k, x in given if k.startswith("sampler")), None)

    # Bring all arguments to one leading shape and their elements into rows; what is no number or
    # vector, such as the corners of a polygon, is the same for all of them.
    leads = [_split(x, probe.WIDTH[kind])[0] for kind, x in given if kind in probe.WIDTH]
    shape = np.broadcast_shapes(*leads)
    rows = []
    for kind, argument in given:
        if kind in probe.WIDTH:
            width = probe.WIDTH[kind]
            own = _split(argument, width)[1]
            full = np.broadcast_to(np.asarray(argument, np.float32), shape + own)
            rows.append(full.reshape(-1, width))
        elif not kind.startswith("sampler"):
            if not np.size(argument):
                raise ValueError(f"{library}.{name} takes no such arguments: a list is empty")
            rows.append(np.asarray(argument))
    try:
        result = probe.call(library, name, *rows, texels=texels).reshape(prod(shape), -1)
    except moderngl.Error as error:
        raise ValueError(f"{library}.{name} takes no such arguments: {error}") from None

    outputs, start = [], 0
    kinds = [signature.result, *(kind for way, kind, _ in signature.parameters if way == "out")]
    for kind in kinds:
        width = probe.WIDTH[kind]
        own = (width,) if width > 1 else ()
        outputs.append(result[:, start : start + width].reshape(shape + own))
        start += width
    return tuple(outputs) if len(outputs) > 1 else outputs[0]


def _split(argument: Any, width: int) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """The leading shape of an argument, and that of one element: () or (width,)."""
    shape = np.shape(argument)
    return (shape[:-1], shape[-1:]) if width > 1 else (shape, ())


FORMULAS: dict[str, type[NumPyFormulas] | type[GLFormulas]] = {
    "numpy": NumPyFormulas,
    "gl": GLFormulas,
}
