"""``playground doctor``: what works on this machine, what is missing, how to install it."""

from __future__ import annotations

import os
import sys
from importlib.metadata import PackageNotFoundError, version
from typing import Any

from playground.render.gl.context import INSTALL_DRIVER, INSTALL_WINDOW

PACKAGES = (
    "numpy",
    "moderngl",
    "moderngl-window",
    "imgui-bundle",
    "glfw",
    "pyrr",
    "trimesh",
    "pillow",
    "platformdirs",
)


def examine() -> dict[str, Any]:
    """What was found: versions, the GL driver or why there is none, the display, the window."""
    return {
        "python": sys.version.split()[0],
        "packages": {name: _version(name) for name in PACKAGES},
        "gl": _gl(),
        "display": os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY") or None,
        "window": _window(),
    }


def report(found: dict[str, Any]) -> str:
    """The findings in words, each missing thing with the line that installs it."""
    lines = [f"Python      {found['python']}"]
    for name, number in found["packages"].items():
        missing = f"missing: pip install {name}"
        lines.append(f"{name:<16}{number or missing}")
    gl, window = found["gl"], found["window"]
    if gl["works"]:
        lines.append(f"GL          works: {gl['renderer']}, {gl['version']}")
        lines.append(
            f"            {gl['samples']} samples, pictures up to {gl['largest']} pixels a side"
        )
    else:
        lines += [f"GL          none: {gl['reason']}", f"            install: {INSTALL_DRIVER}"]
        lines.append("            until then pictures are made by NumPy, more slowly")
    if window["works"]:
        lines.append("window      its libraries are there")
    else:
        lines += [f"window      not possible: {window['reason']}"]
        lines.append(f"            install: {INSTALL_WINDOW}")
    lines.append(f"display     {found['display'] or 'none: the window needs one; render does not'}")
    return "\n".join(lines)


def _version(package: str) -> str | None:
    try:
        return version(package)
    except PackageNotFoundError:
        return None


def _gl() -> dict[str, Any]:
    from playground.render.gl.context import NoDriverError, headless

    try:
        context = headless()
    except NoDriverError as error:
        return {"works": False, "reason": str(error.got)}
    info = context.info
    return {
        "works": True,
        "renderer": info["GL_RENDERER"],
        "version": info["GL_VERSION"],
        "samples": context.max_samples,
        "largest": info["GL_MAX_TEXTURE_SIZE"],
    }


def _window() -> dict[str, Any]:
    try:
        import imgui_bundle  # noqa: F401
        import moderngl_window  # noqa: F401
    except Exception as error:  # a missing shared library raises ImportError with its name
        return {"works": False, "reason": str(error)}
    return {"works": True}
