"""In which arithmetic a formula is computed: in that of its arguments.

Arrays of float16 or float32 are computed in their own type, every operation rounded to
it (NumPy computes a float16 operation in float32 and rounds the result). Lists, Python's
numbers and arrays of whole numbers take the type of the others, and float64 where there
is none. A float64 array among the arguments makes everything float64.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[Any]  # of float64 unless float16 or float32 is handed in


def floats(*values: ArrayLike) -> tuple[Array, ...]:
    """The values as arrays of one floating type; a value beyond its range becomes infinite."""
    kinds = [v.dtype for v in values if isinstance(v, (np.ndarray, np.generic))]
    known = [kind for kind in kinds if kind.kind == "f"]
    dtype = np.result_type(*known) if known else np.dtype(np.float64)
    with np.errstate(over="ignore", under="ignore"):
        return tuple(np.asarray(value, dtype=dtype) for value in values)
