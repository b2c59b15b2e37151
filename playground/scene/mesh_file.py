"""Reads a mesh from .obj, .ply, .stl, .glb or .gltf, with one clear error for each flaw.

Knows what makes a file usable. Must not know scenes, nor how a format is written.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from playground.errors import PlaygroundError
from playground.files import no_name
from playground.scene.mesh import Mesh
from playground.scene.normals import smooth, weld
from playground.scene.obj_file import Part, read_obj
from playground.scene.trimesh_file import FlawError, read_parts

Floats = NDArray[np.float64]

SUFFIXES = (".obj", ".ply", ".stl", ".glb", ".gltf")
LARGEST = 1e28  # of a coordinate: a camera that sees all of it stands within 1e30
EXPORT_AGAIN = "Export the model again as triangles, for example from Blender."


def load_mesh(path: str | Path) -> tuple[Mesh, Floats]:
    """The triangles of a file as one mesh about its own centre, and where that centre is.

    Parameters
    ----------
    path : str or Path
        A .obj, .ply, .stl, .glb or .gltf file. A scene graph is flattened with all
        its transforms.

    Returns
    -------
    mesh : Mesh
        Positions relative to the middle of the model's box, so that a model far from
        the origin keeps its detail in float32. Normals and texture coordinates are
        the file's own where they are valid; without normals in the file, and always
        for .stl, they are smooth over equal positions.
    offset : float64 array of shape (3,)
        The middle of the box: position in the file = mesh position + offset.

    Raises
    ------
    PlaygroundError
        The file is missing, unreadable, damaged, of another kind, or has no triangles.
    """
    path = Path(path)
    part = _parts_joined(_read(path), path)
    _check_places(part, path)
    offset = _middle(part)
    centred, faces, texcoords = part.positions - offset, part.faces, part.texcoords
    if path.suffix.lower() == ".stl":
        centred, faces = _welded(centred, faces)
    if texcoords is not None and not np.isfinite(texcoords).all():
        texcoords = None
    try:
        mesh = Mesh.create(centred, faces, part.normals, texcoords, path.stem)
    except PlaygroundError as error:
        raise PlaygroundError(
            f"{path}: {error.what}", got=error.got, allowed=error.allowed, fix=EXPORT_AGAIN
        ) from None
    return (mesh if part.normals is not None else smooth(mesh)), offset


def _read(path: Path) -> bytes:
    """The bytes of a mesh file that exists, has a known suffix and is not empty."""
    allowed = "a file that ends in " + ", ".join(SUFFIXES)
    try:
        if path.is_dir():
            raise IsADirectoryError(0, "a folder")
        if path.suffix.lower() not in SUFFIXES:
            got = f"'{path.suffix}'" if path.suffix else "no suffix"
            fix = "Export the model in one of these formats."
            raise PlaygroundError(
                f"{path} is no known mesh file", got=got, allowed=allowed, fix=fix
            )
        data = path.read_bytes()
    except FileNotFoundError:
        raise PlaygroundError(
            f"there is no mesh file {path}",
            got="no such file",
            allowed=allowed,
            fix="Check the path.",
        ) from None
    except PlaygroundError:
        raise
    except ValueError:
        raise no_name(path) from None
    except OSError as error:
        raise PlaygroundError(
            f"cannot read the mesh file {path}",
            got=error.strerror or str(error),
            allowed=allowed,
            fix="Check the path and the permissions.",
        ) from None
    if not data.strip():
        raise _damaged(path, "an empty file")
    return data


def _damaged(path: Path, reason: str) -> PlaygroundError:
    return PlaygroundError(
        f"{path} cannot be read as a mesh",
        got=reason,
        allowed=f"a whole {path.suffix.lower()} file with at least one triangle",
        fix=EXPORT_AGAIN,
    )


def _parts_joined(data: bytes, path: Path) -> Part:
    """All triangles of the file as one part."""
    if path.suffix.lower() == ".obj":
        parts = [read_obj(data, str(path))]
    else:
        # Whatever goes wrong inside a foreign reader is a flaw of the file to its user
        try:
            parts = read_parts(data, path)
        except MemoryError:
            raise
        except FlawError as flaw:
            raise _damaged(path, str(flaw)) from None
        except Exception as error:
            reason = " ".join(f"{type(error).__name__}: {error}".split())
            raise _damaged(path, reason) from None
    parts = [part for part in parts if len(part.faces)]
    if not parts:
        raise _damaged(path, "no triangles (points or lines only)")
    starts = np.cumsum([0] + [len(part.positions) for part in parts[:-1]])
    return Part(
        np.concatenate([part.positions for part in parts]),
        np.concatenate([part.faces + start for part, start in zip(parts, starts, strict=True)]),
        _stacked([part.normals for part in parts], parts, 3, np.nan),
        _stacked([part.texcoords for part in parts], parts, 2, 0.0),
    )


def _stacked(
    arrays: list[Floats | None], parts: list[Part], columns: int, missing: float
) -> Floats | None:
    """The arrays below one another, filled up where a part has none; None if none has."""
    if all(array is None for array in arrays):
        return None
    filled = [
        np.full((len(part.positions), columns), missing) if array is None else array
        for array, part in zip(arrays, parts, strict=True)
    ]
    return np.concatenate(filled)


def _check_places(part: Part, path: Path) -> None:
    """Raise an error for positions or indices that no mesh can have."""
    count = len(part.positions)
    bad = np.argwhere(~np.isfinite(part.positions))
    if len(bad):
        row = bad[0][0]
        raise PlaygroundError(
            f"{path}: vertex {row} is not finite",
            got=str(part.positions[row].tolist()),
            allowed="finite numbers",
            fix="Remove this vertex, or export the model again.",
        )
    wrong = np.argwhere((part.faces < 0) | (part.faces >= count))
    if len(wrong):
        row, column = wrong[0]
        raise PlaygroundError(
            f"{path}: triangle {row} names a vertex that is not there",
            got=str(part.faces[row, column]),
            allowed=f"0 to {count - 1}",
            fix=EXPORT_AGAIN,
        )
    largest = float(np.abs(part.positions).max())
    if largest > LARGEST:
        raise PlaygroundError(
            f"{path}: the model is too large or too far from the origin",
            got=f"a coordinate of {largest:.3g}",
            allowed=f"coordinates from {-LARGEST:g} to {LARGEST:g}",
            fix="Scale or move the model, and export it again.",
        )


def _middle(part: Part) -> Floats:
    """The middle of the box around all faces, float64, shape (3,)."""
    drawn = part.positions[part.faces.ravel()]
    middle: Floats = 0.5 * drawn.min(axis=0) + 0.5 * drawn.max(axis=0)
    return middle


def _welded(positions: Floats, faces: NDArray[np.int64]) -> tuple[Floats, NDArray[np.int64]]:
    """The same triangles with one vertex for each position."""
    place = weld(positions)
    chosen = np.empty(place.max() + 1, dtype=np.int64)
    chosen[place] = np.arange(len(place))
    return positions[chosen], place[faces]
