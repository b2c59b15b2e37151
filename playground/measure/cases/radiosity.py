"""Cases of radiosity: furnaces, given matrices, enclosures whose form factors are known.

A system of equations is solved on the CPU for both backends, by elimination.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from playground.measure.cases.form_factor import box
from playground.render.radiosity.solver.whole import elimination
from playground.shading.floats import Array

Outputs = dict[str, Any]


def furnace(inputs: Outputs, formulas: Any) -> Outputs:
    """A closed room of one colour: its light in the end, and after so many bounces."""
    emission, rho = inputs["emission"], inputs["rho"]
    everywhere = formulas.enclosure.furnace(emission, rho)
    return {
        "B": everywhere,
        "B_after_bounces": formulas.enclosure.furnace_after(emission, rho, inputs["bounces"]),
        "irradiance": everywhere,
    }


def solve(inputs: Outputs, formulas: Any) -> Outputs:
    """The light of any matrix, which is taken as it is."""
    return {"B": _solved(inputs["F"], inputs["rho"], inputs["emission"])}


def enclosure(inputs: Outputs, formulas: Any) -> Outputs:
    """The light in an enclosure: by its closed form, or solved with exact form factors."""
    kind = inputs["enclosure"]
    if kind not in _ENCLOSURES:
        raise ValueError(f"an enclosure of an unknown kind: {kind}")
    return {"B": _ENCLOSURES[kind](inputs, formulas)}


def _solved(matrix: ArrayLike, rho: ArrayLike, emission: ArrayLike) -> Array:
    """C of given form factors, (N,)."""
    factors, *columns = (np.asarray(x, np.float64) for x in (matrix, rho, emission))
    return elimination(factors, *(column[:, None] for column in columns))[:, 0]


def _plates(inputs: Outputs, formulas: Any) -> list[Any]:
    return _facing(inputs, formulas, 1.0, 1.0)


def _facing(inputs: Outputs, formulas: Any, factor: Any, back: Any) -> list[Any]:
    """Two surfaces, ``factor`` and ``back`` the form factors of the first and of the second."""
    (e1, e2), (rho1, rho2) = inputs["emission"], inputs["rho"]
    share1, share2 = formulas.real(rho1) * factor, formulas.real(rho2) * back
    facing = formulas.enclosure.facing
    return [facing(e1, e2, share1, share2), facing(e2, e1, share2, share1)]


def _spheres(inputs: Outputs, formulas: Any) -> list[Any]:
    (e1, e2), (rho1, rho2) = inputs["emission"], inputs["rho"]
    back = formulas.form_factor_shapes.outer_to_inner_sphere(inputs["r_inner"], inputs["r_outer"])
    outer = formulas.enclosure.around_sphere(e2, e1, rho2, rho1, back)
    return [formulas.enclosure.leaving(e1, rho1, outer), outer]


def _zones(inputs: Outputs, formulas: Any) -> Any:
    share, rho, emission = (
        np.asarray(inputs[key], np.float64) for key in ("area_fractions", "rho", "emission")
    )
    lost = (1.0 - share.sum()) + share @ (1.0 - rho)
    arriving = formulas.enclosure.integrating_sphere(share @ emission, lost)
    return formulas.enclosure.leaving(emission, rho, arriving)


def _box(inputs: Outputs, formulas: Any) -> Array:
    return _solved(box(inputs, formulas)["F"], inputs["rho"], inputs["emission"])


def _duct(inputs: Outputs, formulas: Any) -> Array:
    sides, factor = inputs["sides"], formulas.enclosure.duct_factor
    matrix = [
        [0.0 if i == j else float(factor(sides[i], sides[j], sides[3 - i - j])) for j in range(3)]
        for i in range(3)
    ]
    return _solved(matrix, inputs["rho"], inputs["emission"])


def _opposed(inputs: Outputs, formulas: Any) -> list[Any]:
    factor = formulas.form_factor.opposite_rectangles(*inputs["abc"])
    return _facing(inputs, formulas, factor, factor)


def _perpendicular(inputs: Outputs, formulas: Any) -> list[Any]:
    width, height, edge = inputs["whl"]
    between = formulas.form_factor.adjacent_rectangles
    return _facing(inputs, formulas, between(width, height, edge), between(height, width, edge))


_ENCLOSURES = {
    "parallel_plates_infinite": _plates,
    "concentric_spheres": _spheres,
    "sphere_zones": _zones,
    "box_zonal": _box,
    "triangular_duct": _duct,
    "two_opposed_rectangles": _opposed,
    "two_perpendicular_rectangles": _perpendicular,
}
