"""What the driver is like that a GL context belongs to."""

from __future__ import annotations

from typing import Any

SOFTWARE = ("llvmpipe", "softpipe", "swiftshader", "software")  # drivers without a GPU


def software(context: Any) -> bool:
    """Whether pictures are computed by the CPU: slower, and without a clock for drawing."""
    return any(name in context.info["GL_RENDERER"].lower() for name in SOFTWARE)
