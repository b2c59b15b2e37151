"""Normals of triangles and of vertices, robust at every scale.

Knows positions and faces. Must not know how a mesh was made or how it is drawn.
Everything is computed in float64 from edges that are first divided by their own
largest component, so nothing over- or underflows, whatever unit the model uses.
"""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from playground.scene.mesh import Mesh

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

# Rounding of a float64 cross product of two directions of size about 1 is a few eps;
# a sine below this says that the three corners lie on one line.
COLLINEAR_SINE = 8 * float(np.finfo(np.float64).eps)


def direction(vectors: Floats) -> Floats:
    """Unit vectors of shape (..., 3); a zero vector stays zero.

    Parameters
    ----------
    vectors : float64 array of shape (..., 3), finite
        Of any length: the largest component is divided out before squaring.
    """
    largest = _largest(vectors)
    scaled = vectors / np.where(largest > 0.0, largest, 1.0)[..., None]
    length = np.sqrt(np.einsum("...i,...i->...", scaled, scaled))
    scaled /= np.where(length > 0.0, length, 1.0)[..., None]
    return scaled


def _largest(vectors: Floats) -> Floats:
    """The largest absolute component (three slices: a reduction over 3 entries is slow)."""
    x, y, z = np.moveaxis(np.abs(vectors), -1, 0)
    largest: Floats = np.maximum(np.maximum(x, y), z)
    return largest


def cross(a: Floats, b: Floats) -> Floats:
    """The product a x b over the last axis, at a third of the time of np.cross."""
    result = np.empty_like(a)
    for k in range(3):
        after, last = (k + 1) % 3, (k + 2) % 3
        result[..., k] = a[..., after] * b[..., last] - a[..., last] * b[..., after]
    return result


def face_normals(positions: NDArray[Any], faces: NDArray[Any]) -> Floats:
    """Unit normals of triangles, counter-clockwise seen from their tip.

    The two shorter edges are crossed, because their angle is the one that rounding
    disturbs least.

    Parameters
    ----------
    positions : float array of shape (N, 3)
    faces : integer array of shape (M, 3)

    Returns
    -------
    float64 array of shape (M, 3)
        A triangle without area has the normal (0, 0, 0).
    """
    # Turn each triangle so that its longest edge comes first
    first, second, third = np.asarray(faces).T
    points = np.asarray(positions, dtype=np.float64)
    edges = np.stack(
        [
            points[second] - points[first],
            points[third] - points[second],
            points[first] - points[third],
        ]
    )
    longest = _largest(edges).argmax(axis=0)
    rows = np.arange(len(longest))
    incoming = direction(edges[(longest + 1) % 3, rows])
    outgoing = direction(edges[(longest + 2) % 3, rows])

    # Drop what is mere rounding of parallel edges
    normal = cross(incoming, outgoing)
    normal[_largest(normal) <= COLLINEAR_SINE] = 0.0
    return direction(normal)


def corner_angles(positions: NDArray[Any], faces: NDArray[Any]) -> Floats:
    """The inner angles of triangles in radians, shape (M, 3).

    atan2(|a x b|, a . b) keeps all digits near 0 and near pi, where acos loses half.
    """
    first, second, third = (np.asarray(positions, dtype=np.float64)[c] for c in np.asarray(faces).T)
    sides = [direction(second - first), direction(third - second), direction(first - third)]
    angles = np.empty((len(first), 3))
    for corner in range(3):
        outgoing, incoming = sides[corner], sides[corner - 1]
        turn = cross(incoming, outgoing)
        sine = np.sqrt(np.einsum("mi,mi->m", turn, turn))
        angles[:, corner] = np.arctan2(sine, -np.einsum("mi,mi->m", incoming, outgoing))
    return angles


def weld(positions: NDArray[Any]) -> Integers:
    """For each vertex the number of its place: equal positions, equal numbers.

    Parameters
    ----------
    positions : float array of shape (N, 3), finite
        Compared exactly, as float32 (0.0 and -0.0 are one place).

    Returns
    -------
    int64 array of shape (N,)
        Numbers from 0 to the number of places minus 1.
    """
    with np.errstate(over="ignore", under="ignore"):
        single = np.asarray(positions, dtype=np.float32) + np.float32(0.0)
    bits = single.view(np.uint32).astype(np.uint64)
    shift = np.uint64(32)
    # Pair x with y, then the number of that pair with z: two sorts of plain integers
    column = np.unique((bits[:, 0] << shift) | bits[:, 1], return_inverse=True)[1]
    place = np.unique((column.astype(np.uint64) << shift) | bits[:, 2], return_inverse=True)[1]
    return place.astype(np.int64, copy=False)


def angle_weighted_normals(
    positions: NDArray[Any], faces: NDArray[Any], weld_positions: bool = False
) -> Floats:
    """Vertex normals: the face normals around a vertex, weighted by their angle there.

    n = sum_i alpha_i n_i / |sum_i alpha_i n_i|, which, unlike area weights, does not
    depend on how the surface happens to be cut into triangles.

    Thuermer & Wuethrich, "Computing vertex normals from polygonal facets", JGT 3(1), 1998.

    Parameters
    ----------
    positions, faces : arrays of shape (N, 3) and (M, 3)
    weld_positions : bool
        Let all vertices at the same position share one normal.

    Returns
    -------
    float64 array of shape (N, 3), unit
        Where the faces cancel each other (both sides of a sheet), one of them decides;
        a vertex without faces has (0, 0, 1).
    """
    count = len(positions)
    place = weld(positions) if weld_positions else np.arange(count)
    normals = face_normals(positions, faces)
    angles = corner_angles(positions, faces)

    # Sum alpha * n over the corners that meet at each place
    corner_places = place[faces].ravel()
    total = np.empty((count, 3))
    for k in range(3):
        weighted = angles * normals[:, k, None]
        total[:, k] = np.bincount(corner_places, weighted.ravel(), count)
    weight = np.bincount(corner_places, angles.ravel(), count)

    # Let one face decide where the sum is nothing but rounding
    cancelled = _largest(total) <= 1e-12 * weight
    total = np.where(cancelled[:, None], _any_normal(normals, place[faces], count), total)
    unit: Floats = direction(total)[place]
    return unit


def _any_normal(normals: Floats, places: Integers, count: int) -> Floats:
    """For each of ``count`` places the normal of one face there, (0, 0, 1) without any."""
    chosen = np.tile([0.0, 0.0, 1.0], (count, 1))
    solid = np.any(normals != 0.0, axis=1)
    chosen[places[solid].ravel()] = np.repeat(normals[solid], 3, axis=0)
    return chosen


def flat(mesh: Mesh) -> Mesh:
    """The same surface with vertices split so that each triangle carries its own normal."""
    corners = mesh.faces.ravel()
    return type(mesh).create(
        mesh.positions[corners],
        np.arange(len(corners)).reshape(-1, 3),
        normals=np.repeat(mesh.triangle_normals, 3, axis=0),
        texcoords=None if mesh.texcoords is None else mesh.texcoords[corners],
        name=mesh.name,
    )


def smooth(mesh: Mesh) -> Mesh:
    """The same vertices and faces with angle-weighted normals over equal positions."""
    normals = angle_weighted_normals(mesh.positions, mesh.faces, weld_positions=True)
    with np.errstate(under="ignore"):
        return dataclasses.replace(mesh, normals=normals.astype(np.float32))
