"""Files are read with a clear error and written whole or not at all."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

from playground.errors import PlaygroundError


def read_bytes(path: Path) -> bytes:
    """The bytes of a file.

    Raises
    ------
    PlaygroundError
        The file is missing, a folder, or may not be read.
    """
    try:
        return path.read_bytes()
    except FileNotFoundError:
        raise PlaygroundError(f"there is no file {path}", fix="Check the path.") from None
    except IsADirectoryError:
        raise PlaygroundError(f"{path} is a folder", allowed="a file") from None
    except OSError as error:
        raise PlaygroundError(f"cannot read {path}", got=error.strerror or str(error)) from None


def write_whole(path: Path, data: bytes) -> None:
    """Write ``data`` to a temporary name beside ``path`` and rename it.

    Whatever happens, ``path`` holds either what it held before or all of ``data``.

    Raises
    ------
    PlaygroundError
        The folder is missing or cannot be written.
    """
    try:
        handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    except OSError as error:
        raise PlaygroundError(
            f"cannot write {path}",
            got=error.strerror or str(error),
            fix=f"Make the folder {path.parent} first, or choose another place.",
        ) from None
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
        os.chmod(temporary, 0o666 & ~_umask())
        os.replace(temporary, path)
    except OSError as error:
        os.unlink(temporary)
        raise PlaygroundError(
            f"cannot write {path}", got=error.strerror or str(error), fix="Choose another place."
        ) from None
    except BaseException:
        os.unlink(temporary)
        raise


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
