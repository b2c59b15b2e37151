"""Files are read with a clear error and written whole or not at all."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

from playground import locate
from playground.errors import PlaygroundError, shown

Stamp = tuple[str, int, int, int]


def read_bytes(path: Path) -> bytes:
    """The bytes of a file.

    Raises
    ------
    PlaygroundError
        The file is missing, a folder, or may not be read, or this is no name of a file.
    """
    try:
        return path.read_bytes()
    except FileNotFoundError:
        raise PlaygroundError(f"there is no file {path}", fix="Check the path.") from None
    except IsADirectoryError:
        raise PlaygroundError(f"{path} is a folder", allowed="a file") from None
    except ValueError:
        raise no_name(path) from None
    except OSError as error:
        raise PlaygroundError(f"cannot read {path}", got=error.strerror or str(error)) from None


def write_whole(path: Path, data: bytes) -> None:
    """Write ``data`` to a temporary name beside ``path`` and rename it.

    Whatever happens, ``path`` holds either what it held before or all of ``data``. Where
    it is a symbolic link, this holds for the file it leads to.

    Raises
    ------
    PlaygroundError
        The folder is missing or cannot be written, or this is no name of a file.
    """
    try:
        place = Path(os.path.realpath(path))
    except ValueError:
        raise no_name(path) from None
    try:
        handle, temporary = tempfile.mkstemp(dir=place.parent, prefix=".playground-")
    except OSError as error:
        raise _unwritable(place, error) from None
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
        os.chmod(temporary, 0o666 & ~_umask())
        os.replace(temporary, place)
    except OSError as error:
        os.unlink(temporary)
        raise _unwritable(place, error) from None
    except BaseException:
        os.unlink(temporary)
        raise


def check_place(path: Path) -> None:
    """Raise the error that `write_whole` would, before the work for what is to be written."""
    try:
        place = Path(os.path.realpath(path))
    except ValueError:
        raise no_name(path) from None
    if os.path.isdir(place):  # unlike Path.is_dir, no error for a name that is too long
        raise PlaygroundError(f"{path} is a folder", allowed="a file")
    try:
        with tempfile.TemporaryFile(dir=place.parent):
            pass
    except OSError as error:
        raise _unwritable(place, error) from None


def make_folder(path: Path) -> None:
    """Make a folder and those above it, unless it is there.

    Raises
    ------
    PlaygroundError
        There is a file of that name, or it cannot be made.
    """
    try:
        path.mkdir(parents=True, exist_ok=True)
    except ValueError:
        raise no_name(path) from None
    except OSError as error:
        in_the_way = isinstance(error, FileExistsError | NotADirectoryError)
        raise PlaygroundError(
            f"cannot make the folder {path}",
            got="a file of that name" if in_the_way else error.strerror or str(error),
            fix="Choose another place.",
        ) from None


def resolved(path: Path) -> Path:
    """``path`` from the root, without links or dots; it need not exist."""
    try:
        return path.resolve()
    except (OSError, RuntimeError, ValueError):  # a loop of links, a null character
        raise no_name(path) from None


def stamp(path: Path) -> Stamp:
    """What tells a file and its state from any other: place, time, size, inode."""
    try:
        place, state = os.path.abspath(path), os.stat(path)
    except (OSError, ValueError):  # whoever reads it says what is wrong
        return str(path), 0, 0, 0
    return place, state.st_mtime_ns, state.st_size, state.st_ino


def texture_file(name: str, folder: Path | None) -> Path:
    """The image that ``name`` means in a setup file in ``folder``.

    A bare name that is not there, or has no folder to be in, is one of our textures.
    """
    return _there_or_ours("textures", name, folder)


def mesh_file(name: str, folder: Path | None) -> Path:
    """The mesh file that ``name`` means in a setup file in ``folder``, or one of our meshes."""
    return _there_or_ours("meshes", name, folder)


def _there_or_ours(kind: str, name: str, folder: Path | None) -> Path:
    ours = locate.asset(kind) / name
    there = folder is not None and os.path.exists(folder / name)
    if Path(name).name == name and not there and os.path.isfile(ours):
        return ours
    return (folder or Path()) / name


def no_name(path: Path) -> PlaygroundError:
    """The error for what no file can be called."""
    return PlaygroundError(
        "this cannot be the name of a file",
        got=shown(str(path)),
        allowed="any characters but null",
        fix="Choose another name.",
    )


def _unwritable(place: Path, error: OSError) -> PlaygroundError:
    reason, fix = error.strerror or str(error), "Choose another place."
    if isinstance(error, FileNotFoundError) and place.parent.is_dir():
        reason = f"a folder that takes no files, {place.parent}"
    elif isinstance(error, FileNotFoundError):
        fix = f"Make the folder {place.parent} first, or choose another place."
    return PlaygroundError(f"cannot write {place}", got=reason, fix=fix)


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
