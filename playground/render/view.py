"""What depends on the camera: everything is seen relative to the eye.

Positions become (world − eye) times a power of two that makes the scene about 1 in size,
subtracted and scaled in float64: a scene a million units from the origin, or a millionth
of a unit in size, is the same to both renderers.
Source: Cozzi & Ring, 3D Engine Design for Virtual Globes, 2011, chapter 5 (relative to eye).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import frexp, radians, tan

import numpy as np
from numpy.typing import ArrayLike, NDArray

from playground.render.projection import clip_matrix, fit_depth, vertical_angle, view_rotation
from playground.render.reach import within_reach
from playground.render.surface import Surface
from playground.scene.camera import Camera

Array = NDArray[np.float64]
FARTHEST = 1e12  # scene sizes: from there light arrives parallel, to 40 bits


@dataclass(frozen=True, eq=False)
class View:
    """A camera for a picture of a given shape, fitted to the surfaces it sees."""

    eye: Array  # (3,), world
    scale: float  # one unit of the world in units of eye-relative space; a power of two
    near: float  # world units
    far: float
    fov: float  # degrees, vertical for this picture
    clip_from_eye: Array  # (4, 4): from eye-relative positions to clip space
    camera_from_world: Array  # (3, 3): from world axes to x right, y up, z towards the viewer

    def relative(self, points: ArrayLike) -> Array:
        """World points (..., 3) relative to the eye, scaled."""
        return np.asarray(np.subtract(points, self.eye, dtype=np.float64) * self.scale)

    def world(self, points: ArrayLike) -> Array:
        """World points (..., 3), the inverse of `relative`."""
        return np.asarray(np.asarray(points, dtype=np.float64) / self.scale + self.eye)

    def eye_from_object(self, surface: Surface) -> Array:
        """The matrix (4, 4) from the positions of a mesh to eye-relative ones."""
        matrix = np.eye(4)
        matrix[:3, :3] = surface.linear * self.scale
        matrix[:3, 3] = self.relative(surface.origin)
        return matrix

    def eye_in(self, surface: Surface) -> Array:
        """Where the eye stands in the space of a mesh whose matrix can be inverted, (3,)."""
        return np.asarray(np.linalg.solve(surface.linear, self.eye - surface.origin))

    def window(self, points: ArrayLike, size: tuple[int, int]) -> tuple[Array, Array]:
        """Where world points (..., 3) appear: pixels (..., 2) from the top left, and depth (...).

        Depth runs from 0 at the near to 1 at the far plane; points behind the eye have
        a depth of infinity and no place (NaN).
        """
        relative = self.relative(points)
        clip = relative @ self.clip_from_eye[:, :3].T + self.clip_from_eye[:, 3]
        w = clip[..., 3:]
        ahead = w > 0.0
        ndc = np.where(ahead, clip[..., :3], np.nan) / np.where(ahead, w, 1.0)
        pixels = (ndc[..., :2] * (1.0, -1.0) + 1.0) / 2.0 * np.array(size)
        depth = np.where(ahead[..., 0], (ndc[..., 2] + 1.0) / 2.0, np.inf)
        return np.asarray(pixels), np.asarray(depth)

    def pixel(self, height: int) -> float:
        """The side of a pixel at distance 1, for a picture of ``height`` rows."""
        return 2.0 * tan(radians(self.fov) / 2.0) / height

    def attenuation(self, k: tuple[float, float, float]) -> tuple[float, float, float]:
        """Attenuation factors for distances measured in eye-relative units."""
        return k[0], k[1] / self.scale, k[2] / self.scale**2

    def two_sided(self, surface: Surface) -> bool:
        """Whether its inside may be seen: it is open, or the near plane may cut into it."""
        if surface.emitter is not None:
            return False
        centre, radius = surface.ball
        depth = -float(self.camera_from_world[2] @ (centre - self.eye))
        return depth - radius <= self.near or not surface.mesh.cullable

    def light_place(
        self, position: Array, k: tuple[float, float, float], farthest: float = FARTHEST
    ) -> tuple[Array, tuple[float, float, float]]:
        """A light relative to the eye (3,), and its attenuation for distances there.

        A light farther than ``farthest`` is moved there along its direction, and the
        factors make up for it: no shader could tell, and no float32 square overflows.
        """
        relative = self.relative(position)
        factor = max(float(np.max(np.abs(relative))) / farthest, 1.0)
        constant, linear, quadratic = self.attenuation(k)
        return relative / factor, (constant, linear * factor, quadratic * factor**2)

    def corners(self, points: Array) -> Array:
        """The corners (K, 3) of an area light relative to the eye, `within_reach` of a shader."""
        return within_reach(self.relative(points))


def view_of(camera: Camera, surfaces: tuple[Surface, ...], size: tuple[int, int]) -> View:
    """The view of ``camera`` for a picture of ``size`` (width, height) in pixels."""
    near, far = fit_depth(camera, [surface.ball for surface in surfaces])
    scale = 2.0 ** -frexp(far)[1]
    clip = clip_matrix(camera, size[0] / size[1], near * scale, far * scale)
    fov = vertical_angle(camera, size[0] / size[1])
    return View(np.array(camera.eye), scale, near, far, fov, clip, view_rotation(camera))
