"""Cases of form factors: between points, plates, round shapes, and any two polygons.

Angles become sine and cosine on the CPU, in float64, as in the cases of rays.
"""

from __future__ import annotations

from math import cos, sin
from typing import Any

import numpy as np

Outputs = dict[str, Any]


def kernel(inputs: Outputs, formulas: Any) -> Outputs:
    """The lecture's form factor of two points, per area at the second."""
    points = (inputs[key] for key in ("x", "nx", "y", "ny"))
    return {"kernel": formulas.form_factor.point_to_point(*points)}


def discs(inputs: Outputs, formulas: Any) -> Outputs:
    """Two discs on one axis, both ways."""
    r1, r2, h = inputs["r1"], inputs["r2"], inputs["h"]
    between = formulas.form_factor_shapes.coaxial_discs
    return {"F12": between(r1, r2, h), "F21": between(r2, r1, h)}


def element_disc(inputs: Outputs, formulas: Any) -> Outputs:
    """From an element to a disc in a parallel plane."""
    lengths = (inputs["h"], inputs["offset"], inputs["r"])
    return {"F": formulas.form_factor_shapes.element_to_disc(*lengths)}


def element_sphere(inputs: Outputs, formulas: Any) -> Outputs:
    """From an element to a sphere, which its horizon may cut or hide."""
    seen = (inputs["distance"], inputs["r"], cos(inputs["angle"]))
    return {"F": formulas.form_factor_shapes.element_to_sphere(*seen)}


def sphere_rectangle(inputs: Outputs, formulas: Any) -> Outputs:
    """From a sphere to a rectangle with one corner below its centre."""
    lengths = (inputs["d"], inputs["l1"], inputs["l2"])
    return {"F_sphere_to_rect": formulas.form_factor_shapes.sphere_to_rectangle(*lengths)}


def inside_sphere(inputs: Outputs, formulas: Any) -> Outputs:
    """Two caps of one sphere, and the zone that is left between them."""
    radius, first, second = (inputs[key] for key in ("R", "cap1_height", "cap2_height"))
    to_zone = formulas.form_factor_shapes.sphere_to_zone
    return {
        "F12": to_zone(radius, second),
        "F21": to_zone(radius, first),
        "F11": to_zone(radius, first),
        "F1_rest": to_zone(radius, 2.0 * radius - first - second),
    }


def concentric(inputs: Outputs, formulas: Any) -> Outputs:
    """A sphere within a sphere: all that leaves the inner one arrives."""
    radii = (inputs["r_inner"], inputs["r_outer"])
    back = formulas.form_factor_shapes.outer_to_inner_sphere(*radii)
    itself = formulas.form_factor_shapes.outer_to_itself(*radii)
    return {"F12": 1.0, "F21": back, "F22": itself}


def strips(inputs: Outputs, formulas: Any) -> Outputs:
    """Infinitely long plates that share an edge, both ways."""
    a, b, half = inputs["a"], inputs["b"], 0.5 * inputs["angle"]
    between = formulas.form_factor.adjacent_strips
    return {"F12": between(a, b, sin(half), cos(half)), "F21": between(b, a, sin(half), cos(half))}


def box(inputs: Outputs, formulas: Any) -> Outputs:
    """The inside of a box, faces x−, x+, y−, y+, z−, z+: each sees one opposite, four adjacent."""
    size = np.asarray(inputs["size"], np.float64)
    opposite = formulas.form_factor.opposite_rectangles
    adjacent = formulas.form_factor.adjacent_rectangles
    matrix = np.zeros((6, 6))
    for i in range(6):
        for j in range(6):
            p, q = i // 2, j // 2
            if p != q:  # the common edge runs along the third axis
                matrix[i, j] = adjacent(size[q], size[p], size[3 - p - q])
            elif i != j:
                matrix[i, j] = opposite(size[(p + 1) % 3], size[(p + 2) % 3], size[p])
    return {"F": matrix}


def pair(inputs: Outputs, formulas: Any) -> Outputs:
    """Two polygons, both ways; the one with fewer corners repeats its last."""
    a, b = (list(inputs[key]) for key in ("A", "B"))
    corners = max(len(a), len(b))
    a += [a[-1]] * (corners - len(a))
    b += [b[-1]] * (corners - len(b))
    return {
        "area_A": formulas.flat_polygon.polygon_area(a),
        "area_B": formulas.flat_polygon.polygon_area(b),
        "F_AB": formulas.polygon_pair.pair_form_factor(a, b),
        "F_BA": formulas.polygon_pair.pair_form_factor(b, a),
    }
