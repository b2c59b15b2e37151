"""The formulas of the lecture: pure functions on arrays of shape (..., 3).

float64, unless the arrays are of fewer digits: see `playground.shading.floats`. NumPy
only. Nothing here knows a scene, a file or a GPU. Every module has a twin of the same
name in ``shaders/lib`` with the same functions, argument for argument; the parity tests
run both on the same numbers.
"""

from playground.shading import (
    arc,
    area_light,
    display,
    edge_log,
    edge_pair,
    enclosure,
    flat_polygon,
    form_factor,
    form_factor_shapes,
    hemicube,
    light,
    lightmap,
    marks,
    optics,
    phong,
    polygon,
    polygon_pair,
    power,
    ray,
    shadow,
    texture,
    triangle,
    vector,
)

__all__ = [
    "arc",
    "area_light",
    "display",
    "edge_log",
    "edge_pair",
    "enclosure",
    "flat_polygon",
    "form_factor",
    "form_factor_shapes",
    "hemicube",
    "light",
    "lightmap",
    "marks",
    "optics",
    "phong",
    "polygon",
    "polygon_pair",
    "power",
    "ray",
    "shadow",
    "texture",
    "triangle",
    "vector",
]
