"""A box with two blocks in it, as patches: the scene in which form factors are timed.

Walls of the cube [−1, 1]³, seen from within, and two turned blocks that float above its floor, so
that no patch is partly covered. Everybody who computes form factors gets the same quads.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from playground.render.radiosity.patch.patches import Parents, Patches
from playground.shading.floats import Array
from playground.shading.vector import cross, unit

# Of each block: where it stands (x, z), its height, half of its width, and by what it is turned.
BLOCKS = (((-0.4, -0.35), 1.2, 0.3, 0.3), ((0.35, 0.3), 0.6, 0.3, -0.3))
BOTTOM = -0.9
DIVISIONS = {594: (9, 3), 2376: (18, 6)}  # patches: parts of an edge of a wall and of a block
GREY = 0.5


def blocks_box(patches: int) -> Patches:
    """The box with blocks in 594 or 2,376 patches."""
    walls, faces = DIVISIONS[patches]
    corners = np.concatenate([_walls(), *(_block(*block) for block in BLOCKS)])
    return _divided(corners, np.array([walls] * 6 + [faces] * (len(corners) - 6)))


def empty_box(parts: int) -> Patches:
    """The box without blocks, each wall in ``parts`` × ``parts`` patches."""
    return _divided(_walls(), np.full(6, parts))


def _walls() -> Array:
    """The six walls, (6, 4, 3), fronts inside."""
    walls = []
    for axis in range(3):
        for side in (-1.0, 1.0):
            across, along = np.roll(np.eye(3), -axis, axis=0)[1:]  # across × along = the axis
            if side > 0.0:
                across, along = along, across
            middle = side * np.eye(3)[axis]
            walls.append(_quad(middle, across, along))
    return np.array(walls)


def _block(place: tuple[float, float], height: float, half: float, angle: float) -> Array:
    """The six faces of a block, (6, 4, 3), fronts outside."""
    c, s = half * np.cos(angle), half * np.sin(angle)
    u, v, up = np.array([c, 0.0, s]), np.array([-s, 0.0, c]), np.array([0.0, 0.5 * height, 0.0])
    middle = np.array([place[0], BOTTOM, place[1]]) + up
    faces = [_quad(middle + up, v, u), _quad(middle - up, u, v)]
    for out, side in ((u, v), (v, -u), (-u, -v), (-v, u)):
        faces.append(_quad(middle + out, up, side))
    return np.array(faces)


def _quad(middle: Array, across: Array, along: Array) -> Array:
    """The corners (4, 3) of a rectangle; its front is where across × along points."""
    a, b = across, along
    return np.array([middle - a - b, middle + a - b, middle + a + b, middle - a + b])


def _divided(corners: Array, parts: NDArray[np.int_]) -> Patches:
    """Rectangles (M, 4, 3) cut into ``parts`` × ``parts`` grey patches with their own corners."""
    polygon = np.concatenate([_pieces(quad, m) for quad, m in zip(corners, parts, strict=True)])
    count, size = parts * parts, len(polygon)
    parent = np.repeat(np.arange(len(corners), dtype=np.int32), count)
    first = np.concatenate([[0], np.cumsum(count)[:-1]]).astype(np.int32)
    grid = np.stack([parts, parts], axis=1).astype(np.int32)
    regular = np.ones(len(corners), dtype=np.bool_)
    normal = unit(cross(polygon[:, 1] - polygon[:, 0], polygon[:, 3] - polygon[:, 0]))
    return Patches(
        origin=np.zeros(3),
        points=polygon.reshape(-1, 3),
        normals=np.repeat(normal, 4, axis=0),
        texcoords=None,
        corners=np.arange(4 * size, dtype=np.int32).reshape(-1, 4),
        owner=parent,
        parent=parent,
        reflectance=np.full((size, 3), GREY),
        emission=np.zeros((size, 3)),
        parents=Parents(corners, grid, first, regular),
    )


def _pieces(quad: Array, parts: int) -> Array:
    """The pieces of a rectangle (4, 3), column by column as `Parents` has them, (parts², 4, 3)."""
    across, along = (quad[1] - quad[0]) / parts, (quad[3] - quad[0]) / parts
    a, b = (x.ravel()[:, None] for x in np.indices((parts, parts)))
    low = quad[0] + a * across + b * along
    return np.stack([low, low + across, low + across + along, low + along], axis=1)
