"""Rows of form factors that the GPU adds up itself, in a buffer that all pixels write to."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from playground.render.gl.driver import software
from playground.shading.floats import Array

if TYPE_CHECKING:
    import moderngl

WHOLE = 2.0**31  # the form factor 1, in the whole numbers of the buffer
ITEMS, DELTAS = 0, 1  # texture units


def can_add(context: moderngl.Context) -> bool:
    """Whether shaders of this driver can write to a common buffer."""
    return context.version_code >= 430


def adds_faster(context: moderngl.Context) -> bool:
    """Whether the GPU is the one to add: where there is one.

    A driver that computes on the CPU locks a number for every pixel, and takes three times as
    long as NumPy's bincount; a GPU has adders for it, and saves reading the pictures back.
    """
    return can_add(context) and not software(context)


class RowBuffer:
    """One row of N numbers for each hemicube of a draw call, and the delta form factors.

    A delta form factor is rounded to 2^-31; a form factor is off by no more than the
    number of its pixels times half of that.
    """

    def __init__(self, context: moderngl.Context, deltas: Array, rows: int, patches: int) -> None:
        self._shape = (rows, patches)
        self._buffer = context.buffer(reserve=4 * rows * patches)
        whole = np.rint(deltas * WHOLE).astype(np.uint32)
        size = (deltas.shape[1], deltas.shape[0])
        self._deltas = context.texture(size, 1, whole.tobytes(), dtype="u4")
        self._context = context

    def begin(self, program: Any, items: moderngl.Texture | None = None) -> None:
        """Set all rows to 0 and bind them for ``program``, with the pictures that it adds up."""
        self._buffer.clear()
        self._buffer.bind_to_storage_buffer(0)
        program["FormFactorRows"].binding = 0
        self._deltas.use(DELTAS)
        program["deltas"].value = DELTAS
        if items is not None:
            items.use(ITEMS)
            program["items"].value = ITEMS

    def read(self, count: int) -> Array:
        """The first ``count`` rows, (count, N)."""
        self._context.memory_barrier()
        size = 4 * count * self._shape[1]
        whole = np.frombuffer(self._buffer.read(size), np.uint32).reshape(count, -1)
        return np.asarray(whole / WHOLE)

    def release(self) -> None:
        """Free the GPU memory."""
        self._buffer.release()
        self._deltas.release()
