"""The hemicube: half a cube over a patch, and how much of its light goes through each pixel.

Twin: shaders/lib/hemicube.glsl. The cube has half edge 1 and stands on the patch, its centre in
the patch's. The top is the plane z = 1 with N x N pixels, each side has N x N/2; pixels
are counted along the first axis of their face from −1 (``column``) and along the second (``row``)
from −1 on the top, from the horizon z = 0 on a side. What goes through a pixel is its *delta form
factor*; those of all pixels in which another patch is seen add up to the form factor.

Source: Cohen & Greenberg, The Hemi-Cube: A Radiosity Solution for Complex Environments, SIGGRAPH
1985; Cohen & Wallace, Radiosity and Realistic Image Synthesis, 1993, section 4.
"""

from __future__ import annotations

from math import ceil, pi

import numpy as np
from numpy.typing import ArrayLike

from playground.shading.floats import Array, floats

# Gauss's five points on −1 to 1 and their weights, which sum to 2.
NODES = (-0.9061798459386640, -0.5384693101056831, 0.0, 0.5384693101056831, 0.9061798459386640)
WEIGHTS = (
    0.2369268850561891,
    0.4786286704993665,
    0.5688888888888889,
    0.4786286704993665,
    0.2369268850561891,
)

FINE = 16.0  # pixels per edge from which five points are enough for all 15 digits


def delta_density(u: ArrayLike, v: ArrayLike, height: ArrayLike) -> Array:
    """The form factor per area of a face at (u, v, 1): height / (π (1 + u² + v²)²), shape (...).

    ``height`` is that of the place over the patch: 1 on the top, v on a side. One cosine is
    height/r at the patch, the other 1/r at the face, over π r².
    """
    u, v, height = floats(u, v, height)
    squared = 1.0 + u * u + v * v
    return np.asarray(height / (pi * squared * squared))


def delta_form_factor(
    column: ArrayLike, row: ArrayLike, resolution: ArrayLike, side: bool
) -> Array:
    """The delta form factor of a pixel by the midpoint rule, as in the paper, shape (...).

    Over all pixels they sum to 1 + 0.54/N² for large N: 1.0021 at 16, 1.00013 at 64.
    """
    column, row, resolution = floats(column, row, resolution)
    u = (2.0 * column + 1.0 - resolution) / resolution
    v = (2.0 * row + 1.0 - (0.0 if side else resolution)) / resolution
    area = 4.0 / (resolution * resolution)
    return np.asarray(area * delta_density(u, v, v if side else 1.0))


def exact_delta_form_factor(
    column: ArrayLike, row: ArrayLike, resolution: ArrayLike, side: bool
) -> Array:
    """The integral over the pixel, by Gauss's rule of 5 x 5 points; over all pixels they sum to 1.

    Coarse pixels are cut into cells of an edge of at most 1/8. The error is 2e-14, relative: the
    integrand's poles are at a distance of 1 from the face, 16 half edges of a cell, so that the
    rule's error is about 32^-10. A closed form (the difference of the view factors of four
    rectangles) would lose five digits in the lowest row.
    """
    column, row, resolution = floats(column, row, resolution)
    cells = ceil(FINE / float(np.min(resolution)))
    half = 1.0 / (cells * resolution)
    sum_over = np.zeros(np.broadcast_shapes(column.shape, row.shape, resolution.shape))
    total = np.asarray(sum_over, dtype=resolution.dtype)
    for i in range(cells):
        left = (2.0 * column - resolution) / resolution + (2 * i + 1) * half
        for j in range(cells):
            low = (2.0 * row - (0.0 if side else resolution)) / resolution + (2 * j + 1) * half
            for x, weight_x in zip(NODES, WEIGHTS, strict=True):
                for y, weight_y in zip(NODES, WEIGHTS, strict=True):
                    v = low + y * half
                    density = delta_density(left + x * half, v, v if side else 1.0)
                    total = total + weight_x * weight_y * density
    return np.asarray(total * half * half)


def face_coordinates(local: ArrayLike, face: ArrayLike) -> Array:
    """A vector (..., 3) over the patch as a face sees it: to its right, up, and ahead.

    ``local`` are the components along tangent, bitangent and normal. Face 0 is the top; 1 and 2
    look along the tangent and against it, 3 and 4 along the bitangent and against it, all four
    with the normal up.
    """
    (local,) = floats(local)
    face = np.asarray(face)
    x, y, z = local[..., 0], local[..., 1], local[..., 2]
    choices = [[x, y, z], [y, z, x], [-y, z, -x], [-x, z, y], [x, z, -y]]
    axes = [np.choose(face.astype(np.int64), [choice[k] for choice in choices]) for k in range(3)]
    return np.stack(axes, axis=-1)


def place_on_quad(place: ArrayLike, far: ArrayLike) -> Array:
    """Where a point lies on a flat convex quad a, b, c, d: the (s, t) of its bilinear mean.

    Both arguments (..., 2) are in units of the edges from a: the point is
    a + p (b − a) + q (d − a), and ``far`` tells the same of c, (1, 1) of a parallelogram. The
    quadratic equation for t is solved in the form that has no cancellation. Source: Heckbert,
    Fundamentals of Texture Mapping and Image Warping, 1989, section 2.
    """
    place, far = floats(place, far)
    p, q = place[..., 0], place[..., 1]
    a, b = far[..., 0] - 1.0, far[..., 1] - 1.0
    linear = 1.0 + b * p - a * q
    root = np.sqrt(np.maximum(linear * linear + 4.0 * a * q, 0.0))
    t = 2.0 * q / (linear + root)
    return np.stack([p / (1.0 + a * t), t], axis=-1)
