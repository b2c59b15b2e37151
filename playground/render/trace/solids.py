"""What rays meet: every object and every face of a light, in the space relative to the eye.

A ray is carried into the space of the object by the inverse matrix, its direction not made
unit length, so that t is the same in both. Two kinds of geometry: shapes with a formula
(`playground.render.trace.analytic`), and meshes with a tree of boxes. An object that is
flattened has no inverse: its tree is built in the space of the eye instead.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from playground.render.surface import Surface
from playground.render.trace import analytic, walk
from playground.render.trace.bvh import Bvh
from playground.scene.material import Material
from playground.shading.floats import Array
from playground.shading.texture import bilinear
from playground.shading.vector import cross, unit

ROUNDINGS = 16.0 * np.finfo(np.float64).eps  # of the two transforms that make a point
SLACK = 1e-9  # a ball is taken this much larger than it is
BLUR = 1e-14  # of a squared distance: more than its rounding


class Walker(Protocol):
    """Who finds the triangles of a tree that rays meet: the module `walk`, or `embree`."""

    def closest(self, bvh: Bvh, origin: Array, direction: Array, limit: Array) -> tuple[Array, ...]:
        """See `walk.closest`."""
        ...

    def blocked(self, bvh: Bvh, origin: Array, direction: Array, limit: Array) -> NDArray[np.bool_]:
        """See `walk.blocked`."""
        ...


class Points(NamedTuple):
    """Where rays met one solid: (N, 3) each, and ``error`` (N,), a bound on the distance to it.

    ``normal`` is the interpolated, ``outward`` the geometric one; both look out of the solid.
    """

    position: Array
    normal: Array
    outward: Array
    texel: Array
    error: Array


@dataclass(frozen=True, eq=False)
class Solid:
    """One thing that rays meet; ``kind`` is mesh or a shape of `analytic`.

    ``matrix`` (3, 3) and ``centre`` (3,) lead from the object to the eye's space, ``inverse`` back;
    ``spread`` (3, 3) bounds by how much going there and back enlarges a rounding. ``absorption`` is
    per unit of the eye's space. ``glow`` are the colours (3,) that its front and its back show
    without any light: emissive and ambient terms, or what an area light emits.
    """

    kind: str
    surface: Surface
    object: int | None  # number in the scene; None for an area light, whose number the surface has
    matrix: Array
    inverse: Array
    spread: Array
    centre: Array
    ball: tuple[Array, float]
    glow: tuple[Array, Array]
    material: Material
    absorption: Array
    closed: bool
    bvh: Bvh | None = None
    walker: Walker = walk

    @property
    def transmissive(self) -> bool:
        """Whether some light goes through."""
        return any(self.material.transmittance)

    def inward(self, origin: Array, direction: Array) -> tuple[Array, Array]:
        """Rays (N, 3) in the space of the object."""
        return (origin - self.centre) @ self.inverse.T, direction @ self.inverse.T

    def near(self, origin: Array, direction: Array, limit: Array) -> NDArray[np.intp] | slice:
        """Which rays (N, 3), of unit direction, come near: all that may meet it before ``limit``.

        A cheap first test by the ball around it; it errs towards yes.
        """
        middle, radius = self.ball
        seen = middle - origin
        ahead = np.einsum("ni,ni->n", seen, direction)
        squared = np.einsum("ni,ni->n", seen, seen)
        larger = radius * radius * (1.0 + SLACK) + BLUR * squared
        passing = squared - ahead * ahead <= larger
        passing &= (ahead > 0.0) | (squared <= larger)
        passing &= ahead * (1.0 - SLACK) - radius < limit
        return slice(None) if passing.all() else np.flatnonzero(passing)

    def meet(self, origin: Array, direction: Array, limit: Array) -> tuple[Array, ...]:
        """First t (N,) before ``limit``, or `NO_HIT`; of a mesh also triangles and weights."""
        inner = self.inward(origin, direction)
        if self.bvh is None:
            return (analytic.meeting(self.kind, *inner),)
        return self.walker.closest(self.bvh, *inner, limit)

    def blocks(self, origin: Array, direction: Array, limit: Array) -> NDArray[np.bool_]:
        """Whether it stands in the way before ``limit``, (N,)."""
        inner = self.inward(origin, direction)
        if self.bvh is not None:
            return self.walker.blocked(self.bvh, *inner, limit)
        t = analytic.meeting(self.kind, *inner)
        return np.asarray((t > 0.0) & (t < limit))

    def points(
        self, origin: Array, direction: Array, t: Array, triangle: Array, weights: Array
    ) -> Points:
        """Where rays (N, 3) meet it at ``t`` (N,), with what `meet` told of a mesh."""
        if self.bvh is None:
            inner = self.inward(origin, direction)
            local = analytic.on_surface(self.kind, *inner, t)
            numbers = np.abs(local)
            normal = outward = self._turned(analytic.normal(self.kind, local))
        else:
            corners = self.surface.mesh.faces[triangle]
            places = self.surface.mesh.positions[corners]
            local, numbers = _mix(weights, places), np.abs(places).max(axis=1)
            normal = self._mixed_normals(corners, weights)
            outward = self._face_normals(corners)
        texel = np.ones((1, 3))
        if self.surface.texels is not None:
            texel = bilinear(self.surface.texels, self._texcoords(local, triangle, weights))
        size = np.abs(self.centre) + numbers @ self.spread.T  # of what the point is summed from
        position = local @ self.matrix.T + self.centre
        return Points(position, normal, outward, texel, ROUNDINGS * size.max(axis=1))

    def _turned(self, normals: Array) -> Array:
        return unit(normals @ self.surface.normal_from_object.T)

    def _mixed_normals(self, corners: Array, weights: Array) -> Array:
        """Interpolated as the rasteriser does, where stretched after transforming them."""
        normals = self.surface.mesh.normals[corners]
        if self.surface.stretched:
            return unit(_mix(weights, self._turned(normals)))
        return self._turned(_mix(weights, normals))

    def _face_normals(self, corners: Array) -> Array:
        a, b, c = np.moveaxis(self.surface.mesh.positions[corners].astype(np.float64), 1, 0)
        across = cross((b - a) @ self.matrix.T, (c - a) @ self.matrix.T)
        return unit(-across if self.surface.mirrored else across)

    def _texcoords(self, local: Array, triangle: Array, weights: Array) -> Array:
        if self.bvh is None:
            return analytic.texcoord(self.kind, local)
        mesh = self.surface.mesh
        assert mesh.texcoords is not None
        return _mix(weights, mesh.texcoords[mesh.faces[triangle]])


def _mix(weights: Array, attribute: Array) -> Array:
    """The barycentric mean of (N, 3, K) with weights (N, 3)."""
    return np.asarray(np.einsum("nc,ncx->nx", weights, attribute))
