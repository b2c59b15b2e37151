"""The only module that creates GL contexts: headless ones, by EGL where it can.

Everything GL is optional. Where there is no driver, `headless` raises a
`PlaygroundError` that says what to install, and ``renderer="auto"`` takes NumPy.
"""

from __future__ import annotations

import os
import sys
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from playground.errors import PlaygroundError

if TYPE_CHECKING:
    import moderngl

GL_VERSION = 330
DRIVER_PACKAGES = "libgl1 libegl1 libgl1-mesa-dri"
WINDOW_PACKAGES = "libx11-6 libxext6"
APT = (
    "apt-get install -y" if os.name == "posix" and os.geteuid() == 0 else "sudo apt-get install -y"
)
INSTALL_DRIVER = f"{APT} {DRIVER_PACKAGES}"
INSTALL_WINDOW = f"{APT} {WINDOW_PACKAGES}"


class NoDriverError(PlaygroundError):
    """There is no working GL driver on this machine."""


@lru_cache(maxsize=1)
def headless() -> moderngl.Context:
    """The process's own GL context without a window, made at the first call.

    Raises
    ------
    NoDriverError
        With the reason of each backend that was tried.
    """
    import moderngl

    reasons = []
    backends = ("egl", None) if sys.platform.startswith("linux") else (None,)
    for backend in backends:
        if backend is None and sys.platform.startswith("linux") and not os.environ.get("DISPLAY"):
            continue
        try:
            more: dict[str, Any] = {"backend": backend} if backend else {}
            context = moderngl.create_context(standalone=True, require=GL_VERSION, **more)
        except Exception as error:  # the loaders raise what they like
            reasons.append(f"{backend or 'default'}: {str(error).strip() or type(error).__name__}")
            continue
        rest(context)
        return context
    raise NoDriverError(
        "no GL driver was found",
        got="; ".join(reasons),
        fix=f"On Debian or Ubuntu: {INSTALL_DRIVER}. Or use --renderer numpy, which needs none.",
    )


def rest(context: moderngl.Context) -> None:
    """Bind a small framebuffer of our own.

    A surfaceless context has none, and transform feedback without one returns zeros in
    silence; and a framebuffer that is released while it is bound leaves an error behind.
    """
    if context.extra is None:
        context.extra = {}
    if "idle" not in context.extra:
        context.extra["idle"] = context.simple_framebuffer((4, 4))
    context.extra["idle"].use()


def available() -> bool:
    """Whether a GL driver works here; the first call finds out."""
    try:
        headless()
    except NoDriverError:
        return False
    return True
