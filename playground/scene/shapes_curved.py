"""Shapes with round parts: sphere, icosphere, torus, disc, cylinder, cone.

Knows their closed forms; every normal is the exact one of the smooth surface,
evaluated in float64. Must not know the registry.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from playground.scene.mesh import Mesh
from playground.scene.normals import direction
from playground.scene.shapes_lattice import Piece, at_least, circle, join, lattice, steps

Floats = NDArray[np.float64]


def uv_sphere(tessellation: int = 32) -> Mesh:
    """The unit sphere cut along meridians and parallels, with texture coordinates.

    Parameters
    ----------
    tessellation : int
        Segments around the y axis, at least 3; half as many rings from pole to pole.
    """
    at_least(tessellation, 3)
    rings = max(2, tessellation // 2)
    # Half of a circle of 2 * rings segments leads from the north to the south pole
    height, radius = (half[: rings + 1] for half in circle(2 * rings))
    side = revolve(radius, height, radius, height, tessellation)
    return join([side], "sphere")


def torus(tessellation: int = 32, major_radius: float = 0.7, minor_radius: float = 0.3) -> Mesh:
    """A ring about the y axis: (sqrt(x^2 + z^2) - major)^2 + y^2 = minor^2.

    Parameters
    ----------
    tessellation : int
        Segments around the axis, at least 3; half as many (at least 3) around the tube.
    major_radius, minor_radius : float
        Of the ring's centre line and of its tube; 0 < minor < major.
    """
    # Walk the tube from its outer equator downwards, so that rows run down outside
    outward, depth = circle(max(3, tessellation // 2))
    side = revolve(
        major_radius + minor_radius * outward,
        -minor_radius * depth,
        outward,
        -depth,
        tessellation,
    )
    return join([side], "torus")


def disc(tessellation: int = 32) -> Mesh:
    """The unit disc in the plane y = 0, facing +y; its texture is the square around it.

    Parameters
    ----------
    tessellation : int
        Segments around, at least 3; an eighth as many rings.
    """
    top = cap(1.0, tessellation)
    return join([top._replace(positions=top.positions * (1.0, 0.0, 1.0))], "disc")


def cylinder(tessellation: int = 32) -> Mesh:
    """The cylinder of radius 1 from y = -1 to y = 1 with caps and sharp rims.

    Parameters
    ----------
    tessellation : int
        Segments around the axis, at least 3; a quarter as many rows along it.
    """
    rows = max(1, tessellation // 4)
    ones = np.ones(rows + 1)
    side = revolve(ones, -steps(rows), ones, 0.0 * ones, tessellation)
    return join([cap(1.0, tessellation), side, cap(-1.0, tessellation)], "cylinder")


def cone(tessellation: int = 32) -> Mesh:
    """The cone from the apex y = 1 to the base of radius 1 at y = -1, with its cap.

    The normal has no limit at the apex; each segment has its own vertex there, with
    the normal of the segment's middle.

    Parameters
    ----------
    tessellation : int
        Segments around the axis, at least 3; a quarter as many rows along it.
    """
    rows = max(1, tessellation // 4)
    radius = np.arange(rows + 1) / rows
    ones = np.ones(rows + 1)
    # The side falls 2 while it moves out 1, so its normal moves out 2 while it rises 1
    slant = np.sqrt(5.0)
    side = revolve(radius, -steps(rows), ones * (2.0 / slant), ones * (1.0 / slant), tessellation)
    return join([side, cap(-1.0, tessellation)], "cone")


def revolve(
    radius: Floats, height: Floats, normal_radius: Floats, normal_height: Floats, segments: int
) -> Piece:
    """Turn a profile about the y axis.

    Parameters
    ----------
    radius, height : float64 arrays of shape (R,)
        The profile, walked with the outside on its left when radius points right and
        height up (downwards along an outer wall). A first or last radius of 0 is a pole.
    normal_radius, normal_height : float64 arrays of shape (R,)
        Its unit normal in the same two directions.
    segments : int
        Steps around the axis, at least 3; counter-clockwise seen from above.

    A pole has a vertex per segment, with the normal and u of the segment's middle.
    Texture coordinates: u once around, v from 0 at the last row to 1 at the first.
    """
    rows = len(radius) - 1
    cosine, sine = circle(segments)
    turn = np.tile(np.arange(segments + 1) / segments, (rows + 1, 1))
    around = np.tile(np.stack([cosine, sine]), (rows + 1, 1, 1))
    poles = radius == 0.0
    middle = 2.0 * np.pi * (np.arange(segments + 1) + 0.5) / segments
    around[poles] = np.stack([np.cos(middle), np.sin(middle)])
    turn[poles] = np.minimum(turn[poles] + 0.5 / segments, 1.0)

    def turned(outward: Floats, up: Floats) -> Floats:
        x, minus_z = (outward[:, None] * around[:, k] for k in range(2))
        rising = np.broadcast_to(up[:, None], x.shape)
        return np.stack([x, rising, -minus_z], axis=-1).reshape(-1, 3) + 0.0

    down = np.broadcast_to(1.0 - np.arange(rows + 1) / rows, turn.T.shape).T
    return Piece(
        turned(radius, height),
        turned(normal_radius, normal_height),
        np.stack([turn, down], axis=-1).reshape(-1, 2),
        lattice(rows, segments, bool(poles[0]), bool(poles[-1])),
    )


def cap(side: float, segments: int) -> Piece:
    """The unit disc at y = ``side`` (1 faces up, -1 faces down), an eighth as many rings.

    Its texture is the square around the disc, seen from outside with x to the right.
    """
    rings = max(1, segments // 8)
    radius = np.arange(rings + 1) / rings
    radius = radius if side > 0.0 else radius[::-1]
    ones = np.ones(rings + 1)
    disc = revolve(radius, side * ones, 0.0 * ones, side * ones, segments)
    x, z = disc.positions[:, 0], disc.positions[:, 2]
    return disc._replace(texcoords=0.5 + 0.5 * np.stack([x, -side * z], axis=1))


def icosphere(tessellation: int = 8) -> Mesh:
    """The unit sphere by geodesic subdivision of the icosahedron: nearly equal triangles.

    Has no texture coordinates: its triangles follow no meridian where a map could be cut.

    Parameters
    ----------
    tessellation : int
        Frequency f >= 1: parts of each edge of the icosahedron; 20 f^2 triangles.
    """
    at_least(tessellation, 1)
    corners, triangles = _icosahedron()
    weights, cells = _subdivided_triangle(tessellation)

    # Mix the corners with whole weights: on a shared edge only two terms are not
    # zero, and a sum of two does not depend on the order, so both sides agree to the bit
    first, second, third = (corners[triangles[:, k]][:, None, :] for k in range(3))
    a, b, c = (weights[None, :, k, None] for k in range(3))
    points = (a * first + b * second + c * third + 0.0).reshape(-1, 3)
    faces = cells[None] + len(weights) * np.arange(len(triangles))[:, None, None]

    shared, place = np.unique(points, axis=0, return_inverse=True)
    unit = direction(shared)
    return Mesh.create(unit, place.reshape(-1)[faces.reshape(-1, 3)], unit, name="icosphere")


def _icosahedron() -> tuple[Floats, NDArray[np.int64]]:
    """Corners (12, 3) and faces (20, 3) of the icosahedron, two corners on the y axis."""
    # Latitude of the rings is atan(1/2); Coxeter, "Regular Polytopes", 3.7
    turn = 2.0 * np.pi * np.arange(5) / 5
    upper = np.stack([2.0 * np.cos(turn), np.ones(5), -2.0 * np.sin(turn)], axis=1)
    lower = -upper
    pole = np.array([[0.0, np.sqrt(5.0), 0.0]])
    corners = np.concatenate([pole, upper, lower, -pole]) / np.sqrt(5.0)

    # The lower corner i + 3 stands half a step after the upper corner i
    i = np.arange(5)
    following, below, before = (i + 1) % 5, (i + 3) % 5, (i + 2) % 5
    north = np.stack([0 * i, 1 + i, 1 + following], axis=1)
    down = np.stack([1 + i, 6 + below, 1 + following], axis=1)
    up = np.stack([1 + i, 6 + before, 6 + below], axis=1)
    south = np.stack([0 * i + 11, 6 + below, 6 + before], axis=1)
    return corners, np.concatenate([north, down, up, south])


def _subdivided_triangle(frequency: int) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Whole barycentric weights (P, 3) that sum to ``frequency``, and the cells (f^2, 3)."""
    row, column = np.tril_indices(frequency + 1)
    weights = np.stack([frequency - row, row - column, column], axis=1)

    # Row r starts at r (r + 1) / 2; below each vertex hang two of the next row
    row, column = np.tril_indices(frequency)
    vertex = row * (row + 1) // 2 + column
    below = vertex + row + 1
    pointing_up = np.stack([vertex, below, below + 1], axis=1)
    inner = column < row
    pointing_down = np.stack([vertex, below + 1, vertex + 1], axis=1)[inner]
    return weights, np.concatenate([pointing_up, pointing_down])
