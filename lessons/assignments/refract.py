"""Assignment of lesson 13: write the direction of the refracted ray.

Copy this file, fill in the function, and ask how right it is:

    playground lesson 13 --check my_refract.py

``normal`` and ``to_eye`` are NumPy arrays of three numbers and have length 1. Both point to the
side from which the ray comes: it came along -to_eye.
"""

import numpy as np  # noqa: F401 - you will need it


def refraction(normal, to_eye, index_i, index_t):
    """The direction (three numbers, length 1) in which the ray goes on, by Snell's law.

    index_i is the refractive index on the side of the normal, index_t that of the far side. Where
    there is total internal reflection, the answer is (0, 0, 0).
    """
    raise NotImplementedError
