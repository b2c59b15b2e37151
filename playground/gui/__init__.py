"""The window: the only importer of moderngl_window and imgui_bundle.

Where no window can be opened, the same view goes into a PNG instead.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from playground.scene.setup import Setup

PICTURE_SIZE = (1280, 720)


def open_window(setup: Setup, again: bool = False) -> int:
    """Open the window on ``setup`` and stay until it is closed; returns the exit status.

    With ``again``, on the setup that the last window was closed on, if there was one.

    Without a display, or without the libraries of a window, says so on stderr and saves
    the same view as ``<name of the setup>.png`` in the current folder.

    Raises
    ------
    PlaygroundError
        A mesh or texture of the setup cannot be read.
    """
    from playground.render.surface import surfaces

    surfaces(setup.scene, setup.settings.weights)
    reason = why_no_window()
    if reason is None:
        from playground.gui.app import NoWindowError, run

        try:
            run(setup, again)
            return 0
        except NoWindowError as error:
            reason = str(error)
    print(f"playground: no window: {reason}", file=sys.stderr)
    save_view(setup)
    return 0


def why_no_window() -> str | None:
    """What is missing for a window, with the line that installs it; None if nothing is."""
    from playground.render.gl.context import DRIVER_PACKAGES, WINDOW_PACKAGES

    posix = sys.platform not in ("win32", "darwin")
    if posix and not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        return "no display was found (DISPLAY and WAYLAND_DISPLAY are empty)"
    try:
        import imgui_bundle  # noqa: F401, I001 - first: it brings the glfw library
        import glfw  # noqa: F401
        import moderngl_window  # noqa: F401
    except Exception as error:  # a missing shared library raises ImportError with its name
        install = f"sudo apt-get install -y {WINDOW_PACKAGES} {DRIVER_PACKAGES}"
        return f"{error}. On Debian or Ubuntu: {install}"
    return None


def save_view(setup: Setup) -> None:
    """Draw ``setup`` without a window into ``<name>.png`` and print the path."""
    import numpy as np

    from playground.files import write_whole
    from playground.render.gl.context import INSTALL_DRIVER
    from playground.render.image_file import png_bytes
    from playground.render.renderer import open_renderer

    path = Path(f"{setup.name}.png")
    with open_renderer(PICTURE_SIZE, "auto") as renderer:
        if renderer.name == "numpy":
            print(
                f"playground: no GL driver, drawn by NumPy; to install one: {INSTALL_DRIVER}",
                file=sys.stderr,
            )
        codes = np.empty((PICTURE_SIZE[1], PICTURE_SIZE[0], 4), dtype=np.uint8)
        renderer.render(setup, out=codes)
        write_whole(path, png_bytes(codes[..., :3], setup, folder=path.parent))
    print(path)
