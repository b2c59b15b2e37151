"""Finds what is wrong with the surfaces of a scene, before light is spread over them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from playground.render.radiosity.patch.edges import SAME_PLACE, Edges, edges_of, extent_of, places
from playground.render.radiosity.patch.flaws import Flaws
from playground.render.radiosity.patch.overlaps import overlaps
from playground.render.radiosity.patch.parts import classes
from playground.render.radiosity.patch.patches import Patches
from playground.render.trace.bvh import build
from playground.render.trace.walk import closest
from playground.scene.normals import direction
from playground.shading.floats import Array
from playground.shading.vector import cross, dot

Integers = NDArray[np.int64]
TESTS = 2_000_000  # of a point with a polygon or an edge, side by side


def inspect(patches: Patches) -> Flaws:
    """Look for what lets light through, tears its shading or sends it to the wrong side.

    Points closer than a millionth of the scene's extent count as one.
    """
    tolerance = SAME_PLACE * extent_of(patches)
    place = places(patches.points, tolerance)
    owner = np.zeros(len(place), dtype=np.int64)
    owner[patches.corners] = patches.owner[:, None]
    own = np.unique(owner * len(place) + place, return_inverse=True)[1]
    within = edges_of(patches.corners, own)
    nothing, backs = _in_front(patches, tolerance)
    parent_owner = patches.owner[patches.parents.first]
    return Flaws(
        patches=patches,
        leaks=_leaks(patches, edges_of(patches.corners, place), tolerance),
        t_vertices=_t_vertices(patches, within, tolerance),
        overlaps=overlaps(patches.parents.corners, parent_owner, tolerance),
        inside_out=_inside_out(patches, within),
        facing_nothing=nothing,
        facing_backs=backs,
    )


def _leaks(patches: Patches, edges: Edges, tolerance: float) -> Integers:
    """Patches with an edge that no other has, and whose middle lies on no other surface."""
    alone = edges.alone()
    patch = edges.patch[alone]
    ends = edges_of(patches.corners)
    middle = 0.5 * (patches.points[ends.start[alone]] + patches.points[ends.end[alone]])
    parents = patches.parents
    a, b, c, d = np.moveaxis(parents.corners, 1, 0)
    normal = direction(cross(c - a, d - b))
    level = dot(normal, a)
    lonely = np.ones(len(alone), dtype=bool)
    for at in _blocks(len(alone), len(normal)):
        near = np.abs(middle[at] @ normal.T - level) <= 2.0 * tolerance
        near &= patches.parent[patch[at]][:, None] != np.arange(len(normal))
        edge, other = np.nonzero(near)
        inside = _inside(middle[at][edge], parents.corners[other], normal[other], tolerance)
        lonely[at.start + edge[inside]] = False
    return np.asarray(patch[lonely])


def _inside(point: Array, polygon: Array, normal: Array, tolerance: float) -> NDArray[np.bool_]:
    """Whether points (K, 3) in the planes of convex polygons (K, 4, 3) lie within or on them."""
    edge = np.roll(polygon, -1, axis=1) - polygon
    left = dot(cross(direction(edge), point[:, None] - polygon), normal[:, None])
    return np.asarray((left >= -tolerance).all(axis=1))


def _t_vertices(patches: Patches, edges: Edges, tolerance: float) -> Integers:
    """Pairs (patch, point) of one object where the point lies in the middle of an edge.

    A corner in the middle of an edge leaves that edge alone, and those that end there as well.
    """
    alone = edges.alone()
    ends = edges_of(patches.corners)
    found = [np.zeros((0, 2), dtype=np.int64)]
    for owner in np.unique(patches.owner[ends.patch[alone]]):
        own = alone[patches.owner[ends.patch[alone]] == owner]
        _, first = np.unique(edges.start[own], return_index=True)
        corner = ends.start[own][first]
        point = patches.points[corner]
        for at in _blocks(len(own), len(point)):
            a, b = patches.points[ends.start[own[at]]], patches.points[ends.end[own[at]]]
            length = np.linalg.norm(b - a, axis=1)
            along = (b - a) / length[:, None]
            step = along @ point.T - dot(along, a)[:, None]
            edge, other = np.nonzero((step > tolerance) & (step < length[:, None] - tolerance))
            foot = a[edge] + step[edge, other][:, None] * along[edge]
            on = np.linalg.norm(point[other] - foot, axis=1) <= tolerance
            pairs = np.stack([ends.patch[own[at]][edge[on]], corner[other[on]]], axis=1)
            found.append(pairs)
    return np.concatenate(found)


def _inside_out(patches: Patches, edges: Edges) -> Integers:
    """Patches turned against most of those that they hang together with, by area."""
    first, second = edges.twins()
    turned = edges.start[first] == edges.start[second]
    if not turned.any():
        return np.zeros(0, dtype=np.int64)
    pairs = np.stack([edges.patch[first], edges.patch[second]], axis=1)
    group = classes(len(patches), pairs)
    side = np.zeros(len(patches), dtype=np.int64)
    side[np.unique(group, return_index=True)[1]] = 1
    relation = np.where(turned, -1, 1)
    while not side.all():  # each round reaches the neighbours of those that are known
        a, b = side[pairs].T
        side[pairs[:, 1]] = np.where((a != 0) & (b == 0), a * relation, side[pairs[:, 1]])
        a, b = side[pairs].T
        side[pairs[:, 0]] = np.where((b != 0) & (a == 0), b * relation, side[pairs[:, 0]])
    balance = np.bincount(group, side * patches.area)
    return np.flatnonzero(side * np.where(balance < 0.0, -1, 1)[group] < 0)


def _in_front(patches: Patches, tolerance: float) -> tuple[Integers, Integers]:
    """Patches whose normal meets nothing, and those whose normal first meets a back."""
    corners = patches.parents.corners
    points = corners.reshape(-1, 3)
    start = 4 * np.arange(len(corners))
    halves = np.stack([start, start + 1, start + 2], axis=1)
    others = np.stack([start, start + 2, start + 3], axis=1)[~patches.parents.triangle]
    faces = np.concatenate([halves, others])
    origin = patches.centre + tolerance * patches.normal
    t, triangle, _ = closest(build(points, faces), origin, patches.normal, np.inf)
    a, b, c = np.moveaxis(points[faces[triangle]], 1, 0)
    back = dot(cross(b - a, c - a), patches.normal) > 0.0
    return np.flatnonzero(t < 0.0), np.flatnonzero((t > 0.0) & back)


def _blocks(rows: int, columns: int) -> list[slice]:
    """Slices of ``rows`` that keep a table with so many columns small."""
    step = max(TESTS // max(columns, 1), 1)
    return [slice(first, min(first + step, rows)) for first in range(0, rows, step)]
