"""Groups of neighbouring triangles, so that those facing away are skipped together.

Prepared once per mesh; each frame a few comparisons per group decide what to draw. A
group is left out only if no triangle of it can put a pixel into the picture: the
picture is the same, byte for byte, as drawing all of them in the same order.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from playground.render.gl.mesh_order import morton_order

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

TRIANGLES = 256  # per cluster: 128 to 512 are equally fast on llvmpipe, 64 and 1024 slower


@dataclass(frozen=True, eq=False)
class Clusters:
    """K groups of consecutive triangles of a reordered mesh, and what bounds each.

    ``faces`` (M, 3) are in the new order and number the vertices anew: vertex i is
    vertex ``vertex_order[i]`` of the mesh. A group's normals lie within the cone around
    ``axis`` with half-angle of cosine ``cos`` and sine ``sin``; ``offset`` is the largest
    n·(centre − p) over its triangles, how far a plane lies behind the centre; ``slack``
    is one over the smallest altitude of a triangle.
    """

    faces: NDArray[np.int32]
    vertex_order: Ints
    axis: Floats
    cos: Floats
    sin: Floats
    offset: Floats
    slack: Floats
    centre: Floats
    radius: Floats


def build_clusters(positions: NDArray[np.float32], faces: NDArray[np.int32]) -> Clusters:
    """Order the triangles of a mesh for locality and bound each group of `TRIANGLES`.

    ``positions`` are (V, 3), ``faces`` (F, 3) rows of them.
    """
    vertex_order, faces = morton_order(positions, faces)
    start = np.arange(0, len(faces), TRIANGLES)
    group = np.repeat(np.arange(len(start)), np.diff(np.append(start, len(faces))))

    # Corner a and edges u, v of every triangle, component by component.
    corners = positions[vertex_order].astype(np.float64)
    a = [np.ascontiguousarray(column)[faces[:, 0]] for column in corners.T]
    u = [
        np.ascontiguousarray(column)[faces[:, 1]] - x
        for column, x in zip(corners.T, a, strict=True)
    ]
    v = [
        np.ascontiguousarray(column)[faces[:, 2]] - x
        for column, x in zip(corners.T, a, strict=True)
    ]
    normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
    area = np.sqrt(_dot(normal, normal))  # twice the area
    uu, vv = _dot(u, u), _dot(v, v)
    longest = np.sqrt(np.maximum(np.maximum(uu, vv), uu + vv - 2.0 * _dot(u, v)))
    sound = np.where(area > 0.0, area, 1.0)
    normal = [x / sound for x in normal]
    slack = np.maximum.reduceat(np.where(area > 0.0, longest / sound, np.inf), start)

    # The cone around the mean normal, and the ball around the mean corner.
    axis = _group_mean(normal, start, group)
    length = np.linalg.norm(axis, axis=1, keepdims=True)
    axis /= np.where(length > 0.0, length, 1.0)
    cos = np.minimum.reduceat(_dot(normal, [x[group] for x in axis.T]), start)
    cos = np.clip(cos - 1e-12, -1.0, 1.0)
    centre = _group_mean([x + (y + z) / 3.0 for x, y, z in zip(a, u, v, strict=True)], start, group)
    d = [c[group] - x for c, x in zip(centre.T, a, strict=True)]
    offset = np.maximum.reduceat(_dot(normal, d), start)
    du = [x - y for x, y in zip(u, d, strict=True)]
    dv = [x - y for x, y in zip(v, d, strict=True)]
    far = np.maximum(_dot(d, d), np.maximum(_dot(du, du), _dot(dv, dv)))
    radius = np.sqrt(np.maximum.reduceat(far, start))
    sin = np.sqrt(1.0 - cos * cos)
    return Clusters(faces, vertex_order, axis, cos, sin, offset, slack, centre, radius)


def visible_runs(
    clusters: Clusters, eye: Floats, planes: Floats, pixel: float, cull_back: bool
) -> list[tuple[int, int]]:
    """(first, count) of the runs of triangles to draw, seen from ``eye`` in the mesh's space.

    Parameters
    ----------
    planes : (P, 4)
        Frustum planes, unit normals inwards: n·x + d >= 0 inside.
    pixel : float
        The side of a pixel at distance 1: 2 tan(fov/2) / height.
    cull_back : bool
        Skip groups that face away; the mesh's space must then be a similarity of the world.

    Notes
    -----
    A triangle with unit normal n and corner p shows its back if n·(p − e) > 0. With c the
    group's centre and D = c − e, n·(p − e) = n·D − n·(c − p) >= n·D − offset, and as n is
    within the half-angle h of the axis a, n·D >= (D·a) cos h − |D × a| sin h (cones beyond
    90° are never skipped). The rasteriser rounds corners to 1/256 pixel, which may turn a
    triangle seen almost edge-on: a corner at reach R moves by up to R·pixel·√2/512, its
    plane tilts by twice this over the altitude, and the eye stands R·tilt nearer to it, in
    all R²·pixel·slack/181. The margin asked for is R²·pixel·slack/64, which also holds the
    1e-4 pixel of float32 transforms.
    """
    to_centre = clusters.centre - eye
    squared = np.einsum("ij,ij->i", to_centre, to_centre)
    reach = np.sqrt(squared) + clusters.radius
    keep = np.ones(len(squared), dtype=bool)
    if cull_back:
        along = np.einsum("ij,ij->i", to_centre, clusters.axis)
        across = np.sqrt(np.maximum(squared - along * along, 0.0))
        turned = along * clusters.cos - across * clusters.sin
        margin = reach * reach * (pixel / 64.0) * clusters.slack
        keep = (clusters.cos < 0.0) | (turned <= clusters.offset + margin)

    # A ball outside one plane by two pixels more than touching reaches no pixel. (einsum,
    # because a matrix product would wake threads that steal time from the rasteriser.)
    depth = np.einsum("ij,kj->ki", clusters.centre, planes[:, :3]) + planes[:, 3:]
    keep &= (depth > -clusters.radius - 2.0 * pixel * reach).all(axis=0)
    edges = np.flatnonzero(np.diff(keep, prepend=False, append=False))
    first = edges[0::2] * TRIANGLES
    last = np.minimum(edges[1::2] * TRIANGLES, len(clusters.faces))
    return list(zip(first.tolist(), (last - first).tolist(), strict=True))


def frustum_planes(clip: Floats) -> Floats:
    """Inward unit planes (5, 4) of a clip matrix: left, right, bottom, top, near.

    Source: Gribb & Hartmann, Fast Extraction of Viewing Frustum Planes, 2001.
    """
    x, y, z, w = clip
    rows = np.stack([w + x, w - x, w + y, w - y, w + z])
    length = np.sqrt(np.einsum("ij,ij->i", rows[:, :3], rows[:, :3]))[:, None]
    return np.asarray(rows / np.where(length > 0.0, length, 1.0))


def _dot(a: list[Floats], b: list[Floats]) -> Floats:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _group_mean(columns: list[Floats], start: Ints, group: Ints) -> Floats:
    """The mean of each group of each column, shape (K, 3)."""
    count = np.bincount(group).astype(np.float64)
    return np.stack([np.add.reduceat(column, start) / count for column in columns], axis=1)
