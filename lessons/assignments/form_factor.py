"""Assignment of lesson 14: write the form factor of two points, and of two patches.

Copy this file, fill in the two functions, and ask how right they are:

    playground lesson 14 --check my_form_factor.py

All vectors are NumPy arrays of three numbers. Normals may have any length. A patch is a
parallelogram: one corner, and the two edges that start there; its front is where
first × second points, and the length of first × second is its area.
"""

import numpy as np  # noqa: F401 - you will need it


def point_to_point(x, normal_x, y, normal_y):
    """cos θ_x cos θ_y / (π |v|²), one number: how much of the light of x arrives per area at y.

    v goes from x to y. What faces away gets no light.
    """
    raise NotImplementedError


def patch_to_patch(corner_i, first_i, second_i, corner_j, first_j, second_j):
    """F_ij, one number: the fraction of the light leaving patch i that arrives at patch j.

    Cut both patches into 4 x 4 pieces, and let the centre of each piece speak for it.
    """
    raise NotImplementedError
