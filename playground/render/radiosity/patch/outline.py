"""The surfaces of a setup before they are divided: welded points, triangles and quads."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from playground.errors import PlaygroundError
from playground.render.radiosity.patch.quads import quads
from playground.scene.light import AreaLight
from playground.scene.normals import direction, weld
from playground.scene.polygon import triangles
from playground.scene.scene import Object
from playground.scene.setup import Setup
from playground.shading.floats import Array
from playground.shading.vector import cross, dot, normal_matrix, orientation

Integers = NDArray[np.int64]

# Components of shading normals and texture coordinates that differ by no more are the same:
# what float32 leaves of directions that were computed in two ways.
SAME = 1e-5
# A triangle thinner than this beside its longest edge has no area to speak of.
SLIVER = 1e-9
FARTHEST = 1e30  # the largest coordinate, as of every knob: squares of areas stay finite
SINGLE = float(np.finfo(np.float32).eps)


@dataclass(frozen=True, eq=False)
class Outline:
    """M triangles and quads over P points; a triangle repeats its last corner."""

    points: Array  # (P, 3), relative to the origin
    normals: Array  # (P, 3)
    texcoords: Array | None  # (P, 2)
    place: Integers  # (P,): equal where points of one object coincide
    corners: Integers  # (M, 4), counter-clockwise from the front
    owner: Integers  # (M,)
    origin: Array  # (3,)
    warnings: tuple[str, ...] = ()


def outline(setup: Setup) -> Outline:
    """The objects and the shining sides of the area lights of ``setup``, in the world.

    Raises
    ------
    PlaygroundError
        A corner is not finite, or nothing has an area.
    """
    origin = _origin(setup)
    sheets, warnings = [], []
    for number, item in enumerate(setup.scene.objects):
        sheet, dropped = _of_object(item, number, origin)
        if dropped:
            warnings.append(_told(item, number, dropped, len(sheet.corners)))
        sheets.append(sheet)
    number = len(sheets)
    for light in setup.scene.lights:
        if isinstance(light, AreaLight):
            sides = (1, -1) if light.two_sided else (1,)
            sheets += [_of_light(light, side, number, origin) for side in sides]
            number += 1
    if not any(len(sheet.corners) for sheet in sheets):
        raise PlaygroundError(
            "radiosity finds no surface to divide into patches",
            got=" ".join(warnings) or "a scene without objects and area lights",
            allowed="at least one triangle with an area",
            fix="Add an object, or mend the scale of the ones that are there.",
        )
    return _together(sheets, origin, tuple(warnings))


def label(item: Object, number: int) -> str:
    """What messages call an object."""
    name = item.arrays.name if item.arrays is not None else item.mesh
    return f"object {number + 1} ({name})" if name else f"object {number + 1}"


def _told(item: Object, number: int, dropped: int, left: int) -> str:
    what = "triangle has" if dropped == 1 else "triangles have"
    rest = "" if left else ", so nothing is left of it"
    return f"{dropped} {what} no area in {label(item, number)} and cannot be patches{rest}."


def _origin(setup: Setup) -> Array:
    """A point of a coarse grid near the scene: (0, 0, 0) unless the scene is far from there."""
    if not setup.scene.objects:
        return np.zeros(3)
    centre, radius = setup.bounds()
    if not (np.isfinite(radius) and np.isfinite(centre).all()):
        return np.zeros(3)  # the object that is not finite will be named
    step = 2.0 ** np.ceil(np.log2(4.0 * radius))
    return np.asarray(np.round(centre / step) * step + 0.0)


def _of_object(item: Object, number: int, origin: Array) -> tuple[Outline, int]:
    """The mesh of an object where it stands, and how many triangles had no area."""
    geometry = item.geometry()
    mesh, matrix = geometry.mesh, item.transform.matrix
    linear = matrix[:3, :3]
    faces = mesh.faces.astype(np.int64)
    with np.errstate(over="ignore", invalid="ignore"):
        local = mesh.positions.astype(np.float64) + geometry.offset
        # One place, one sum: the same bits wherever its vertices stand in the arrays
        world = np.stack([(local * row).sum(axis=1) for row in linear], axis=1)
        world += matrix[:3, 3] - origin
    bad = ~(np.abs(world[faces]) <= FARTHEST).all(axis=(1, 2))  # a NaN is not smaller
    if bad.any():
        raise PlaygroundError(
            f"{label(item, number)} has corners that are no places",
            got=f"{int(bad.sum())} of {len(faces)} triangles, first number {int(bad.argmax())}",
            allowed=f"finite numbers up to {FARTHEST:g}",
            fix="Mend the mesh, or its scale.",
        )
    solid = ~_slivers(world, faces)
    faces = faces[solid]
    place = weld(np.where(np.isfinite(mesh.positions), mesh.positions, 0.0))
    normals = np.nan_to_num(mesh.normals.astype(np.float64))
    look = direction(normals @ normal_matrix(linear).T)
    uv = None if mesh.texcoords is None else np.nan_to_num(mesh.texcoords.astype(np.float64))
    looks = [look] if uv is None else [look, uv]
    keep, point = _shared(place, np.concatenate(looks, axis=1))
    points, faces = world[keep], point[faces]

    # Coordinates were rounded to float32 before they were placed
    largest = float(np.abs(local[mesh.faces]).max(initial=0.0))
    rounding = 4.0 * SINGLE * largest * float(np.linalg.norm(linear, 2)) if solid.any() else 0.0
    corners = quads(points, faces, rounding)
    if orientation(linear) < 0.0:
        corners = _turned(corners)
    return Outline(
        points,
        _with_direction(look[keep], points, corners),
        None if uv is None else uv[keep],
        place[keep],
        corners,
        np.full(len(corners), number),
        origin,
    ), int((~solid).sum())


def _turned(corners: Integers) -> Integers:
    """The same pieces seen from behind, beginning with the same corner."""
    triangle = corners[:, 2] == corners[:, 3]
    return np.where(triangle[:, None], corners[:, [0, 2, 1, 1]], corners[:, [0, 3, 2, 1]])


def _slivers(points: Array, faces: Integers) -> NDArray[np.bool_]:
    """Which triangles have no area: their corners coincide or lie on a line."""
    a, b, c = np.moveaxis(points[faces], 1, 0)
    edges = np.stack([b - a, c - b, a - c])
    size = np.abs(edges).max(axis=(0, 2))
    scaled = edges / np.where(size > 0.0, size, 1.0)[None, :, None]
    longest = dot(scaled, scaled).max(axis=0, initial=0.0)
    height = np.sqrt(dot(*[cross(scaled[0], scaled[1])] * 2))
    return np.asarray(height <= SLIVER * longest)


def _shared(place: Integers, look: Array) -> tuple[Integers, Integers]:
    """One vertex for each different place and look; and for each vertex the number of its own."""
    vertex = np.arange(len(place))
    left = vertex.copy()
    while len(left):
        _, first, number = np.unique(place[left], return_index=True, return_inverse=True)
        same = left[first][number]
        alike = np.abs(look[left] - look[same]).max(axis=1) <= SAME
        vertex[left[alike]] = same[alike]
        left = left[~alike]
    keep, point = np.unique(vertex, return_inverse=True)
    return keep, point


def _with_direction(normals: Array, points: Array, corners: Integers) -> Array:
    """The shading normals, with that of a face where an object is so flat that it has none."""
    missing = np.flatnonzero(~normals.any(axis=1))
    if len(missing) == 0 or len(corners) == 0:
        return normals
    polygon = points[corners]
    face = direction(cross(polygon[:, 2] - polygon[:, 0], polygon[:, 3] - polygon[:, 1]))
    chosen = np.zeros_like(normals)
    for column in range(4):
        chosen[corners[:, column]] = face
    normals[missing] = chosen[missing]
    return normals


def _of_light(light: AreaLight, side: int, number: int, origin: Array) -> Outline:
    """One side of an area light; its front is counter-clockwise."""
    points = np.array(light.corners) - origin
    faces = triangles(points, np.array([len(points)]))
    faces = faces[~_slivers(points, faces)]
    corners = quads(points, faces, 1e-5 * float(np.ptp(points, axis=0).max()))
    normal = direction(cross(points - points[0], np.roll(points, -1, axis=0) - points[0]).sum(0))
    place = np.unique(points, axis=0, return_inverse=True)[1]
    normals = np.tile(side * normal, (len(points), 1))
    corners = corners if side > 0 else _turned(corners)
    owner = np.full(len(corners), number)
    return Outline(points, normals, None, place.reshape(-1), corners, owner, origin)


def _together(sheets: list[Outline], origin: Array, warnings: tuple[str, ...]) -> Outline:
    """All sheets in one, without the points that no piece uses."""
    sizes = [len(sheet.points) for sheet in sheets]
    starts = np.cumsum([0, *sizes[:-1]])
    corners = np.concatenate([s.corners + start for s, start in zip(sheets, starts, strict=True)])
    used, renumbered = np.unique(corners, return_inverse=True)
    textured = any(sheet.texcoords is not None for sheet in sheets)
    none = [np.zeros((n, 2)) for n in sizes]
    flat = [none[i] if s.texcoords is None else s.texcoords for i, s in enumerate(sheets)]
    places = np.cumsum([0] + [int(s.place.max(initial=-1)) + 1 for s in sheets[:-1]])
    place = np.concatenate([s.place + start for s, start in zip(sheets, places, strict=True)])
    return Outline(
        np.concatenate([sheet.points for sheet in sheets])[used],
        np.concatenate([sheet.normals for sheet in sheets])[used],
        np.concatenate(flat)[used] if textured else None,
        place[used],
        renumbered.reshape(-1, 4),
        np.concatenate([sheet.owner for sheet in sheets]),
        origin,
        warnings,
    )
