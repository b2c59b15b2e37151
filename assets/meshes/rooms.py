"""Makes the rooms of the setups on radiosity, and the blocks that stand in them.

    python assets/meshes/rooms.py

All are made of cells between planes: a wall is where an empty cell ends. So faces meet corner to
corner, and a room without a hole is closed. Walls look into the room, blocks outwards.
"""

from itertools import product
from pathlib import Path

import numpy as np

BOX = (-1, 1), (0, 2), (-1, 1)
# Two rooms of 4 by 4 with a wall of 0.2 between them, and in it a doorway 1 wide and 2 high
TWO_ROOMS = (-4.1, -0.1, 0.1, 4.1), (0, 2, 2.6), (-2, -0.5, 0.5, 2)


def faces(planes, empty):
    """The quads around the empty cells of a lattice, looking into them, and where they look."""
    for cell in sorted(empty):
        low = [planes[k][cell[k]] for k in range(3)]
        high = [planes[k][cell[k] + 1] for k in range(3)]
        for axis, side in product(range(3), (-1, 1)):
            beyond = tuple(c + side * (k == axis) for k, c in enumerate(cell))
            if beyond in empty:
                continue
            u, v = (axis + 1) % 3, (axis + 2) % 3
            corners = []
            for at_u, at_v in ((0, 0), (1, 0), (1, 1), (0, 1)):
                corner = [0.0, 0.0, 0.0]
                corner[axis] = high[axis] if side > 0 else low[axis]
                corner[u], corner[v] = (low, high)[at_u][u], (low, high)[at_v][v]
                corners.append(corner)
            inward = [0, 0, 0]
            inward[axis] = -side
            yield (corners if side < 0 else corners[::-1]), inward


def outwards(found):
    return [(corners[::-1], [-x for x in normal]) for corners, normal in found]


def obj(found, title):
    lines = [f"# {title}: made by rooms.py"]
    for number, (corners, normal) in enumerate(found):
        lines += ["v " + " ".join(f"{x:g}" for x in corner) for corner in corners]
        lines.append("vn " + " ".join(f"{x:g}" for x in normal))
        lines.append("f " + " ".join(f"{4 * number + k}//{number + 1}" for k in (1, 2, 3, 4)))
    return "\n".join(lines) + "\n"


def meshes():
    """The text of each file, by name."""
    room = list(faces(BOX, {(0, 0, 0)}))
    above = [face for face in room if face[1] != [0, 1, 0]]
    rooms = {(x, y, z) for x, y, z in np.ndindex(3, 2, 3) if x != 1 or (y, z) == (0, 1)}
    two = list(faces(TWO_ROOMS, rooms))
    floor = [face for face in two if face[1] == [0, 1, 0]]
    rest = [face for face in two if face[1] != [0, 1, 0]]
    right = [face for face in rest if np.mean(face[0], axis=0)[0] > 0.1 - 1e-9]
    return {
        "room.obj": obj(room, "a closed room"),
        "room_above_floor.obj": obj(above, "four walls and a ceiling"),
        "block.obj": obj(outwards(above), "a block without its bottom"),
        "column.obj": obj(outwards([x for x in above if x[1] != [0, -1, 0]]), "only its sides"),
        "two_rooms_floor.obj": obj(floor, "the floor of both rooms and of the doorway"),
        "two_rooms_left.obj": obj([face for face in rest if face not in right], "the left room"),
        "two_rooms_right.obj": obj(right, "the right room"),
    }


if __name__ == "__main__":
    for name, text in meshes().items():
        Path(__file__).with_name(name).write_text(text)
