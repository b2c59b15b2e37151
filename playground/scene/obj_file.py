"""Reads the text of a Wavefront .obj file: v, vt, vn and f, and nothing else.

Knows the text format. Must not know `Mesh` or other file formats. We read it
ourselves because trimesh counts negative indices from the end of the file instead of
from the line they stand on, and takes an index 0 for the first vertex.
"""

from __future__ import annotations

import contextlib
import itertools
import re
from typing import NamedTuple, NoReturn

import numpy as np
from numpy.typing import NDArray

from playground.errors import PlaygroundError
from playground.scene.polygon import triangles

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

KEYS = ("v", "vt", "vn")
# One corner of a face: v, v/vt, v//vn or v/vt/vn, of at most 18 digits to fit int64
CORNER = re.compile(r"(?<!\S)(-?\d{1,18})(?:/(-?\d{1,18})?(?:/(-?\d{1,18})?)?)?(?!\S)")
FACE_LINE = re.compile(r"^[ \t]*f[ \t]+(.*)$", re.MULTILINE)


class Part(NamedTuple):
    """Triangles as a file gives them, unchecked.

    positions (N, 3) float64, faces (M, 3) int64, normals (N, 3) or None with NaN where
    the file has none, texcoords (N, 2) or None.
    """

    positions: Floats
    faces: Integers
    normals: Floats | None
    texcoords: Floats | None


def read_obj(data: bytes, file: str) -> Part:
    """All faces of an .obj file, polygons cut into triangles.

    Parameters
    ----------
    data : bytes
        The whole file.
    file : str
        Its name for error messages.

    Raises
    ------
    PlaygroundError
        A line is malformed or an index names something that is not there; the message
        has the line number.
    """
    text = _plain(data.decode("latin-1"))
    values = {
        "v": _values(text, "v", 3, file),
        "vt": _values(text, "vt", 2, file),
        "vn": _values(text, "vn", 3, file),
    }
    faces = list(FACE_LINE.finditer(text))
    sizes = np.array([len(face[1].split()) for face in faces], dtype=np.int64)
    corners = _corners(text, faces, sizes, file)
    owner = np.repeat(np.arange(len(faces)), sizes)
    for column, key in enumerate(KEYS):
        counts = len(values[key])
        corners[:, column] = _absolute(text, faces, owner, corners[:, column], key)
        _check_range(text, faces, owner, corners[:, column], key, counts, file)
    return _assemble(values, corners, triangles(values["v"][corners[:, 0] - 1], sizes))


def _plain(text: str) -> str:
    """The text with one kind of line end, long lines joined and comments removed."""
    text = text.replace("\r\n", "\n").replace("\r", "\n").replace("\\\n", " ")
    return re.sub(r"#.*", "", text)


def _fail(text: str, start: int, what: str, allowed: str, file: str) -> NoReturn:
    line = text.count("\n", 0, start) + 1
    got = text[start:].split("\n", 1)[0].strip()
    raise PlaygroundError(
        f"{file}, line {line}: {what}",
        got=f"'{got[:80]}'",
        allowed=allowed,
        fix="Mend this line or export the model again.",
    )


def _values(text: str, key: str, columns: int, file: str) -> Floats:
    """The first numbers of each ``key`` line, float64 of shape (count, columns)."""
    numbers = r"[ \t]+(\S+)" * columns
    rows = re.findall(rf"^[ \t]*{key}{numbers}", text, re.MULTILINE)
    lines = re.findall(rf"^[ \t]*{key}(?!\S)", text, re.MULTILINE)
    values = None
    with contextlib.suppress(ValueError):
        values = np.array(rows, dtype=np.float64).reshape(-1, columns)
    # Bad normals are replaced and bad texture coordinates dropped, bad positions are not
    sound = values is not None and (key != "v" or np.isfinite(values).all())
    if values is not None and sound and len(rows) == len(lines):
        return values

    # Find the line to blame
    for match in re.finditer(rf"^[ \t]*{key}(?!\S)(.*)$", text, re.MULTILINE):
        words = match[1].split()[:columns]
        if len(words) < columns or not all(_is_number(word, key) for word in words):
            break
    allowed = f"'{key}' and {columns} finite numbers"
    _fail(text, match.start(), f"this '{key}' is malformed", allowed, file)


def _is_number(word: str, key: str) -> bool:
    try:
        number = np.array([word], dtype=np.float64)
    except ValueError:
        return False
    return key != "v" or bool(np.isfinite(number).all())


def _corners(text: str, faces: list[re.Match[str]], sizes: Integers, file: str) -> Integers:
    """The numbers of all corners as written, shape (C, 3): v, vt, vn; 0 where left out."""
    found = CORNER.findall("\n".join(face[1] for face in faces))
    if len(found) != sizes.sum() or (len(sizes) and sizes.min() < 3):
        for face in faces:
            words = face[1].split()
            if len(words) < 3 or not all(CORNER.fullmatch(word) for word in words):
                allowed = "'f' and three or more corners v, v/vt, v//vn or v/vt/vn"
                _fail(text, face.start(), "this face is malformed", allowed, file)
    words = itertools.chain.from_iterable(found)
    return np.fromiter((int(word or 0) for word in words), np.int64).reshape(-1, 3)


def _absolute(
    text: str, faces: list[re.Match[str]], owner: Integers, index: Integers, key: str
) -> Integers:
    """Indices counted from 1; -1 names the last ``key`` line above the face."""
    if not (index < 0).any():
        return index
    places = [m.start() for m in re.finditer(rf"^[ \t]*{key}(?!\S)", text, re.MULTILINE)]
    above = np.searchsorted(places, [face.start() for face in faces])[owner]
    # An index before the first line must stay wrong, so it must not land on 0 = left out
    resolved = np.where(above + index >= 0, above + index + 1, -1)
    return np.where(index < 0, resolved, index)


def _check_range(
    text: str,
    faces: list[re.Match[str]],
    owner: Integers,
    index: Integers,
    key: str,
    count: int,
    file: str,
) -> None:
    low = 1 if key == "v" else 0
    bad = np.flatnonzero((index < low) | (index > count))
    if len(bad):
        start = faces[owner[bad[0]]].start()
        allowed = f"1 to {count}, or -1 back to the first '{key}' above the face"
        if count == 0:
            allowed = f"none, since the file has no '{key}'"
        _fail(text, start, f"this face names a '{key}' that is not there", allowed, file)


def _assemble(values: dict[str, Floats], corners: Integers, cut: Integers) -> Part:
    """One vertex for each different (v, vt, vn), or the file's own vertices if v is all."""
    v, vt, vn = corners.T
    if not vt.any() and not vn.any():
        return Part(values["v"], (v - 1)[cut], None, None)

    # Number the different pairs, then the different (pair, vn)
    pair = np.unique(v * (len(values["vt"]) + 1) + vt, return_inverse=True)[1]
    key = pair * (len(values["vn"]) + 1) + vn
    _, first, vertex = np.unique(key, return_index=True, return_inverse=True)

    # Entry 0 stands for left out: no normal, and the corner of the texture
    normals = np.concatenate([np.full((1, 3), np.nan), values["vn"]])[vn[first]]
    texcoords = np.concatenate([np.zeros((1, 2)), values["vt"]])[vt[first]]
    return Part(
        values["v"][v[first] - 1],
        vertex.astype(np.int64)[cut],
        normals if vn.any() else None,
        texcoords if vt.any() else None,
    )
