"""Reads .ply, .stl, .glb and .gltf through trimesh and flattens the scene graph.

Knows what trimesh makes of a file. Must not know `Mesh`. trimesh is imported only
when a file is read.
"""

from __future__ import annotations

import json
import logging
import re
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from playground.errors import why_unread
from playground.scene.obj_file import Part

Floats = NDArray[np.float64]


class FlawError(ValueError):
    """What is wrong with a file, in words."""


def read_parts(data: bytes, path: Path) -> list[Part]:
    """Every mesh of the file where its scene graph puts it.

    Parameters
    ----------
    data : bytes
        The whole file.
    path : Path
        Its name: the suffix tells the format, and files it refers to lie beside it.

    Raises
    ------
    Exception
        Of any kind, from trimesh; a `FlawError` where trimesh would be silent or mislead.
    """
    import trimesh

    suffix = path.suffix.lower()
    data = _checked(data, suffix)
    options: dict[str, Any] = {"process": False}
    if suffix == ".ply":
        # Splitting vertices at seams loses their normals, and is needed only if texture
        # coordinates belong to corners and not to vertices
        header = data.partition(b"end_header")[0]
        options |= {"fix_texture": b"texcoord" in header, "skip_materials": True}
    with _silence():
        scene = trimesh.load_scene(
            BytesIO(data),
            file_type=suffix[1:],
            resolver=trimesh.resolvers.FilePathResolver(str(path)),
            **options,
        )
        placed = [scene.graph[node] for node in scene.graph.nodes_geometry]
        return [
            _placed(scene.geometry[name], np.asarray(matrix, dtype=np.float64))
            for matrix, name in placed
            if isinstance(scene.geometry[name], trimesh.Trimesh)
        ]


@contextmanager
def _silence() -> Iterator[None]:
    """Keep trimesh from printing tracebacks of what it survives."""
    logger = logging.getLogger("trimesh")
    before = logger.level
    logger.setLevel(logging.CRITICAL + 1)
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            yield
    finally:
        logger.setLevel(before)


def _placed(geometry: Any, matrix: Floats) -> Part:
    """A trimesh moved by a (4, 4) matrix; a mirror also turns its triangles round."""
    linear, positions = matrix[:3, :3], np.asarray(geometry.vertices, dtype=np.float64)
    faces = np.asarray(geometry.faces, dtype=np.int64).reshape(-1, 3)
    mirrored = np.linalg.det(linear) < 0.0
    normals = None
    # In the cache lie the file's normals; asking for the property would compute some
    if "vertex_normals" in geometry._cache:
        cofactors = np.cross(np.roll(linear, -1, axis=0), np.roll(linear, -2, axis=0))
        normals = np.asarray(geometry.vertex_normals, dtype=np.float64) @ cofactors.T
        normals = -normals if mirrored else normals
    texcoords = getattr(geometry.visual, "uv", None)
    if texcoords is not None:
        texcoords = np.asarray(texcoords, dtype=np.float64)
        if texcoords.shape != (len(positions), 2):
            texcoords = None
    return Part(
        positions @ linear.T + matrix[:3, 3],
        faces[:, ::-1] if mirrored else faces,
        normals,
        texcoords,
    )


def _checked(data: bytes, suffix: str) -> bytes:
    """The data, or a `FlawError` where trimesh would be silent or name another cause."""
    if suffix == ".stl":
        return _checked_stl(data)
    if suffix == ".ply":
        header, _, body = data.partition(b"end_header")
        counts = re.findall(rb"^element\s+\S+\s+(\d+)", header, re.MULTILINE)
        promised = sum(int(count) for count in counts)
        lines = len([line for line in body.splitlines() if line.strip()])
        if re.search(rb"^format\s+ascii", header, re.MULTILINE) and lines < promised:
            raise FlawError(f"{lines} lines of data where the header promises {promised}")
    if suffix == ".gltf":
        try:
            json.loads(data)
        except (ValueError, RecursionError) as error:
            raise FlawError(f"not valid JSON: {why_unread(error)}") from None
    if suffix == ".glb" and len(data) >= 12:
        promised = int.from_bytes(data[8:12], "little")
        if data[:4] == b"glTF" and len(data) < promised:
            raise FlawError(f"{len(data)} bytes where the header promises {promised}")
    return data


def _checked_stl(data: bytes) -> bytes:
    """The bytes of a whole .stl file; those of a text as ASCII."""
    promised = 84 + 50 * int.from_bytes(data[80:84], "little")
    if len(data) == promised:
        return data
    if b"solid" not in data[:1000].lower() or b"\0" in data[:1000]:
        raise FlawError(f"{len(data)} bytes where the header promises {promised}")
    facets, vertices, ends = (
        len(re.findall(word, data, re.IGNORECASE))
        for word in (rb"\bfacet\s+normal\b", rb"\bvertex\b", rb"\bendfacet\b")
    )
    if not 3 * facets == vertices == 3 * ends:
        raise FlawError(f"{facets} facets begun, {ends} ended, {vertices} vertices")
    return data.decode("ascii", "replace").encode("ascii", "replace")
