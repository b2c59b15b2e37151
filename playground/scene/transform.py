"""Where an object stands in the scene: translate · rotate · scale."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import cos, radians, sin

import numpy as np
from numpy.typing import NDArray

from playground.scene.knob import Declared, number, vector


@dataclass(frozen=True)
class Transform(Declared):
    """First scale, then rotate about x, y and z in this order, then translate.

    Negative scale mirrors; unequal scale stretches. Both are allowed, and the
    normals follow (see `playground.shading.vector.normal_matrix`).
    """

    label = "transform"

    translate: tuple[float, float, float] = vector(0.0, 0.0, 0.0, help="moves the object")
    rotate: tuple[float, float, float] = vector(
        0.0, 0.0, 0.0, unit="degrees", help="turns about the x, then y, then z axis"
    )
    scale: tuple[float, float, float] = vector(1.0, 1.0, 1.0, help="stretches along x, y and z")
    size: float = number(1.0, -1e30, 1e30, help="stretches all three directions")

    @cached_property
    def matrix(self) -> NDArray[np.float64]:
        """The matrix of shape (4, 4), float64, acting on column vectors."""
        x, y, z = (radians(angle) for angle in self.rotate)
        about_x = np.array([[1, 0, 0], [0, cos(x), -sin(x)], [0, sin(x), cos(x)]])
        about_y = np.array([[cos(y), 0, sin(y)], [0, 1, 0], [-sin(y), 0, cos(y)]])
        about_z = np.array([[cos(z), -sin(z), 0], [sin(z), cos(z), 0], [0, 0, 1]])
        matrix = np.eye(4)
        matrix[:3, :3] = about_z @ about_y @ about_x @ np.diag(self.scale) * self.size
        matrix[:3, 3] = self.translate
        return matrix
