"""Patches as meshes that show the light arriving at them: smooth, or each of one colour."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from playground.render.radiosity.patch.corner_light import corner_light
from playground.render.radiosity.patch.patches import Patches
from playground.render.stored import StoredLight
from playground.scene.mesh import Mesh
from playground.shading.floats import Array


@dataclass(frozen=True, eq=False)
class DrawnPatches:
    """One mesh for each object of the scene, and what its vertices are among the patches.

    ``flat`` gives every patch corners of its own, with its own normal and light; otherwise
    patches share the corners at which their light is averaged.
    """

    patches: Patches
    flat: bool
    meshes: tuple[Mesh | None, ...]  # None for an object without patches
    vertices: tuple[NDArray[np.intp], ...]  # per mesh: points of the patches, or patches if flat

    def stored(
        self, arriving: Array, direct: Array | None = None, shown: str = "all"
    ) -> tuple[StoredLight | None, ...]:
        """The light arriving at each patch, (N, 3), as it is to be drawn.

        ``shown`` is all of it, or a part, for which ``direct`` (N, 3) is needed. `corner_light`
        keeps within bounds, so parts of its own would not add up: at a corner, indirect light is
        what all light has beyond the direct, which is no more than all.
        """
        light = self._at_corners(arriving)
        if shown != "all":
            assert direct is not None
            straight = np.minimum(self._at_corners(direct), light)
            light = straight if shown == "direct" else light - straight
        return tuple(
            None
            if mesh is None
            else StoredLight(mesh, light=light[chosen], origin=self.patches.origin)
            for mesh, chosen in zip(self.meshes, self.vertices, strict=True)
        )

    def _at_corners(self, arriving: Array) -> NDArray[np.float32]:
        light = arriving if self.flat else corner_light(self.patches, arriving)
        return light.astype(np.float32)


def drawn_patches(patches: Patches, objects: int, flat: bool = False) -> DrawnPatches:
    """The patches of the first ``objects`` owners as meshes; area lights are drawn elsewhere."""
    made = [_mesh(patches, np.flatnonzero(patches.owner == i), flat) for i in range(objects)]
    return DrawnPatches(patches, flat, tuple(m for m, _ in made), tuple(v for _, v in made))


def _mesh(
    patches: Patches, own: NDArray[np.intp], flat: bool
) -> tuple[Mesh | None, NDArray[np.intp]]:
    if len(own) == 0:
        return None, own
    corners = patches.corners[own]
    points, faces = np.unique(corners, return_inverse=True)
    normals, vertices = patches.normals[points], points
    if flat:
        points, vertices = corners.ravel(), np.repeat(own, 4)
        faces, normals = np.arange(len(points)), patches.normal[vertices]
    quads = faces.reshape(-1, 4).astype(np.int32)
    texcoords = None if patches.texcoords is None else patches.texcoords[points]
    triangles = np.concatenate([quads[:, :3], quads[~patches.triangle[own]][:, [0, 2, 3]]])
    mesh = Mesh.create(patches.points[points], triangles, normals, texcoords, "patches")
    return mesh, vertices.astype(np.intp)
