"""The formulas of the lecture: pure float64 functions on arrays of shape (..., 3).

NumPy only. Nothing here knows a scene, a file or a GPU. Every module has a twin of
the same name in ``shaders/lib`` with the same functions, argument for argument; the
parity tests run both on the same numbers.
"""

from playground.shading import display, light, phong, power, texture, vector

__all__ = ["display", "light", "phong", "power", "texture", "vector"]
