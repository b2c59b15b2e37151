"""Lightmaps as files: NumPy archives (.npz) that any program can open.

``format`` and ``version`` say what it is; ``direct`` and ``indirect`` (H, W, 3) float32,
``chart`` (H, W) int32 with −1 where no chart is; ``geometry`` and ``lighting``, checksums; and
per object i, unless it is shrunk to nothing, ``vertices_i``, ``faces_i``, ``texcoords_i`` and
``charts_i`` as in `Part`.
"""

from __future__ import annotations

import zipfile
import zlib
from functools import lru_cache
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from playground.errors import PlaygroundError
from playground.files import Stamp, read_bytes, stamp, write_whole
from playground.render.lightmap.atlas import SIZES, Part
from playground.render.lightmap.lightmap import Lightmap

SUFFIX = ".npz"
FORMAT = "playground lightmap"
VERSION = 1
COLUMNS = {
    "vertices": (np.int32, 1),
    "faces": (np.int32, 2),
    "texcoords": (np.float32, 2),
    "charts": (np.int32, 1),
}
Arrays = dict[str, NDArray[Any]]


def save_lightmap(lightmap: Lightmap, path: Path) -> None:
    """Write ``lightmap`` whole or not at all.

    Raises
    ------
    PlaygroundError
        Another suffix, or the place cannot be written.
    """
    if path.suffix.lower() != SUFFIX:
        raise PlaygroundError(
            f"a lightmap is saved as {SUFFIX}", got=str(path), fix=f"Call it {path.stem}{SUFFIX}."
        )
    arrays: Arrays = {
        "format": np.array(FORMAT),
        "version": np.array(VERSION),
        "objects": np.array(len(lightmap.parts)),
        "geometry": np.array(lightmap.geometry),
        "lighting": np.array(lightmap.lighting),
        "direct": lightmap.direct,
        "indirect": lightmap.indirect,
        "chart": lightmap.chart,
    }
    for number, part in enumerate(lightmap.parts):
        if part is not None:
            arrays |= {f"{name}_{number}": getattr(part, name) for name in COLUMNS}
    buffer = BytesIO()
    np.savez_compressed(buffer, allow_pickle=False, **arrays)
    write_whole(path, buffer.getvalue())


def load_lightmap(path: str | Path) -> Lightmap:
    """The lightmap in a file; read once for as long as the file does not change.

    Raises
    ------
    PlaygroundError
        The file is missing, damaged, no lightmap, or of a version that is not known here.
    """
    return _loaded(Path(path), stamp(Path(path)))


@lru_cache(maxsize=4)
def _loaded(path: Path, state: Stamp) -> Lightmap:
    """The lightmap in a file; ``state`` tells one that has changed from what it was."""
    data = read_bytes(path)
    try:
        with zipfile.ZipFile(BytesIO(data)), np.load(BytesIO(data), allow_pickle=False) as archive:
            arrays = {name: archive[name] for name in archive.files}
    except MemoryError:
        raise
    except (OSError, ValueError, EOFError, KeyError, AttributeError, SyntaxError) as error:
        raise _no_lightmap(path, str(error)) from None
    except (zipfile.BadZipFile, zlib.error, NotImplementedError, RuntimeError) as error:
        raise _no_lightmap(path, str(error)) from None
    return _lightmap(arrays, path)


def _lightmap(arrays: Arrays, path: Path) -> Lightmap:
    if str(arrays.get("format")) != FORMAT:
        raise _no_lightmap(path, f"an archive of {', '.join(list(arrays)[:5]) or 'nothing'}")
    if str(arrays.get("version")) != str(VERSION):
        raise PlaygroundError(
            f"the lightmap {path} is of another version",
            got=str(arrays.get("version")),
            allowed=str(VERSION),
            fix="Bake it again: playground bake SETUP -o out.toml",
        )
    direct = _image(arrays, "direct", path)
    size = len(direct)
    indirect, chart = _image(arrays, "indirect", path), _of(arrays, "chart", np.int32, 2, path)
    if direct.shape != (size, size, 3) or indirect.shape != direct.shape:
        raise _no_lightmap(path, f"light of shape {direct.shape} and {indirect.shape}")
    if chart.shape != (size, size) or not SIZES[0] <= size <= SIZES[1]:
        raise _no_lightmap(path, f"charts of shape {chart.shape}")
    objects = _of(arrays, "objects", np.integer, 0, path)
    parts = tuple(_part(arrays, number, path) for number in range(int(objects)))
    geometry, lighting = (str(_of(arrays, x, np.str_, 0, path)) for x in ("geometry", "lighting"))
    return Lightmap(size, direct, indirect, chart >= 0, chart, parts, geometry, lighting)


def _part(arrays: Arrays, number: int, path: Path) -> Part | None:
    if f"vertices_{number}" not in arrays:
        return None
    columns = [
        _of(arrays, f"{name}_{number}", kind, dimensions, path)
        for name, (kind, dimensions) in COLUMNS.items()
    ]
    part = Part(*columns)
    count = len(part.vertices)
    sound = part.faces.shape[1:] == (3,) and part.texcoords.shape == (count, 2)
    sound = sound and part.charts.shape == (count,) and bool(np.isfinite(part.texcoords).all())
    if not sound or (part.faces.size and not 0 <= part.faces.min() <= part.faces.max() < count):
        raise _no_lightmap(path, f"a mesh {number} that does not hold together")
    return part


def _image(arrays: Arrays, name: str, path: Path) -> NDArray[np.float32]:
    values = _of(arrays, name, np.float32, 3, path)
    if not np.isfinite(values).all():
        raise _no_lightmap(path, f"{name} light that is not finite")
    return values


def _of(arrays: Arrays, name: str, kind: Any, dimensions: int, path: Path) -> NDArray[Any]:
    """One array of the file, of the type and the number of dimensions that it must have."""
    if name not in arrays:
        raise _no_lightmap(path, f"no '{name}' in it")
    values = arrays[name]
    if values.ndim != dimensions or not np.issubdtype(values.dtype, kind):
        raise _no_lightmap(path, f"'{name}' of type {values.dtype} and shape {values.shape}")
    values.setflags(write=False)
    return values


def _no_lightmap(path: Path, got: str) -> PlaygroundError:
    return PlaygroundError(
        f"{path} is no lightmap, or a damaged one",
        got=got,
        allowed=f"a {SUFFIX} file that playground bake has written",
        fix="Bake it again: playground bake SETUP -o out.toml",
    )
