"""Assignment of lesson 7: write the diffuse and the specular term.

Copy this file, fill in the two functions, and ask how right they are:

    playground lesson 7 --check my_phong.py

All vectors are NumPy arrays of three numbers. ``to_light`` and ``to_eye`` have length 1. The
``normal`` was interpolated between the vertices of a triangle, so that it may be shorter.
"""

import numpy as np  # noqa: F401 - you will need it


def diffuse(normal, to_light, light, material):
    """max(n·l, 0) s_d ⊗ m_d: the colour (three numbers) that the diffuse term adds."""
    raise NotImplementedError


def specular(normal, to_light, to_eye, shininess, light, material):
    """max(r·v, 0)^sh s_s ⊗ m_s: the colour (three numbers) that the specular term adds."""
    raise NotImplementedError
