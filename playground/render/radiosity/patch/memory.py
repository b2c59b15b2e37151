"""How much memory is free, and whether a matrix of form factors would fit."""

from __future__ import annotations

import os
from math import isqrt
from pathlib import Path

from playground.errors import PlaygroundError

BYTES = 8  # of a form factor
# Where Linux says how much memory a container may have: cgroups of version 2, and of version 1
LIMITS = ("/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes")


def available() -> int | None:
    """Bytes of memory that can be had without swapping; None where the system does not say.

    In a container at most as much as that may have.
    """
    said = [size for size in (_of_the_machine(), *map(_limit, LIMITS)) if size is not None]
    return min(said, default=None)


def _limit(file: str) -> int | None:
    """What a container may have; None for all of it, and where there is none."""
    try:
        return int(Path(file).read_text(encoding="ascii"))
    except (OSError, ValueError):
        return None


def _of_the_machine() -> int | None:
    try:
        for line in Path("/proc/meminfo").read_text(encoding="ascii").splitlines():
            if line.startswith("MemAvailable:"):
                return int(line.split()[1]) * 1024
    except (OSError, ValueError, IndexError):
        pass
    try:
        return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    except (AttributeError, OSError, ValueError):
        return None


def check_memory(patches: int, fewest: int) -> None:
    """Raise an error if the form factors of so many patches do not fit into memory.

    Parameters
    ----------
    patches : int
        How many there would be.
    fewest : int
        How many there are with nothing divided.
    """
    free = available()
    if free is None or patches * patches * BYTES <= free:
        return
    fits = isqrt(free // BYTES)
    if fewest <= fits:
        fix = f"Ask for fewer: patches = {fits}."
    else:
        fix = f"The meshes alone have {fewest} pieces: lower their tessellation, or simplify them."
    raise PlaygroundError(
        f"the form factors of {patches} patches do not fit into memory",
        got=f"{patches}² × {BYTES} bytes = {_size(patches * patches * BYTES)}, "
        f"and {_size(free)} free",
        allowed=f"about {fits} patches on this machine",
        fix=fix,
    )


def _size(count: int) -> str:
    return f"{count / 1e9:.3g} GB"
