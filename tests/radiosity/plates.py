"""Patches made by hand: plates, a closed box, a box with blocks in it."""

import numpy as np

from playground.render.radiosity.patch.patches import Parents, Patches


def patches_of(corners, grid):
    """Parents (M, 4, 3), each cut evenly into its ``grid`` (m, n); no texture, grey."""
    corners = np.asarray(corners, dtype=np.float64)
    grid = np.asarray(grid, dtype=np.int32)
    pieces, parent, first = [], [], []
    for number, (piece, (m, n)) in enumerate(zip(corners, grid, strict=True)):
        cut = cut_triangle(piece, m) if (piece[2] == piece[3]).all() else cut_quad(piece, m, n)
        first.append(sum(map(len, pieces)))
        pieces.append(cut)
        parent.append(np.full(len(cut), number, dtype=np.int32))
    polygon = np.concatenate(pieces)
    count = len(polygon)
    index = np.arange(4 * count, dtype=np.int32).reshape(count, 4)
    triangle = (polygon[:, 2] == polygon[:, 3]).all(axis=-1)
    index[triangle, 3] = index[triangle, 2]
    across = np.cross(polygon[:, 2] - polygon[:, 0], polygon[:, 3] - polygon[:, 1])
    normal = across / np.linalg.norm(across, axis=-1, keepdims=True)
    parents = Parents(
        corners, grid, np.array(first, dtype=np.int32), np.ones(len(corners), dtype=bool)
    )
    return Patches(
        origin=np.zeros(3),
        points=polygon.reshape(-1, 3),
        normals=np.repeat(normal, 4, axis=0),
        texcoords=None,
        corners=index,
        owner=np.concatenate(parent),
        parent=np.concatenate(parent),
        reflectance=np.full((count, 3), 0.5),
        emission=np.zeros((count, 3)),
        parents=parents,
    )


def cut_quad(corners, m, n):
    """The m · n pieces of a parallelogram, column by column, (m n, 4, 3)."""
    origin, across, along = corners[0], corners[1] - corners[0], corners[3] - corners[0]
    a, b = (x.ravel()[:, None] for x in np.meshgrid(np.arange(m), np.arange(n), indexing="ij"))
    start = origin + across * a / m + along * b / n
    return np.stack(
        [start, start + across / m, start + across / m + along / n, start + along / n], axis=1
    )


def cut_triangle(corners, m):
    """The m² pieces of a triangle as `Parents` numbers them, (m², 4, 3)."""
    a, across, along = corners[0], (corners[1] - corners[0]) / m, (corners[2] - corners[0]) / m
    pieces = []
    for column in range(m):
        for row in range(m - column):
            at = a + across * column + along * row
            pieces.append([at, at + across, at + along, at + along])
            if column + row < m - 1:
                far = at + across + along
                pieces.append([at + across, far, at + along, at + along])
    return np.array(pieces)


def rectangle(origin, across, along):
    """Corners (4, 3); the front is where across × along points."""
    origin, across, along = (np.asarray(x, dtype=np.float64) for x in (origin, across, along))
    return np.array([origin, origin + across, origin + across + along, origin + along])


BELOW = rectangle((0, 0, 0), (1, 0, 0), (0, 1, 0))  # faces +z


def facing_plates(m=1, distance=1.0):
    """Two unit squares that face each other."""
    above = rectangle((0, 0, distance), (0, 1, 0), (1, 0, 0))
    return patches_of([BELOW, above], [(m, m)] * 2)


def adjacent_plates(m=1):
    """Two unit squares with a common edge and a right angle between them."""
    return patches_of([BELOW, rectangle((0, 0, 0), (0, 1, 0), (0, 0, 1))], [(m, m)] * 2)


WALLS = [
    rectangle((-1, -1, -1), (0, 0, 2), (2, 0, 0)),
    rectangle((-1, 1, -1), (2, 0, 0), (0, 0, 2)),
    rectangle((-1, -1, -1), (0, 2, 0), (0, 0, 2)),
    rectangle((1, -1, -1), (0, 0, 2), (0, 2, 0)),
    rectangle((-1, -1, -1), (2, 0, 0), (0, 2, 0)),
    rectangle((-1, -1, 1), (0, 2, 0), (2, 0, 0)),
]


def cube(m):
    """The cube [−1, 1]³ seen from within, each wall cut into m × m patches."""
    return patches_of(WALLS, [(m, m)] * 6)


def block(x, z, height, half, angle):
    """The six faces of a block that floats just above the floor, fronts outside."""
    c, s = half * np.cos(angle), half * np.sin(angle)
    u, v, up = np.array([c, 0, s]), np.array([-s, 0, c]), np.array([0, height, 0])
    low = np.array([x, -0.9, z])
    faces = [
        rectangle(low - u - v + up, 2 * v, 2 * u),
        rectangle(low - u - v, 2 * u, 2 * v),
    ]
    for out, side in ((u, v), (v, -u), (-u, -v), (-v, u)):
        a, b = 2 * side, up
        if np.dot(np.cross(a, b), out) < 0.0:
            a, b = b, a
        faces.append(rectangle(low + out - side, a, b))
    return faces


def room(m, k):
    """The cube with two blocks in it; walls m × m, faces of blocks k × k."""
    inside = block(-0.4, -0.35, 1.2, 0.3, 0.3) + block(0.35, 0.3, 0.6, 0.3, -0.3)
    return patches_of(WALLS + inside, [(m, m)] * 6 + [(k, k)] * 12)
