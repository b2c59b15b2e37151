"""Every way to compute form factors, with one signature, so that they can be compared.

``(patches, chosen, occlusion=True, **knob) -> (len(chosen), N)``: the rows F_ij of the chosen
patches i, the share of the light that leaves i and arrives at each patch j. Four look from the
centre of patch i only: "point-to-point", "point-to-polygon" and, by counting, "hemisphere" and
"hemicube". They get touching patches wrong: squares at a right angle by +59 % (point-to-point) or
-5 % (the others), narrow or sharply folded patches by more. "closed-form" is from patch to patch.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from playground.render.radiosity.factor.closed_form import ClosedForm, closed_form
from playground.render.radiosity.factor.hemicube import hemicube
from playground.render.radiosity.factor.hemisphere import hemisphere
from playground.render.radiosity.factor.pairs import enough_rays
from playground.render.radiosity.factor.visibility import between, facing
from playground.render.radiosity.patch.patches import Patches
from playground.scene.settings import Settings
from playground.shading import form_factor as formulas
from playground.shading.area_light import form_factor
from playground.shading.floats import Array

if TYPE_CHECKING:
    import moderngl

Ints = NDArray[np.intp]
PAIRS = 200_000  # at a time


def point_to_point(patches: Patches, chosen: ArrayLike, occlusion: bool = True) -> Array:
    """F ≈ cos θ_i cos θ_j A_j / (π r²) between centres, if nothing stands between them.

    Too large close by, by 59 % for squares that face each other a side apart; it may exceed 1.
    0 where centres coincide.
    """

    def formula(i: Ints, j: Ints) -> Array:
        centre, normal = patches.centre, patches.normal
        per_area = formulas.point_to_point(centre[i], normal[i], centre[j], normal[j])
        return np.asarray(per_area * patches.area[j])

    return _between_centres(patches, chosen, occlusion, formula)


def point_to_polygon(patches: Patches, chosen: ArrayLike, occlusion: bool = True) -> Array:
    """Lambert's closed form from the centre of i to all of j, if nothing stands between centres.

    Rows (k, N) of the k chosen patches. Exact for the centre; how F differs at other points of
    patch i is what it misses.
    """

    def formula(i: Ints, j: Ints) -> Array:
        return form_factor(patches.centre[i], patches.normal[i], patches.polygon[j], False)

    return _between_centres(patches, chosen, occlusion, formula)


def _between_centres(
    patches: Patches, chosen: ArrayLike, occlusion: bool, formula: Callable[[Ints, Ints], Array]
) -> Array:
    """Rows of a formula for pairs that face each other; one segment says what is visible."""
    wanted = np.asarray(chosen, dtype=np.intp).reshape(-1)
    size, everything = len(patches), np.arange(len(patches))
    rows = np.zeros((len(wanted), size))
    step = max(PAIRS // size, 1)
    centre, normal = patches.centre, patches.normal
    for first in range(0, len(wanted), step):
        part = wanted[first : first + step]
        i, j = np.repeat(part, size), np.tile(everything, len(part))
        open_ = np.flatnonzero(facing(patches, i, j))
        i, j = i[open_], j[open_]
        values = formula(i, j)
        if occlusion:
            values[between(patches).hidden(centre[i], normal[i], centre[j], normal[j])] = 0.0
        rows[first : first + step].flat[open_] = values
    return rows


METHODS: dict[str, Callable[..., Array]] = {
    "hemicube": hemicube,
    "closed-form": closed_form,
    "hemisphere": hemisphere,
    "point-to-polygon": point_to_polygon,
    "point-to-point": point_to_point,
}


class OpenRows:
    """Rows of a setup's patches, (k, N), whenever it is called with patches (k,).

    ``renderer`` says where they are computed, "gl" or "numpy". To be closed when done with.
    """

    def __init__(
        self, rows: Callable[[Ints], Array], renderer: str, release: Callable[[], None]
    ) -> None:
        self.renderer = renderer
        self._rows, self._release = rows, release
        self._open = True

    def __call__(self, chosen: ArrayLike) -> Array:
        """Rows F_ij of the chosen patches, (k, N)."""
        return self._rows(np.asarray(chosen, dtype=np.intp).reshape(-1))

    def close(self) -> None:
        """Free what is held on the GPU."""
        if self._open:
            self._release()
        self._open = False


def open_rows(
    patches: Patches,
    settings: Settings,
    renderer: str = "auto",
    context: moderngl.Context | None = None,
) -> OpenRows:
    """The rows of ``patches`` as ``settings`` ask for them.

    Hemicube and closed form are computed on the GPU where there is one that can, the others in
    NumPy always.

    Raises
    ------
    NoDriverError
        ``renderer`` is "gl", and there is no driver.
    """
    method, occlusion = settings.form_factors, settings.occlusion
    if method in ("hemicube", "closed-form") and renderer != "numpy":
        from playground.render.gl.context import available, headless

        if context is not None or renderer == "gl" or available():
            found = _on_gpu(patches, settings, context or headless())
            if found is not None:
                return found
    if method == "closed-form":
        rays = enough_rays(len(patches))
        return OpenRows(ClosedForm(patches, occlusion, rays=rays), "numpy", _nothing)
    knobs: dict[str, Any] = {"resolution": settings.hemicube} if method == "hemicube" else {}

    def rows(chosen: Ints) -> Array:
        return METHODS[method](patches, chosen, occlusion, **knobs)

    return OpenRows(rows, "numpy", _nothing)


def _on_gpu(patches: Patches, settings: Settings, context: moderngl.Context) -> OpenRows | None:
    """The rows on the GPU; None where its driver is too old for them."""
    occlusion = settings.occlusion
    if settings.form_factors == "hemicube":
        from playground.render.gl.radiosity.hemicube import Hemicubes
        from playground.render.gl.radiosity.row_buffer import can_add

        if not (occlusion or can_add(context)):
            return None
        cubes = Hemicubes(context, patches, occlusion, settings.hemicube)
        return OpenRows(cubes.rows, "gl", cubes.release)
    from playground.render.gl.radiosity.pairs import GpuPairs

    rays = enough_rays(len(patches))
    pairs = GpuPairs(context, patches, occlusion, rays=rays)
    return OpenRows(ClosedForm(patches, occlusion, rays=rays, gpu=pairs), "gl", pairs.release)


def _nothing() -> None:
    """Nothing to release."""
