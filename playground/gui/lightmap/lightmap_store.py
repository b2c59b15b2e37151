"""Where the window keeps lightmaps that it has baked, until their setup is saved."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path
from uuid import uuid4

from playground.files import make_folder, read_bytes, resolved, write_whole
from playground.render.lightmap.lightmap_file import SUFFIX
from playground.scene.setup import Setup

FOLDER = "PLAYGROUND_SETTINGS"  # the variable that moves them, with all the window remembers
KEPT = 24  # files: undo may lead back to an old one


def folder() -> Path:
    """The folder of the user's own cache."""
    chosen = os.environ.get(FOLDER)
    if chosen:
        return Path(chosen) / "lightmaps"
    import platformdirs

    cache = platformdirs.user_cache_path("lighting-playground", appauthor=False)
    return cache / "lightmaps"


def new_file(setup: Setup) -> Path:
    """A name that no file has yet; the oldest of too many files go.

    Raises
    ------
    PlaygroundError
        The folder cannot be made.
    """
    place = folder()
    make_folder(place)
    files = sorted(place.glob(f"*{SUFFIX}"), key=_age)
    for old in files[: max(len(files) - KEPT + 1, 0)]:
        if str(old) != setup.scene.lightmap:
            with suppress(OSError):
                old.unlink()
    name = "".join(c for c in setup.name if c.isalnum() or c in "-_") or "setup"
    return resolved(place / f"{name}-{uuid4().hex[:12]}{SUFFIX}")


def beside(setup: Setup, path: Path) -> Setup:
    """The setup as it is saved to ``path``: a lightmap of our own folder goes along with it.

    Raises
    ------
    PlaygroundError
        The lightmap is gone, or cannot be written there.
    """
    baked = Path(setup.scene.lightmap)
    if not setup.scene.lightmap or baked.parent != resolved(folder()):
        return setup
    file = resolved(path.with_suffix(f".lightmap{SUFFIX}"))
    write_whole(file, read_bytes(baked))
    return setup.with_(lightmap=str(file))


def _age(path: Path) -> float:
    with suppress(OSError):
        return path.stat().st_mtime
    return 0.0
