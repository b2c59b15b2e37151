"""Rows of form factors by any method on either renderer, ready to be timed."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from functools import partial
from typing import Any

from playground.measure.matrix_errors import Ints
from playground.measure.record import Timer
from playground.measure.timing import rounds_of
from playground.render.radiosity.factor.closed_form import ClosedForm
from playground.render.radiosity.factor.form_factors import METHODS
from playground.render.radiosity.factor.hemicube import Hemicubes
from playground.render.radiosity.patch.patches import Patches
from playground.shading.floats import Array

MakeRows = Callable[[Ints], Array]


@contextmanager
def row_maker(method: str, renderer: str, patches: Patches, **knobs: Any) -> Iterator[MakeRows]:
    """What computes rows by a method of `METHODS`: every call does all of the work again."""
    with ExitStack() as stack:
        if method == "closed-form":
            yield _closed_form(renderer, patches, knobs, stack)
        elif method == "hemicube" and renderer == "gl":
            from playground.render.gl.context import headless
            from playground.render.gl.radiosity.hemicube import Hemicubes as GpuHemicubes

            cubes = GpuHemicubes(headless(), patches, **knobs)
            stack.callback(cubes.release)
            yield cubes.rows
        elif method == "hemicube":
            yield Hemicubes(patches, **knobs).rows
        else:
            yield partial(METHODS[method], patches, **knobs)


def _closed_form(
    renderer: str, patches: Patches, knobs: dict[str, Any], stack: ExitStack
) -> MakeRows:
    """A new `ClosedForm` at each call: an old one has kept what it computed."""
    if renderer != "gl":
        return lambda chosen: ClosedForm(patches, **knobs)(chosen)
    from playground.render.gl.context import headless
    from playground.render.gl.radiosity.pairs import GpuPairs

    pairs = GpuPairs(headless(), patches, **knobs)
    stack.callback(pairs.release)
    return lambda chosen: ClosedForm(patches, **knobs, gpu=pairs)(chosen)


def timer_of(rows: MakeRows, chosen: Ints) -> Timer:
    """Milliseconds per row, of calls that compute all the chosen ones (k,)."""
    return rounds_of(partial(rows, chosen), warm_up=1, parts=len(chosen))
