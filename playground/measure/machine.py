"""What figures were measured on, and with which version of the source."""

from __future__ import annotations

import hashlib
import json
import os
import platform
from pathlib import Path
from typing import Any

from playground import __version__, locate


def machine() -> dict[str, Any]:
    """Device, driver and software; no GL where there is no driver."""
    import numpy

    from playground.render.gl.context import available, headless

    info = headless().info if available() else {}
    return {
        "gl": info.get("GL_RENDERER"),
        "driver": info.get("GL_VERSION"),
        "processor": _processor(),
        "cores": os.cpu_count(),
        "python": platform.python_version(),
        "numpy": numpy.__version__,
        "system": platform.platform(terse=True),
        "playground": __version__,
        "source": source_version(),
    }


def load() -> float | None:
    """How many processes want a core, on average over a minute; None where the system hides it."""
    try:
        return os.getloadavg()[0]
    except (AttributeError, OSError):
        return None


def source_version() -> str:
    """12 digits that change with any file of the package or of the shaders."""
    digest = hashlib.sha256()
    for root in (locate.PACKAGE, locate.shader("")):
        for path in sorted(Path(root).rglob("*")):
            if path.is_file() and "__pycache__" not in path.parts:
                digest.update(path.relative_to(root).as_posix().encode() + b"\0")
                digest.update(path.read_bytes())
    return digest.hexdigest()[:12]


def stamp(found: dict[str, Any], quick: bool) -> str:
    """12 digits that agree where samples may be put together."""
    text = json.dumps([found, quick], sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:12]


def _processor() -> str:
    """The name of the processor; Python itself knows it only on some systems."""
    try:
        for line in Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    except OSError:
        pass
    return platform.processor() or platform.machine()
