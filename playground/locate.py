"""The only module that knows where ``shaders/``, ``assets/`` and ``lessons/`` are.

In a checkout and in an editable install they stand beside the package; a wheel
carries them inside it.
"""

from __future__ import annotations

from pathlib import Path

PACKAGE = Path(__file__).resolve().parent


def _folder(name: str) -> Path:
    inside = PACKAGE / name
    return inside if inside.is_dir() else PACKAGE.parent / name


def shader(name: str) -> Path:
    """The path of a shader file, for example ``shader("lib/phong.glsl")``."""
    return _folder("shaders") / name


def asset(name: str) -> Path:
    """The path of an asset, for example ``asset("scenes/teapot.toml")``."""
    return _folder("assets") / name


def lesson(name: str) -> Path:
    """The path of a lesson's file, for example ``lesson("07_specular.py")``."""
    return _folder("lessons") / name
