"""The meshes of a traced scene as textures: their trees, corners, normals, texture coordinates."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from playground.render.gl.trace.bvh_texels import BvhTexels, Tree, bvh_texels
from playground.render.gl.trace.layout import flattened
from playground.render.trace.bvh import Bvh
from playground.render.trace.solids import Solid
from playground.scene.mesh import Mesh
from playground.shading.vector import unit

Singles = NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class Trees:
    """What ``shaders/trace/mesh.glsl`` reads; instances of a mesh share one tree.

    ``corners`` and ``normals`` (H, 4096, 4) hold three texels per slot: what the name says, and
    the texture coordinate u or v.
    """

    texels: BvhTexels
    corners: Singles
    normals: Singles
    tree: dict[Bvh, Tree]


def trees_of(solids: Sequence[Solid]) -> Trees | None:
    """The trees of these solids; None if none of them is a mesh."""
    found: dict[Bvh, tuple[Mesh, bytes]] = {}
    for solid in solids:
        if solid.bvh is not None:
            turn = solid.surface.normal_from_object if flattened(solid) else np.eye(3)
            found.setdefault(solid.bvh, (solid.surface.mesh, turn.tobytes()))
    if not found:
        return None
    return _trees(tuple((bvh, *rest) for bvh, rest in found.items()))


@lru_cache(maxsize=4)
def _trees(meshes: tuple[tuple[Bvh, Mesh, bytes], ...]) -> Trees:
    texels = bvh_texels([bvh for bvh, _, _ in meshes])
    corners, normals = texels.corners.copy(), np.zeros_like(texels.corners)
    rows = [_attributes(*mesh) for mesh in meshes]
    attributes = np.concatenate(rows)
    flat_corners, flat_normals = corners.reshape(-1, 4), normals.reshape(-1, 4)
    flat_normals[: len(attributes), :3] = attributes[:, :3]
    flat_corners[: len(attributes), 3] = attributes[:, 3]
    flat_normals[: len(attributes), 3] = attributes[:, 4]
    tree = {bvh: tree for (bvh, _, _), tree in zip(meshes, texels.trees, strict=True)}
    return Trees(texels, corners, normals, tree)


def _attributes(bvh: Bvh, mesh: Mesh, turn: bytes) -> NDArray[Any]:
    """Normal, u and v of the corners in the order of the tree's slots, (3 F, 5)."""
    corner = mesh.faces[bvh.order].reshape(-1)
    normals = unit(mesh.normals[corner] @ np.frombuffer(turn).reshape(3, 3).T)
    texcoords = np.zeros((len(corner), 2))
    if mesh.texcoords is not None:
        texcoords = mesh.texcoords[corner].astype(np.float64)
    return np.concatenate([normals, texcoords], axis=1)
