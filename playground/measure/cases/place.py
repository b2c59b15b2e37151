"""Cases of places and directions: normals under interpolation and transforms, the eye's space."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from playground.render.view import View
from playground.shading.vector import normal_matrix, orientation

Outputs = dict[str, Any]


def eye_space(eye: ArrayLike, places: list[Any], real: Any) -> list[NDArray[Any]]:
    """World points relative to the eye, as `View` gives them to both renderers.

    Subtracted in float64, times a power of two that makes the farthest about 1, and only
    then rounded to ``real``.
    """
    eye = np.asarray(eye, np.float64)
    farthest = float(np.max(np.abs(np.subtract(places, eye, dtype=np.float64))))
    view = _view(eye, 2.0 ** -int(np.frexp(farthest)[1]), np.eye(3))
    return [real(view.relative(place)) for place in places]


def camera_relative(inputs: Outputs, formulas: Any) -> Outputs:
    """R (P − camera); the subtraction is made on the CPU for both backends."""
    view = _view(np.asarray(inputs["camera"], np.float64), 1.0, np.asarray(inputs["R"]))
    relative = formulas.real(view.relative(inputs["P"]))
    return {"view": formulas.real(view.camera_from_world) @ relative}


def normal_interp(inputs: Outputs, formulas: Any) -> Outputs:
    """Σ wᵢ nᵢ, made unit length again; a sum of zero has no direction."""
    normals = np.asarray(inputs["normals"], formulas.real)
    if inputs.get("normalize_inputs"):
        normals = formulas.vector.unit(normals)
    normal = formulas.vector.unit(np.asarray(inputs["weights"], formulas.real) @ normals)
    return {"degenerate": not np.any(normal), "normal": normal}


def normal_matrix_case(inputs: Outputs, formulas: Any) -> Outputs:
    """The normal of a transformed surface; its matrix is made on the CPU for both backends."""
    matrix = normal_matrix(inputs["M"])
    sign = orientation(inputs["M"])
    outward = formulas.vector.unit(formulas.real(matrix) @ formulas.vector.unit(inputs["n"]))
    return {
        "degenerate": not np.any(outward),
        "singular": sign == 0.0,
        "outward_normal": outward,
        "winding_normal": -outward if sign < 0.0 else outward,
    }


def _view(eye: NDArray[np.float64], scale: float, rotation: NDArray[np.float64]) -> View:
    """A view from ``eye``; its near and far plane and its angle do not matter here."""
    return View(eye, scale, 1.0, 2.0, 90.0, np.eye(4), rotation)
